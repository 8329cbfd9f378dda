#include "scene/defect_actors.h"

#include "scene/categories.h"

#include "vtkActor.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cmath>

namespace bindpose
{
namespace
{
/// Return an actor for the vertices, the edges or the triangles among the defects, with cells
/// colored by type.
vtkSmartPointer<vtkActor> make_actor(
  vtkPolyData* defects, vtkCellArray* cells, vtkIdType first, vtkPolyData* part)
{
  const auto& categories = defect_categories();
  vtkDataArray* kinds = defects->GetCellData()->GetArray("Defect");
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetNumberOfComponents(3);
  for (vtkIdType i = 0; i < cells->GetNumberOfCells(); ++i)
  {
    const double kind = kinds->GetComponent(first + i, 0);
    const auto last = static_cast<double>(categories.size() - 1);
    const Rgb& c = categories[static_cast<std::size_t>(std::clamp(kind, 0.0, last))].color;
    for (const double channel : c)
    {
      colors->InsertNextValue(static_cast<unsigned char>(std::lround(255.0 * channel)));
    }
  }
  part->SetPoints(defects->GetPoints());
  part->GetCellData()->SetScalars(colors);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(part);
  mapper->SetScalarModeToUseCellData();
  mapper->SetColorModeToDirectScalars();
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->PickableOff();
  return actor;
}
} // namespace

std::vector<vtkSmartPointer<vtkActor>> make_defects(vtkPolyData* defects, double line_width)
{
  std::vector<vtkSmartPointer<vtkActor>> actors;
  vtkMapper::SetResolveCoincidentTopologyToPolygonOffset();
  const vtkIdType verts = defects->GetNumberOfVerts();
  const vtkIdType lines = defects->GetNumberOfLines();
  if (defects->GetNumberOfPolys() > 0)
  {
    vtkNew<vtkPolyData> part;
    part->SetPolys(defects->GetPolys());
    const auto faces = make_actor(defects, defects->GetPolys(), verts + lines, part);
    // Use mostly ambient light, because shading would change the color that identifies the defect.
    faces->GetProperty()->SetInterpolationToFlat();
    faces->GetProperty()->SetAmbient(0.45);
    faces->GetProperty()->SetDiffuse(0.55);
    faces->GetMapper()->SetRelativeCoincidentTopologyPolygonOffsetParameters(-2.0, -2.0);
    actors.push_back(faces);
  }
  for (const bool hidden : { true, false })
  {
    for (const bool dots : { false, true })
    {
      if ((dots ? verts : lines) == 0)
      {
        continue;
      }
      vtkNew<vtkPolyData> part;
      dots ? part->SetVerts(defects->GetVerts()) : part->SetLines(defects->GetLines());
      const auto actor = make_actor(
        defects, dots ? defects->GetVerts() : defects->GetLines(), dots ? 0 : verts, part);
      vtkProperty* property = actor->GetProperty();
      property->LightingOff();
      property->SetLineWidth(static_cast<float>(line_width));
      property->SetPointSize(static_cast<float>(3.0 * line_width));
      property->SetRenderPointsAsSpheres(dots); // draw round dots
      property->SetOpacity(hidden ? 0.35 : 1.0);
      // A large depth offset draws hidden defects in front of everything. A small depth offset
      // draws defects just in front of the surface that contains them.
      const double depth_offset = hidden ? -66000.0 : -8.0;
      actor->GetMapper()->SetRelativeCoincidentTopologyLineOffsetParameters(0.0, depth_offset);
      actor->GetMapper()->SetRelativeCoincidentTopologyPointOffsetParameter(depth_offset);
      actors.push_back(actor);
    }
  }
  return actors;
}

} // namespace bindpose

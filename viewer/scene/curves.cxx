#include "scene/curves.h"

#include "scene/colors.h"

#include "vtkActor.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCleanPolyData.h"
#include "vtkDataArray.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkStripper.h"
#include "vtkTubeFilter.h"

#include <algorithm>
#include <cmath>

namespace bindpose
{
namespace
{
constexpr int class_count = 3; // number of classes of tubes: multiplicity 1, 2, and 3 or more
constexpr double widths[class_count] = { 1.0, 1.5, 2.0 };

vtkSmartPointer<vtkPolyData> lines_of_class(vtkPolyData* data, int class_index)
{
  vtkDataArray* multiplicity = data->GetCellData()->GetArray("Multiplicity");
  // cell ids start with the vertices, then the lines follow
  const vtkIdType first = data->GetNumberOfVerts();
  vtkNew<vtkCellArray> lines;
  vtkNew<vtkIdList> ids;
  for (vtkIdType line = 0; line < data->GetNumberOfLines(); ++line)
  {
    const double usage_count =
      multiplicity ? std::abs(multiplicity->GetComponent(first + line, 0)) : 1.0;
    const int line_class =
      std::isfinite(usage_count) ? static_cast<int>(std::lround(std::min(usage_count, 3.0))) : 1;
    if (line_class == class_index + 1)
    {
      data->GetLines()->GetCellAtId(line, ids);
      lines->InsertNextCell(ids);
    }
  }
  auto result = vtkSmartPointer<vtkPolyData>::New();
  result->SetPoints(data->GetPoints());
  result->SetLines(lines);
  return result;
}

vtkSmartPointer<vtkActor> make_actor(vtkPolyData* data)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  mapper->ScalarVisibilityOff();
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  set_color(actor->GetProperty(), palette::curve);
  actor->PickableOff();
  return actor;
}
} // namespace

bool is_curve_data(vtkDataSet* data)
{
  auto* lines = vtkPolyData::SafeDownCast(data);
  if (!lines || lines->GetNumberOfLines() == 0 ||
    lines->GetNumberOfPolys() + lines->GetNumberOfStrips() > 0 ||
    lines->GetCellData()->HasArray("HandleKind") || lines->GetCellData()->HasArray("HandleName"))
  {
    return false;
  }
  if (lines->GetCellData()->HasArray("Multiplicity"))
  {
    return true;
  }
  vtkNew<vtkIdList> ids;
  for (vtkIdType line = 0; line < lines->GetNumberOfLines(); ++line)
  {
    lines->GetLines()->GetCellAtId(line, ids);
    if (ids->GetNumberOfIds() > 2)
    {
      return true;
    }
  }
  return false;
}

std::vector<vtkSmartPointer<vtkActor>> make_curves(
  vtkPolyData* data, double radius, double line_width)
{
  std::vector<vtkSmartPointer<vtkActor>> actors;
  for (int tube_class = 0; tube_class < class_count; ++tube_class)
  {
    const auto lines = lines_of_class(data, tube_class);
    if (lines->GetNumberOfLines() == 0)
    {
      continue;
    }
    // Join edges to polylines, whose tubes have no gaps at their joints. Duplicate points are
    // merged first, because a tube would end at them.
    vtkNew<vtkCleanPolyData> clean;
    clean->SetInputData(lines);
    clean->ConvertLinesToPointsOff();
    clean->PointMergingOn();
    clean->SetTolerance(0.0);
    vtkNew<vtkStripper> strips;
    strips->SetInputConnection(clean->GetOutputPort());
    strips->JoinContiguousSegmentsOn();
    vtkNew<vtkTubeFilter> tubes;
    tubes->SetInputConnection(strips->GetOutputPort());
    tubes->SetRadius(radius * widths[tube_class]);
    tubes->SetNumberOfSides(10);
    tubes->CappingOn();
    tubes->Update();
    const auto tube = make_actor(tubes->GetOutput());
    tube->GetProperty()->SetAmbient(0.25);
    tube->GetProperty()->SetDiffuse(0.8);
    tube->GetProperty()->SetSpecular(0.15);
    tube->GetProperty()->SetSpecularPower(20.0);
    actors.push_back(tube);
    // The depth offset draws the faint lines in front of everything else.
    const auto faint_actor = make_actor(strips->GetOutput());
    faint_actor->GetProperty()->LightingOff();
    faint_actor->GetProperty()->SetOpacity(0.35);
    faint_actor->GetProperty()->SetLineWidth(static_cast<float>(line_width * widths[tube_class]));
    vtkMapper::SetResolveCoincidentTopologyToPolygonOffset();
    faint_actor->GetMapper()->SetRelativeCoincidentTopologyLineOffsetParameters(0.0, -66000.0);
    actors.push_back(faint_actor);
  }
  return actors;
}

} // namespace bindpose

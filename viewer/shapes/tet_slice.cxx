// Cuts tets by a plane with VTK's filters. Values are linear in a tet, so the bands and isolines of
// a slice are exact.
#include "shapes/tet_slice.h"

#include "conversion.h"

#include "vtkClipPolyData.h"
#include "vtkCutter.h"
#include "vtkNew.h"
#include "vtkPlane.h"
#include "vtkPolyData.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>

namespace bindpose
{
namespace
{
vtkSmartPointer<vtkPlane> make_plane(const Vec3& origin, const Vec3& normal)
{
  auto plane = vtkSmartPointer<vtkPlane>::New();
  const Vec3 unit = normal.normalized();
  plane->SetOrigin(origin.x(), origin.y(), origin.z());
  plane->SetNormal(unit.x(), unit.y(), unit.z());
  return plane;
}
} // namespace

vtkSmartPointer<vtkPolyData> slice_tets(
  vtkUnstructuredGrid* tets, const Vec3& origin, const Vec3& normal)
{
  vtkNew<vtkCutter> cutter;
  cutter->SetInputData(tets);
  cutter->SetCutFunction(make_plane(origin, normal));
  cutter->Update();
  return cutter->GetOutput();
}

std::vector<Index> tets_at_plane(const TetInput& tets, const Vec3& origin, const Vec3& normal)
{
  const Eigen::VectorXd ahead =
    (tets.points.view().rowwise() - origin.transpose()) * normal.normalized();
  std::vector<Index> met;
  for (Index t = 0; t < tets.tets.view().rows(); ++t)
  {
    const auto tet = tets.tets.view().row(t);
    const auto [lowest, highest] =
      std::minmax({ ahead[tet[0]], ahead[tet[1]], ahead[tet[2]], ahead[tet[3]] });
    if (lowest < 0.0 && highest >= 0.0)
    {
      met.push_back(t);
    }
  }
  return met;
}

vtkSmartPointer<vtkPolyData> part_behind(
  vtkPolyData* surface, const Vec3& origin, const Vec3& normal)
{
  vtkNew<vtkClipPolyData> clip;
  clip->SetInputData(surface);
  clip->SetClipFunction(make_plane(origin, normal));
  clip->InsideOutOn();
  clip->Update();
  return clip->GetOutput();
}

} // namespace bindpose

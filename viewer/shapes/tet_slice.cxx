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
  const Eigen::VectorXd signed_distances =
    (tets.points.view().rowwise() - origin.transpose()) * normal.normalized();
  std::vector<Index> crossed_tets;
  for (Index t = 0; t < tets.tets.view().rows(); ++t)
  {
    const auto tet = tets.tets.view().row(t);
    const auto [lowest, highest] = std::minmax({ signed_distances[tet[0]], signed_distances[tet[1]],
      signed_distances[tet[2]], signed_distances[tet[3]] });
    if (lowest < 0.0 && highest >= 0.0)
    {
      crossed_tets.push_back(t);
    }
  }
  return crossed_tets;
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

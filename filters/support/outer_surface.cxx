#include "outer_surface.h"

#include "vtkDataSet.h"

namespace bindpose
{

Status to_outer_surface(vtkDataSet* data, SurfaceInput& surface)
{
  TetInput tets;
  if (!to_tets(data, tets).ok())
  {
    return to_surface(data, surface);
  }
  surface = SurfaceInput();
  surface.points = tets.points;
  surface.triangles.set_owned(boundary_triangles(tets.tets.view()));
  return {};
}

} // namespace bindpose

// Scale a mesh and assemble its stiffness and mass (see scaled_mesh.h).
#include "domain/scaled_mesh.h"

namespace bindpose
{

ScaledMesh scale_mesh(const Domain& domain, const std::vector<char>& used)
{
  Box box;
  for (Index v = 0; v < domain.points.rows(); ++v)
  {
    if (used[v])
    {
      box.add(domain.points.row(v));
    }
  }
  ScaledMesh result;
  result.diagonal = box.diagonal();
  result.points = domain.points;
  result.points.rowwise() -= box.center().transpose();
  result.points /= result.diagonal;
  const Points& points = result.points;
  result.stiffness = domain.is_volume()
    ? stiffness_matrix(points, domain.tets, domain.inside_fractions)
    : stiffness_matrix(points, domain.triangles);
  result.mass = domain.is_volume() ? lumped_mass(points, domain.tets, domain.inside_fractions)
                                   : lumped_mass(points, domain.triangles);
  result.mass_unit = result.mass.maxCoeff();
  result.mass /= result.mass_unit;
  return result;
}

} // namespace bindpose

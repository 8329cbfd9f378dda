#ifndef bindpose_geometry_laplacian_h
#define bindpose_geometry_laplacian_h

// Discrete Laplacians of triangle and tet meshes: cotangent weights, stiffness, mass and
// polyharmonic energies.

#include "geometry/mesh.h"
#include "linear/sparse_matrix.h"

namespace bindpose
{

/// Return the cotangent weights of every triangle's edges, #F x 3. Column k belongs to the edge
/// opposite to corner k and contains (1/2) cot(angle at corner k). The sum of weight * (edge
/// length)^2 over the edges is twice the area. The weights of degenerate triangles are 0.
Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor> cotangent_weights(
  PointsView points, TrianglesView triangles);

/// Return the cotangent weights of every tet's edges, #T x 6, in the order 01, 02, 03, 12, 13, 23.
/// Each weight is (1/6) l_opposite cot(theta_opposite), which equals -volume grad_i . grad_j.
/// l_opposite and theta_opposite are the length of the opposite edge and the dihedral angle there.
/// The sum of weight * (edge length)^2 over the edges is three times the volume. The weights of
/// degenerate tets are 0.
Eigen::Matrix<double, Eigen::Dynamic, 6, Eigen::RowMajor> cotangent_weights(
  PointsView points, TetsView tets);

/// The six edges of a tet as pairs of corners, in the order of cotangent_weights().
constexpr int tet_edges[6][2] = { { 0, 1 }, { 0, 2 }, { 0, 3 }, { 1, 2 }, { 1, 3 }, { 2, 3 } };

/// Return the positive semi-definite stiffness matrix K (#V x #V): K_ij is minus the sum of the
/// cotangent weights of edge ij in all elements at this edge. The sum of each row is 0. K is minus
/// the cotangent Laplacian.
/// @param fractions one factor per element (the fraction of the element that contains material), or
///   empty for 1 everywhere
SparseMatrix stiffness_matrix(
  PointsView points, TrianglesView triangles, const Eigen::VectorXd& fractions = Eigen::VectorXd());
SparseMatrix stiffness_matrix(
  PointsView points, TetsView tets, const Eigen::VectorXd& fractions = Eigen::VectorXd());

/// Return the matrix N of the outward flux through the boundary (#V x #V): N_ij is the integral of
/// phi_i n . grad phi_j over the boundary, with hat functions phi and the outward normal n. For
/// every linear u, (K - N) u = 0, also at the boundary. N is zero for a closed surface. For an open
/// surface, n lies in the plane of the triangle and is normal to its open edge.
SparseMatrix boundary_flux(PointsView points, TrianglesView triangles);
SparseMatrix boundary_flux(PointsView points, TetsView tets);

/// Return the lumped mass, #V. A triangle contributes to each of its vertices the part of the
/// triangle that is nearest to this vertex (Voronoi area). An obtuse triangle contributes half of
/// its area to the vertex at the obtuse angle and a quarter to each of the other two. A tet
/// contributes a quarter of its volume (times its fraction, if given) to each vertex. The mass of
/// unused vertices is 0.
Eigen::VectorXd lumped_mass(PointsView points, TrianglesView triangles);
Eigen::VectorXd lumped_mass(
  PointsView points, TetsView tets, const Eigen::VectorXd& fractions = Eigen::VectorXd());

/// Return Q_k = K (M^-1 K)^(k-1), which is symmetric positive semi-definite. It defines the energy
/// 1/2 w' Q_k w: Dirichlet for k = 1, biharmonic for k = 2 and triharmonic for k = 3. The rows of
/// vertices without mass are 0 in M^-1. Method: Jacobson et al. 2010, Mixed finite elements for
/// variational surface modeling.
SparseMatrix harmonic_energy(const SparseMatrix& stiffness, const Eigen::VectorXd& mass, int k);

} // namespace bindpose

#endif

#ifndef bindpose_base_laplacian_h
#define bindpose_base_laplacian_h

#include "base/mesh.h"

#include <Eigen/SparseCore>

namespace bindpose
{

using SparseMatrix = Eigen::SparseMatrix<double, Eigen::ColMajor, int>;

/// Cotangent weights of every element's edges, #F x 3: column k belongs to the edge opposite to
/// corner k and holds (1/2) cot(angle at corner k). Sum over edges of c |e|^2 = 2 area. Degenerate
/// triangles get zeros.
Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor> cotangent_weights(
  PointsView points, TrianglesView triangles);

/// #T x 6: edges in the order 01, 02, 03, 12, 13, 23, each (1/6) l_opposite cot(theta_opposite),
/// which is -volume grad_i . grad_j. Sum over edges of c |e|^2 = 3 volume. Degenerate tets get
/// zeros.
Eigen::Matrix<double, Eigen::Dynamic, 6, Eigen::RowMajor> cotangent_weights(
  PointsView points, TetsView tets);

/// The six edges of a tet as corner pairs, in the order of cotangent_weights.
constexpr int tet_edges[6][2] = { { 0, 1 }, { 0, 2 }, { 0, 3 }, { 1, 2 }, { 1, 3 }, { 2, 3 } };

/// Positive semi-definite stiffness K (#V x #V): K_ij = -sum of cotangent weights of edge ij, rows
/// sum to zero. This is minus the cotangent Laplacian.
/// @param shares a factor for each element (how much of it is material), or empty: all 1.
SparseMatrix stiffness_matrix(
  PointsView points, TrianglesView triangles, const Eigen::VectorXd& shares = Eigen::VectorXd());
SparseMatrix stiffness_matrix(
  PointsView points, TetsView tets, const Eigen::VectorXd& shares = Eigen::VectorXd());

/// N (#V x #V): N_ij is the integral over the boundary of phi_i n . grad phi_j, what flows out.
/// With it (K - N) u = 0 for every linear u, at the boundary as well. Zero for a closed surface; in
/// a surface n lies in the triangle, normal to its open edge.
SparseMatrix boundary_flux(PointsView points, TrianglesView triangles);
SparseMatrix boundary_flux(PointsView points, TetsView tets);

/// Lumped mass, #V. Triangles: Voronoi areas, clamped in obtuse triangles (they sum to the area);
/// tets: a quarter of each volume. A vertex that nothing uses gets 0.
Eigen::VectorXd lumped_mass(PointsView points, TrianglesView triangles);
Eigen::VectorXd lumped_mass(
  PointsView points, TetsView tets, const Eigen::VectorXd& shares = Eigen::VectorXd());

/// Q_k = K (M^-1 K)^(k-1), symmetric positive semi-definite: k = 1 Dirichlet, 2 biharmonic,
/// 3 triharmonic energy is 1/2 w' Q_k w. Massless vertices are left out of M^-1 (their rows are 0).
/// Jacobson et al. 2010, Mixed finite elements for variational surface modeling.
SparseMatrix harmonic_energy(const SparseMatrix& stiffness, const Eigen::VectorXd& mass, int k);

} // namespace bindpose

#endif

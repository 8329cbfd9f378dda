#ifndef bindpose_inside_lattice_tets_h
#define bindpose_inside_lattice_tets_h

// Tets by isosurface stuffing of a body-centered cubic lattice (Labelle and Shewchuk 2007).

#include "base/execution.h"
#include "geometry/mesh.h"
#include "winding/winding_number.h"

#include <functional>
#include <vector>

namespace bindpose
{

/// A body-centered cubic lattice: the corners and centers of cubes of side `spacing`. Each pair of
/// neighboring cubes gives four congruent tets around the shared face. The vertices of each tet are
/// the two cube centers and the ends of an edge of the face. The dihedral angles of a tet are 60
/// and 90 degrees, and its circumradius is 0.559 spacing.
struct Lattice
{
  Vec3 origin = Vec3::Zero(); ///< corner (0, 0, 0)
  double spacing = 1.0;
  std::array<Index, 3> cubes{ 0, 0, 0 };

  /// Return a lattice that covers the box and a margin of two cubes on every side. The longest side
  /// of the box is `resolution` cubes long.
  static Lattice around(const Box& box, Index resolution);
};

/// Return the vertices of a lattice, #N x 3: first the corners (x fastest), then the centers.
Points lattice_points(const Lattice& lattice);

/// Compute the winding numbers at the vertices of a lattice, #N, in the order of lattice_points().
/// @return canceled or ok.
Status sample_lattice(ExecutionContext& context, const WindingNumber& winding,
  const Lattice& lattice, Eigen::VectorXd& winding_numbers);

/// A region of space as the input of stuff_lattice().
struct LatticeRegion
{
  std::vector<char> inside; ///< #N: 1 for each lattice vertex in the region, else 0
  /// Report whether the point (1 - t) v + t w on a lattice edge from vertex v to vertex w is in the
  /// region. Called only if exactly one of the two ends is inside. Must be thread-safe.
  std::function<bool(Index v, Index w, double t)> contains;
  /// Number of bisection steps that find the point at which an edge leaves the region. The initial
  /// error is half of the edge, and each step halves it.
  int bisections = 8;
};

/// Compute tets of a region by isosurface stuffing, as described at the overload below.
/// @return canceled or ok.
Status stuff_lattice(
  ExecutionContext& context, const Lattice& lattice, const LatticeRegion& region, TetMesh& mesh);

/// Compute tets of the part of {w >= threshold} in the box by isosurface stuffing (Labelle and
/// Shewchuk, Isosurface Stuffing: Fast Tetrahedral Meshes with Good Dihedral Angles, 2007). Lattice
/// vertices near the isosurface are moved onto it. Then the tets that the isosurface still crosses
/// are cut. Every dihedral angle is between 10.7 and 164.8 degrees. Parts thinner than a lattice
/// cube are lost, and the vertices of the surface are not kept. Every surface works, because only
/// winding numbers are evaluated: about 2 per cube and 8 per cut edge. The mesh is empty if w is
/// below the threshold everywhere in the box.
/// @return canceled or ok.
Status stuff_lattice(ExecutionContext& context, const WindingNumber& winding,
  const Lattice& lattice, const Box& box, double threshold, TetMesh& mesh);

} // namespace bindpose

#endif

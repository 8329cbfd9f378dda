#ifndef bindpose_inside_lattice_tets_h
#define bindpose_inside_lattice_tets_h

#include "base/execution.h"
#include "base/mesh.h"
#include "winding/winding_number.h"

#include <functional>
#include <vector>

namespace bindpose
{

/// A body-centred cubic lattice: the corners and centres of cubes of side `spacing`. Each pair of
/// neighbouring cubes gives four equal tets around their common face (two centres and an edge of
/// the face each), dihedral angles 60 and 90 degrees, circumradius 0.559 spacing.
struct Lattice
{
  Vec3 origin = Vec3::Zero(); ///< corner (0, 0, 0)
  double spacing = 1.0;
  std::array<Index, 3> cubes{ 0, 0, 0 };

  /// Covers the box and a margin of two cubes on every side; `resolution` cubes along its longest
  /// side.
  static Lattice around(const Box& box, Index resolution);
};

/// The vertices of a lattice, #N x 3: corners first (x fastest), then centers.
Points lattice_points(const Lattice& lattice);

/// Winding numbers at the vertices of a lattice, #N, in the order of lattice_points().
/// @return cancelled or ok.
Status sample_lattice(const WindingNumber& winding, const Lattice& lattice,
  Eigen::VectorXd& winding_numbers, ExecutionContext& context);

/// A set of points, as far as stuff_lattice needs to know it.
struct LatticeRegion
{
  std::vector<char> inside; ///< #N: 1 for each lattice vertex in the set, else 0
  /// Whether the point (1 - t) v + t w of a lattice edge from vertex v to vertex w is in the set.
  /// Called only where one end is inside and the other is not. Thread-safe.
  std::function<bool(Index v, Index w, double t)> contains;
  /// Steps of the search for the place where an edge leaves the set; each halves the error, which
  /// starts at half of the edge.
  int bisections = 8;
};

/// Tets of a region by isosurface stuffing, see below.
/// @return cancelled or ok.
Status stuff_lattice(
  const Lattice& lattice, const LatticeRegion& region, TetMesh& mesh, ExecutionContext& context);

/// Tets of {w >= threshold}, as far as it lies in the box, by isosurface stuffing (Labelle and
/// Shewchuk, Isosurface Stuffing: Fast Tetrahedral Meshes with Good Dihedral Angles, 2007): lattice
/// vertices near the isosurface move onto it, the remaining tets that it cuts are cut. Every
/// dihedral angle is between 10.7 and 164.8 degrees. Parts thinner than a cube are lost. The
/// surface's vertices are not kept. Works for every surface: only winding numbers are asked for,
/// about 2 a cube and 8 a cut edge. No tets when w is below the threshold everywhere in the box.
/// @return cancelled or ok.
Status stuff_lattice(const WindingNumber& winding, const Lattice& lattice, const Box& box,
  double threshold, TetMesh& mesh, ExecutionContext& context);

} // namespace bindpose

#endif

#ifndef bindpose_winding_winding_cells_h
#define bindpose_winding_winding_cells_h

#include "base/execution.h"
#include "geometry/mesh.h"

#include <array>
#include <cstdint>
#include <vector>

namespace bindpose
{

/// A grid of nested cells for fast winding numbers of closed surfaces. The values are exact
/// integers.
///
/// Space is divided into cells until each cell contains few triangles. A cell without triangles
/// stores its constant winding number. Any other cell stores the winding number of one point, its
/// reference; the signed crossings of the segment from a query point to the reference give the
/// difference. A query takes tens of nanoseconds for every surface size.
class WindingCells
{
public:
  /// Build from triangles and the caps that close them (boundary_caps.h). Triangles and caps
  /// together must use every edge equally often in both directions. Points must be centered and
  /// scaled (ExactFrame), ids below 2^29. All three arguments are referenced, not copied.
  /// @return false if canceled.
  bool build(ExecutionContext& context, const Points& points, const Triangles& triangles,
    const Triangles& caps, double tolerance);

  /// Compute the winding numbers of up to `maximum_batch` points. Several points per call are
  /// faster, because memory for the next point is prefetched while the current one is processed.
  /// resolved[i] is false if point i touches a triangle or a cap, and for about one in 1e12 other
  /// points. The caller must use another method for unresolved points. Thread-safe.
  static constexpr Index maximum_batch = 32;
  void evaluate(const Vec3* points, Index number, int* counts, bool* resolved) const;

  /// Compute the winding numbers of the points (xs[0 … number), y, z). Consecutive points in one
  /// cell share the descent to the cell. The indices of unresolved points are appended to
  /// `unresolved`. Thread-safe.
  void evaluate_row(const double* xs, Index number, double y, double z, double* counts,
    std::vector<Index>& unresolved) const;

  /// Return the memory in use, in bytes.
  Index memory() const;

private:
  using Id = std::int32_t;
  static constexpr int lanes = 8;
  /// Planes of up to eight triangles, relative to the reference of a leaf. Each triangle has 13
  /// values: the normals of the three planes through the reference and an edge, the normal of the
  /// triangle's own plane, and the distance of this plane from the reference. The layout is a
  /// structure of arrays: each value is stored for all triangles before the next value.
  struct Block
  {
    static constexpr int values_per_plane = 13;
    static constexpr float fixed_point_one = 32767.0f; ///< stored length of a unit normal
    std::int16_t plane[values_per_plane * lanes];
  };
  /// Triangle ids, -1 if unused. Rarely accessed, so stored apart from the planes.
  using Faces = std::array<Id, lanes>;
  struct Leaf
  {
    Vec3 reference;
    float distance_scale; ///< factor from lengths to stored plane distances
    int count; ///< winding number at the reference
    Id begin, end; ///< range of the leaf's blocks
  };
  /// A box that is divided into a grid of cells; x varies fastest.
  struct Node
  {
    Vec3 lower;
    double inverse; ///< 1 / cell size
    std::array<Id, 3> size;
    Id first; ///< index of the node's first cell
  };
  enum Kind : std::uint32_t
  {
    empty_cell, ///< `value` is the constant winding number of the cell
    leaf_cell,
    node_cell
  };
  struct Cell
  {
    Id value : 30;
    std::uint32_t kind : 2;
  };
  /// Faces for which single precision cannot decide whether the segment crosses them.
  struct UndecidedFaces
  {
    static constexpr Id maximum = 32;
    std::array<Id, maximum> faces;
    /// Number of faces, which may exceed `maximum`; then only the first `maximum` faces are stored.
    Id number = 0;

    void add(Id face)
    {
      if (face >= 0 && this->number++ < maximum)
      {
        this->faces[this->number - 1] = face;
      }
    }
  };
  class Builder;

  std::array<Id, 3> cell_coordinates(const Node& node, const Vec3& p) const;
  const Cell& cell_at(const Node& node, const std::array<Id, 3>& coordinates) const
  {
    return this->arrays_.cells[node.first +
      (coordinates[2] * node.size[1] + coordinates[1]) * node.size[0] + coordinates[0]];
  }
  bool is_outside(const Vec3& p) const;
  std::array<Vec3, 3> corners(Id face) const;
  bool count_in_leaf(const Leaf& leaf, const Vec3& p, int& count) const;
  static int count_crossings(const Block* begin, const Block* end, const Faces* faces,
    float touching, const float* q, UndecidedFaces& undecided);

  const Points* points_ = nullptr;
  const Triangles* triangles_ = nullptr;
  const Triangles* caps_ = nullptr;
  double tolerance_ = 0.0;
  Vec3 lower_ = Vec3::Zero(); ///< outside this box the winding number is 0
  Vec3 upper_ = Vec3::Zero();
  struct Arrays
  {
    std::vector<Node> nodes; ///< the first node is the box around the whole surface
    std::vector<Cell> cells;
    std::vector<Leaf> leaves;
    std::vector<Block> blocks;
    std::vector<Faces> faces; ///< triangle ids of each block
  };
  Arrays arrays_;
};

} // namespace bindpose

#endif

#ifndef bindpose_winding_winding_cells_h
#define bindpose_winding_winding_cells_h

#include "base/execution.h"
#include "base/mesh.h"

#include <array>
#include <cstdint>
#include <vector>

namespace bindpose
{

/// Winding numbers of closed surfaces, whole numbers, exact.
///
/// Space is cut into cells until each holds few triangles. Where there are none the number is
/// known; elsewhere it is known at one place of the cell, its reference, and the signed crossings
/// of the segment from a point to it tell the rest. A point costs tens of nanoseconds whatever the
/// surface's size.
class WindingCells
{
public:
  /// Triangles and the caps that close them (boundary_caps.h); together every edge's directions
  /// cancel. Centred and scaled (ExactFrame), ids below 2^29. All three are referred to, not
  /// copied.
  /// @return false when cancelled.
  bool build(const Points& points, const Triangles& triangles, const Triangles& caps,
    double tolerance, ExecutionContext& context);

  /// For up to `most_at_once` points; more than one, and the memory for the next is on its way
  /// while one is looked at. told[i] is false for a point that touches a triangle or a cap (and
  /// for one in 1e12 others): ask somebody else. Thread-safe.
  static constexpr Index most_at_once = 32;
  void evaluate(const Vec3* points, Index number, int* counts, bool* told) const;

  /// The same for the points (xs[0 … number), y, z): neighbours in one cell share the way to it.
  /// Adds the places of points that it cannot tell to `untold`. Thread-safe.
  void evaluate_row(const double* xs, Index number, double y, double z, double* counts,
    std::vector<Index>& untold) const;

  /// Bytes held.
  Index memory() const;

private:
  using Id = std::int32_t;
  static constexpr int lanes = 8;
  /// Planes of up to eight triangles as seen from a leaf's reference: normals of those through the
  /// reference and an edge, then the triangle's own and how far that is; x of all triangles first.
  struct Block
  {
    static constexpr int numbers = 13;
    static constexpr float one = 32767.0f; ///< a length of 1 of a normal
    std::int16_t plane[numbers * lanes];
  };
  /// Their ids, -1 for none: seldom needed, so not in the way of what is.
  using Faces = std::array<Id, lanes>;
  struct Leaf
  {
    Vec3 reference;
    float per_length; ///< units of its planes' distances
    int count; ///< winding number at the reference
    Id begin, end; ///< blocks
  };
  /// A box of cells, x fastest.
  struct Node
  {
    Vec3 lower;
    double inverse; ///< of a cell's size
    std::array<Id, 3> size;
    Id first; ///< in the cells
  };
  enum Kind : std::uint32_t
  {
    holds_nothing, ///< value: the winding number
    holds_leaf,
    holds_node
  };
  struct Cell
  {
    Id value : 30;
    std::uint32_t kind : 2;
  };
  /// Faces that floats leave open.
  struct Unclear
  {
    static constexpr Id most = 32;
    std::array<Id, most> faces;
    Id number = 0; ///< more than `most`: not all are listed

    void add(Id face)
    {
      if (face >= 0 && this->number++ < most)
      {
        this->faces[this->number - 1] = face;
      }
    }
  };
  class Builder;

  std::array<Id, 3> place_of(const Node& node, const Vec3& p) const;
  const Cell& cell_at(const Node& node, const std::array<Id, 3>& place) const
  {
    return this->arrays_
      .cells[node.first + (place[2] * node.size[1] + place[1]) * node.size[0] + place[0]];
  }
  bool is_outside(const Vec3& p) const;
  std::array<Vec3, 3> corners(Id face) const;
  bool count_in(const Leaf& leaf, const Vec3& p, int& count) const;
  static int tally(const Block* begin, const Block* end, const Faces* faces, float touching,
    const float* q, Unclear& unclear);

  const Points* points_ = nullptr;
  const Triangles* triangles_ = nullptr;
  const Triangles* caps_ = nullptr;
  double tolerance_ = 0.0;
  Vec3 lower_ = Vec3::Zero(); ///< outside of the box the number is 0
  Vec3 upper_ = Vec3::Zero();
  struct Arrays
  {
    std::vector<Node> nodes; ///< the first is the whole
    std::vector<Cell> cells;
    std::vector<Leaf> leaves;
    std::vector<Block> blocks;
    std::vector<Faces> faces; ///< of each block
  };
  Arrays arrays_;
};

} // namespace bindpose

#endif

#ifndef bindpose_winding_dipole_field_h
#define bindpose_winding_dipole_field_h

#include "base/execution.h"
#include "solid_angle/solid_angle.h"
#include "solid_angle/triangle_block.h"

#include <cstdint>

namespace bindpose
{

/// Winding number of oriented triangles with integer multiplicities, within a tolerance. It is the
/// potential of a double layer, computed by a fast multipole method (Greengard and Rokhlin, 1987;
/// expansions and error estimates after Dehnen, A fast multipole method for stellar dynamics,
/// 2014).
///
/// The build divides a cube around the triangles and the region of the query points into the cells
/// of an octree. A leaf cell stores one polynomial for the triangles far from it and a list of the
/// triangles near it. The solid angles of the near triangles are summed. The cells are fixed after
/// the build, so the value at a point does not depend on which other points are evaluated. A value
/// costs a descent in the octree, a polynomial, and 1-5 ns per near triangle. Outside the cube, a
/// value is the sum of a few multipoles.
///
/// Triangles that touch a point contribute 0 (the principal value).
class DipoleField
{
public:
  struct Options
  {
    /// Largest error of a value, 1e-8 … 0.1. The build reduces the errors at sample points to half
    /// of this value.
    double tolerance = 1e-3;
    /// Region that contains most query points; empty: the box of the triangles. Points outside the
    /// region take more time.
    Box region;
    /// Smallest cell size, 0.2 … 10; 0: chosen from the tolerance. The unit is the mean size of the
    /// nearby blocks of eight triangles. Smaller cells are faster near the triangles and take more
    /// memory.
    double finest_cell = 0.0;
    /// Degree of the polynomials, 2 … 14; 0: chosen from the tolerance.
    int order = 0;
    /// Number of points that will be evaluated; 0: very many. Most of them should be in `region`.
    /// The build splits a cell only if the split takes less time than it saves in the evaluation of
    /// these points. For up to a few thousand points the cube is not divided, and every value is
    /// the sum over all triangles.
    Index expected_points = 0;
  };

  /// Report whether the expected number of points (0: very many) is so small that every value is
  /// computed as the sum over all triangles.
  static bool uses_direct_sum(Index expected_points);

  /// Build the field. The points must be centered and scaled to a size of about 1, and they must
  /// outlive the field. Their ids must be below 2^31. There is one multiplicity per triangle. A
  /// triangle touches a point if their distance is at most touch_tolerance. Cost: O(#F log #F); on
  /// one thread 20 us per triangle at a tolerance of 1e-3, and 50 us per triangle if the triangles
  /// are the caps of a few surface patches. Memory: 0.8 to 3 kB per triangle. Fields of few
  /// triangles need the most memory per triangle, because their cells are finer.
  /// @return false if canceled; the field is then empty.
  bool build(ExecutionContext& context, const Points& points, const Triangles& triangles,
    const std::vector<int>& multiplicities, double touch_tolerance, const Options& options);

  /// Return the value at a finite point. It is a pure function of the point. Thread-safe, does not
  /// allocate.
  double evaluate(const Vec3& point, bool* on_surface = nullptr) const;
  /// Compute the values of many points, bit-identical to the single evaluations. One call for many
  /// points is faster, because the memory accesses of several points overlap. It is fastest if
  /// consecutive points are near each other.
  void evaluate(const Vec3* points, Index count, double* out, bool* on_surface) const;

  /// Compute the values of a row of points with equal y and z, bit-identical to the single
  /// evaluations. The polynomials are contracted to polynomials in x, which take a few nanoseconds
  /// per point. This is fastest if x is sorted. If `on_surface` is not null, its entries are set to
  /// 1 for points that touch a triangle, otherwise to 0.
  void evaluate_row(const double* x, double y, double z, Index count, double* out,
    unsigned char* on_surface = nullptr) const;
  /// Compute the values at the points first + i * step.
  void evaluate_row(const Vec3& first, const Vec3& step, Index count, double* out,
    unsigned char* on_surface = nullptr) const;

  /// Return the derivative of the value, without the jump across triangles. Cost: like evaluate(),
  /// but ~30 ns per near triangle.
  Vec3 gradient(const Vec3& point) const;

  /// Return the largest error that the build measured on its sample points: corners of the cells
  /// with the largest estimated errors, points near the triangles, and points in and around the
  /// cells.
  double measured_error() const { return this->measured_error_; }
  /// Return the degree of the polynomials.
  int order() const { return this->order_; }
  /// Return the memory in use, in bytes.
  Index memory() const;

private:
  using Id = std::int32_t;
  static constexpr int finest_level = 20;
  /// A group of triangles. Its multipoles are used at points outside the cube of the cells.
  struct OuterNode
  {
    Vec3 center = Vec3::Zero();
    /// The error of the multipoles at distance r is bound / ((1 - radius / r) r^(order + 3)).
    double bound = 0.0;
    double radius = 0.0;
    /// Index of the node after this node's descendants; the first child is the next node.
    Id skip = 0;
    BlockRun blocks{ 0, 0 };
    bool leaf = false;
  };
  using Corners = std::array<Vec3, 3>;
  /// Coordinates of a cell, in units of the smallest possible cell.
  using CellCoordinates = std::array<std::uint32_t, 3>;
  struct Leaf
  {
    Id id;
    /// Number of bits. CellCoordinates in the leaf, shifted right by this number of bits, are the
    /// coordinates of the leaf on its level of the octree.
    int shift;
    double inverse; ///< 2 divided by the edge length of the leaf
    Vec3 center;
  };
  struct Builder;
  class AccurateSum;

  Corners corners(Index slot) const;
  Index block_count() const;
  bool is_in_cells(const Vec3& point) const;
  std::uint32_t cell_coordinate(double x, int axis) const;
  Leaf leaf_at(const CellCoordinates& at) const;
  Leaf leaf_at(const Vec3& point) const;
  template <typename Use>
  auto with_coefficients(Id leaf, const Use& use) const;
  void contract(const Leaf& leaf, double y, double z, double* polynomial) const;
  double near_sum(const BlockRun* runs, Index count, const Vec3& point, bool& on_surface) const;
  /// Return the sum of the solid angles of all triangles, each computed as exactly as possible.
  double exact_sum(const Vec3& point) const;
  double outer_sum(const Vec3& point, bool& on_surface) const;
  /// Call use_moments(moments, offset) for nodes that are far from the point, and all(run) for the
  /// triangles of the leaf nodes that are not far.
  template <typename UseMoments, typename All>
  void visit_outer(const Vec3& point, const UseMoments& use_moments, const All& all) const;

  const Points* points_ = nullptr;
  std::vector<Vec3> extra_points_; ///< vertices of cut triangles; their ids follow those of points_
  std::vector<std::array<Id, 3>> ids_; ///< vertex ids of every lane of every block
  double touch_tolerance_ = 0.0;
  double outer_threshold_ = 0.0; ///< largest allowed error of a multipole outside the cube
  double measured_error_ = 0.0;
  int order_ = 0;
  bool double_precision_ = false; ///< whether blocks and cells use doubles instead of floats

  // Blocks and coefficients are stored either as floats or as doubles, so one vector of each pair
  // is empty.
  std::vector<TriangleBlock<float>> float_blocks_;
  std::vector<TriangleBlock<double>> double_blocks_;
  std::vector<float> float_locals_;
  std::vector<double> double_locals_;

  // The cube with the lower corner `lower_` and the edge length `size_` is divided into a grid of
  // 2^top_level_ top cells per axis. Each top cell is the root of an octree. `cells_` has one entry
  // per cell, beginning with the top cells. For a leaf the entry is ~(index of the leaf). For any
  // other cell it is the index of the first child of the cell.
  Vec3 lower_ = Vec3::Zero();
  double size_ = 0.0;
  int top_level_ = 0;
  std::vector<Id> cells_;
  /// Index of each leaf's first run in runs_; the last entry is the number of runs.
  std::vector<Id> first_run_;
  std::vector<BlockRun> runs_;

  std::vector<OuterNode> outer_;
  std::vector<double> outer_moments_;
};

} // namespace bindpose

#endif

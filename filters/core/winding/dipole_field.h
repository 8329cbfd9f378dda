#ifndef bindpose_winding_dipole_field_h
#define bindpose_winding_dipole_field_h

#include "base/execution.h"
#include "winding/solid_angle.h"
#include "winding/triangle_block.h"

#include <cstdint>

namespace bindpose
{

/// The winding number of any oriented triangles, each counted a whole number of times, within a
/// tolerance: the potential of a double layer, by a fast multipole method (Greengard and Rokhlin,
/// 1987; expansions and error estimates after Dehnen, A fast multipole method for stellar dynamics,
/// 2014).
///
/// Space is cut into fixed cells. A cell keeps one polynomial for everything far from it and a list
/// of the triangles near it, whose solid angles are summed. So a value depends on its point only,
/// and costs a descent, a polynomial and 1-5 ns a near triangle. Points outside the cells sum a few
/// multipoles.
///
/// Triangles that touch a point count 0 (the principal value).
class DipoleField
{
public:
  struct Options
  {
    /// Largest error of a value, 1e-8 … 0.1. Built for half of it, as measured on a sample.
    double tolerance = 1e-3;
    /// Where most points will be asked for; the triangles' own box is added. Elsewhere a point
    /// costs more.
    Box region;
    /// Cells are split down to this many times the size of a group of eight triangles, 0.2 … 10:
    /// smaller is faster near the triangles, and takes more memory.
    double finest_cell = 0.0; ///< 0: chosen by the tolerance
    /// Degree of the polynomials, 2 … 14. 0: chosen by the tolerance.
    int order = 0;
    /// Number of points that will be evaluated, most of them in the region; 0: very many. Cells
    /// are split only where that saves so many points more time than it takes, and none are made
    /// for up to some thousand points, which sum all triangles.
    Index expected_points = 0;
  };

  /// Whether that many expected points (0: very many) are so few that all triangles are summed.
  static bool sums_all(Index expected_points);

  /// Points centred and scaled to a size of about 1, ids below 2^31; a multiplicity a triangle.
  /// Points must outlive the field. A triangle touches a point within touch_tolerance.
  /// Cost: O(#F log #F), on one thread 20 us a triangle at 1e-3 and 50 us for the caps of few
  /// patches; memory 0.8 to 3 kB a triangle, fields of few being finer.
  /// @return false when cancelled: the field is empty then.
  bool build(const Points& points, const Triangles& triangles,
    const std::vector<int>& multiplicities, double touch_tolerance, const Options& options,
    ExecutionContext& context);

  /// Thread-safe, allocates nothing, a pure function of the point. Not for points that are not
  /// finite.
  double evaluate(const Vec3& point, bool* on_surface = nullptr) const;
  /// The same bits for many points at once, which then wait less for memory; fastest when points
  /// one after another lie next to each other.
  void evaluate(const Vec3* points, Index count, double* out, bool* on_surface) const;

  /// The same bits for a row of points that share y and z: the polynomials are contracted to one in
  /// x, a few nanoseconds a point. Fastest with x in order. `on_surface` is 0 or 1 a point, or
  /// null.
  void evaluate_row(const double* x, double y, double z, Index count, double* out,
    unsigned char* on_surface = nullptr) const;
  /// The same for the points first + i * step.
  void evaluate_row(const Vec3& first, const Vec3& step, Index count, double* out,
    unsigned char* on_surface = nullptr) const;

  /// Derivative of the value; the jump across a triangle is left out. Cost: like evaluate(), but
  /// ~30 ns a near triangle.
  Vec3 gradient(const Vec3& point) const;

  /// Largest error on the sample that the build tried: corners of the cells that err most by
  /// estimate, points near the triangles and around them.
  double measured_error() const { return this->measured_error_; }
  /// Degree of the polynomials.
  int order() const { return this->order_; }
  /// Bytes held.
  Index memory() const;

private:
  using Id = std::int32_t;
  static constexpr int finest_level = 20;
  /// Group of triangles that points outside the cells see as multipoles.
  struct OuterNode
  {
    Vec3 center = Vec3::Zero();
    double bound = 0.0; ///< error at distance r: bound / r^(order + 3)
    double radius = 0.0;
    Id skip = 0; ///< where to go on when this node is done; the next one is its first child
    BlockRun blocks{ 0, 0 };
    bool leaf = false;
  };
  using Corners = std::array<Vec3, 3>;
  using Place = std::array<std::uint32_t, 3>; ///< in units of the smallest possible cell
  struct Leaf
  {
    Id id;
    int shift; ///< a place within, shifted by it, is the leaf's among those of its level
    double inverse; ///< of half its size
    Vec3 center;
  };
  struct Build;
  class Careful;

  Corners corners(Index slot) const;
  Index block_count() const;
  bool in_cells(const Vec3& point) const;
  std::uint32_t place(double x, int axis) const;
  Leaf leaf_at(const Place& at) const;
  Leaf leaf_at(const Vec3& point) const;
  template <typename Use>
  auto with_numbers(Id leaf, const Use& use) const;
  void contract(const Leaf& leaf, double y, double z, double* polynomial) const;
  double near_sum(const BlockRun* runs, Index count, const Vec3& point, bool& on_surface) const;
  /// Of all triangles, each as exact as can be.
  double exact_sum(const Vec3& point) const;
  double outer_sum(const Vec3& point, bool& on_surface) const;
  /// Calls see(moments, offset) for nodes that are far from the point, all(run) for the others.
  template <typename See, typename All>
  void visit_outer(const Vec3& point, const See& see, const All& all) const;

  const Points* points_ = nullptr;
  std::vector<Vec3> extra_points_; ///< of triangles that were cut; ids follow those of points
  std::vector<std::array<Id, 3>> ids_; ///< of every lane of every block
  double touch_tolerance_ = 0.0;
  double outer_threshold_ = 0.0; ///< of a multipole's error outside the cells
  double measured_error_ = 0.0;
  int order_ = 0;
  bool fine_ = false; ///< doubles in blocks and cells, else floats

  // One of each pair is empty.
  std::vector<TriangleBlock<float>> float_blocks_;
  std::vector<TriangleBlock<double>> double_blocks_;
  std::vector<float> float_locals_;
  std::vector<double> double_locals_;

  // Octree below a lattice of top cells. A cell's entry: its first child, or ~leaf.
  Vec3 lower_ = Vec3::Zero();
  double size_ = 0.0;
  int top_level_ = 0;
  std::vector<Id> cells_;
  std::vector<Id> first_run_; ///< of each leaf in runs_, and the end
  std::vector<BlockRun> runs_;

  std::vector<OuterNode> outer_;
  std::vector<double> outer_moments_;
};

} // namespace bindpose

#endif

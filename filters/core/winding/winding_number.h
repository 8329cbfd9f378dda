#ifndef bindpose_winding_winding_number_h
#define bindpose_winding_winding_number_h

#include "base/execution.h"
#include "base/mesh.h"
#include "base/sample_grid.h"
#include "winding/surface_boundary.h"

#include <memory>

namespace bindpose
{

/// How winding numbers are computed. All ways but fast give the same numbers up to round-off.
enum class WindingMethod
{
  automatic, ///< exact for closed surfaces and where that is soon done, else fast
  exact, ///< the soonest of the three exact ways for this surface, by its counts
  fast, ///< crossings, and what caps take off within a tolerance; ~0.2 us a point
  direct, ///< exact: sum over all triangles; no build; ~20 ns x #F a point
  hierarchical, ///< exact: tree of boxes with caps; tens of microseconds a point for 100k triangles
  crossings ///< exact: crossings and all caps; ~40 ns + 20 ns x #open edges a point
};

/// "automatic", "exact", "fast", "direct", "hierarchical", "crossings".
const char* to_string(WindingMethod method);

/// Generalized winding number of a triangle mesh (Jacobson, Kavan, Sorkine-Hornung, 2013): how many
/// times the surface wraps around a point, 1/(4 pi) times the signed solid angle of all triangles.
///
/// Any triangles will do: closed, open, crossing, doubled, non-manifold, a soup; their orientation
/// is what counts (counter-clockwise seen from outside gives +1 inside). Closed surfaces give whole
/// numbers, open ones fall off smoothly through their holes.
///
/// - **On the surface**: triangles that touch the point count 0, the principal value: 1/2 on a
///   face, 1/4 on an edge and 1/8 at a vertex of a cube. A triangle touches a point within a few
///   units in the last place of the largest coordinate (2^-49 of it).
/// - **Degenerate triangles** count 0 and are counted in the report; equal vertices are merged.
/// - **Precision**: double; coordinates are shifted and scaled without rounding. About 1e-14 plus
///   1e-16 times the sum of the triangles' unsigned shares; fast: the tolerance.
/// - **Cost**: build O(#F log #F), 86k triangles 0.07 s, about 130 bytes a triangle; see
///   WindingMethod for a point's cost. On a grid a closed surface costs some nanoseconds a sample.
///
/// Build once, evaluate often; evaluation is thread-safe and deterministic for any thread count.
class WindingNumber
{
public:
  struct Options
  {
    WindingMethod method = WindingMethod::automatic;
    /// Largest error of the fast method, 1e-8 … 0.1.
    double tolerance = 1e-3;
    /// Triangles of a tree node that is not split further, 1 … 10000.
    Index max_leaf_size = 64;
    /// Number of points that will be evaluated in total, 0 … 2^62; 0: unknown, taken as very many.
    /// Decides how much the build prepares, so that build and evaluation together take the least
    /// time. A wrong number costs time, never accuracy. Values of the fast method depend on it
    /// within the tolerance: give all parts of a grid the whole grid's number.
    Index expected_queries = 0;
  };

  WindingNumber();
  /// Builds on all cores; how it went is in status().
  WindingNumber(PointsView points, TrianglesView triangles);
  ~WindingNumber();
  WindingNumber(WindingNumber&&) noexcept;
  WindingNumber& operator=(WindingNumber&&) noexcept;

  /// Takes a copy of what it needs: #V x 3 points, #F x 3 ids.
  /// invalid_input: a coordinate that is not finite, an id out of range, more than 2^29 triangles
  /// or 2^31 - 1 points, an option out of its range. An empty mesh is valid and winds 0 times
  /// around everything; a warning says so. The status reports method, method_reason, for fast
  /// error_bound (the tolerance) and measured_error (on a sample of the build's own),
  /// counts.vertices, .triangles, .boundary_edges (used by one triangle), .nonmanifold_edges,
  /// .open_edges (directions do not cancel: what makes the winding number fractional), .components,
  /// .merged_vertices, .degenerate_triangles, .duplicate_triangles, and volume (by the divergence
  /// theorem, holes filled by caps).
  Status build(
    PointsView points, TrianglesView triangles, ExecutionContext& context, const Options& options);
  Status build(PointsView points, TrianglesView triangles, ExecutionContext& context)
  {
    return this->build(points, triangles, context, Options());
  }

  /// The last build's status.
  const Status& status() const;
  /// What was chosen or asked for: fast, direct, hierarchical or crossings.
  WindingMethod method() const;
  /// Where the surface is open, by ids of the input (the same vertex for equal points), and its
  /// connected parts.
  const SurfaceBoundary& boundary() const;
  /// Bytes held.
  Index memory() const;

  /// Winding numbers of #Q x 3 points. A point that is not finite gets NaN, and a warning. Reports
  /// counts.queries, counts.on_surface and, when there are any, counts.not_finite.
  /// cancelled: `out` is not complete.
  Status evaluate(PointsView queries, ExecutionContext& context, Eigen::VectorXd& out) const;
  /// The same for a grid's samples, x fastest.
  Status evaluate(const SampleGrid& grid, ExecutionContext& context, Eigen::VectorXd& out) const;
  /// The same into memory of the caller's for #Q or grid.count() numbers, and 1 for every point
  /// that touches a triangle, else 0 (unless null).
  Status evaluate(PointsView queries, ExecutionContext& context, double* out,
    unsigned char* on_surface = nullptr) const;
  Status evaluate(const SampleGrid& grid, ExecutionContext& context, double* out,
    unsigned char* on_surface = nullptr) const;
  /// Derivatives along x, y, z, #Q x 3 or grid.count() x 3 numbers: those of the smooth part, the
  /// jump across the surface left out; 0 for closed surfaces, and at a boundary edge, where they
  /// have no end. Within about 10 x tolerance / (distance to the boundary) for the fast method.
  /// cancelled: `out` is not complete. Cost: 10 ns x #open edges a point; fast: about a value's.
  Status evaluate_gradient(PointsView queries, ExecutionContext& context, double* out) const;
  Status evaluate_gradient(const SampleGrid& grid, ExecutionContext& context, double* out) const;

  /// At one point; NaN when it is not finite. Thread-safe, allocates nothing.
  double evaluate_at(const Vec3& point, bool* on_surface = nullptr) const;
  /// The same, exactly whatever the method: slower when that is fast.
  double evaluate_exactly_at(const Vec3& point, bool* on_surface = nullptr) const;

private:
  struct Parts;
  template <typename PointAt>
  Status evaluate_points(Index count, const PointAt& point_at, ExecutionContext& context,
    double* out, unsigned char* on_surface) const;
  template <typename PointAt>
  Status evaluate_gradients(
    Index count, const PointAt& point_at, ExecutionContext& context, double* out) const;

  Status evaluate_rows(const SampleGrid& grid, ExecutionContext& context, double* out,
    unsigned char* on_surface) const;

  std::unique_ptr<Parts> parts_;
};

/// Reference: the plain sum over all triangles, no build, the same principal values. 0 without
/// triangles; the mesh must be valid (check_mesh). Cost: ~25 ns x #F.
double winding_number_direct(
  PointsView points, TrianglesView triangles, const Vec3& point, bool* on_surface = nullptr);

} // namespace bindpose

#endif

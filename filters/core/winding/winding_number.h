#ifndef bindpose_winding_winding_number_h
#define bindpose_winding_winding_number_h

// Generalized winding numbers of triangle meshes (Jacobson, Kavan, Sorkine-Hornung 2013).

#include "base/execution.h"
#include "geometry/mesh.h"
#include "geometry/sample_grid.h"
#include "winding/surface_boundary.h"

#include <memory>

namespace bindpose
{

/// Methods to compute winding numbers. All methods except `fast` return the same numbers up to
/// round-off.
enum class WindingMethod
{
  automatic, ///< exact if there are at most 24 triangles or 12 open edges, otherwise fast
  /// The fastest of the three exact methods, chosen from the numbers of triangles and open edges.
  exact,
  /// Ray crossings minus a DipoleField of the caps, accurate within the tolerance; ~0.2 us per
  /// point.
  fast,
  direct, ///< exact: sum over all triangles; no build time; ~20 ns x #F per point
  /// Exact: tree of boxes. For a point outside of a box, a cap replaces the triangles in the box.
  /// Tens of microseconds per point for 100k triangles.
  hierarchical,
  /// Exact: ray crossings minus the sum over all caps. Time per point: ~40 ns, plus ~20 ns per open
  /// edge.
  crossings
};

/// Return "automatic", "exact", "fast", "direct", "hierarchical" or "crossings".
const char* to_string(WindingMethod method);

/// Generalized winding number of a triangle mesh (Jacobson, Kavan, Sorkine-Hornung, 2013): how many
/// times the surface wraps around a point. It is 1/(4 pi) times the sum of the signed solid angles
/// of all triangles.
///
/// The triangles may be closed, open, intersecting, duplicated, non-manifold or a soup. Their
/// orientation determines the sign: if triangles are counter-clockwise as seen from outside, the
/// winding number is +1 inside. Closed surfaces give integers; the values of open surfaces vary
/// smoothly through their holes.
///
/// - **On the surface**: triangles that touch the point contribute 0 (the principal value). For
///   example, the value is 1/2 on a face of a cube, 1/4 on an edge and 1/8 at a vertex. A triangle
///   touches a point if their distance is at most 2^-49 times the largest coordinate, that is, a
///   few units in the last place.
/// - **Degenerate triangles** contribute 0; their number is reported. Equal vertices are merged.
/// - **Precision**: double. Coordinates are shifted and scaled without rounding. The error is about
///   1e-14 plus 1e-16 times the sum of the absolute winding numbers of the single triangles. The
///   error of the fast method is at most the tolerance.
/// - **Cost**: build O(#F log #F), 0.07 s for 86k triangles, about 130 bytes per triangle.
///   WindingMethod lists the cost per point. On a grid, one sample of the winding number of a
///   closed surface takes some nanoseconds.
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
    /// Largest leaf of the tree of boxes, 1 … 10000 triangles. A box with at most this many
    /// triangles is not split further.
    Index max_leaf_size = 64;
    /// Total number of points that will be evaluated, 0 … 2^62; 0: unknown, treated as very many.
    /// The build uses this number to minimize the total time of build and evaluation. A wrong
    /// number costs time but no accuracy. The values of the fast method change with this number,
    /// within the tolerance. For parts of a grid, always use the number of samples of the whole
    /// grid.
    Index expected_queries = 0;
    /// Box that contains most query points. Its corners must be finite. If it is empty, the
    /// bounding box of the surface is used, enlarged by a tenth of its diagonal. A smaller box
    /// saves build time of the fast method. Points outside the box take more time.
    Box query_region;
  };

  WindingNumber();
  /// Build on all cores; status() reports the result.
  WindingNumber(PointsView points, TrianglesView triangles);
  ~WindingNumber();
  WindingNumber(WindingNumber&&) noexcept;
  WindingNumber& operator=(WindingNumber&&) noexcept;

  /// Build from copies of #V x 3 points and #F x 3 ids. Return invalid_input if a coordinate is not
  /// finite, an id is out of range, there are 2^29 or more triangles or more than 2^31 - 1 points,
  /// or an option is out of its range. An empty mesh is valid and has the winding number 0
  /// everywhere; a warning reports it. The status reports method, method_reason, counts.vertices,
  /// .triangles, .boundary_edges (used by one triangle), .nonmanifold_edges, .open_edges (edges
  /// not used equally often in both directions; such edges make the winding number fractional),
  /// .components, .merged_vertices, .degenerate_triangles, .duplicate_triangles, and volume (by the
  /// divergence theorem, with holes closed by caps). For the fast method it also reports
  /// error_bound (the tolerance) and measured_error (the largest error at sample points that the
  /// build chooses).
  Status build(
    ExecutionContext& context, PointsView points, TrianglesView triangles, const Options& options);
  Status build(ExecutionContext& context, PointsView points, TrianglesView triangles)
  {
    return this->build(context, points, triangles, Options());
  }

  /// Return the status of the last build.
  const Status& status() const;
  /// Return the method in use: fast, direct, hierarchical or crossings.
  WindingMethod method() const;
  /// Return the boundary edges and the connected components of the surface. Vertex ids are those of
  /// the input; equal points have the same id.
  const SurfaceBoundary& boundary() const;
  /// Return the memory in use, in bytes.
  Index memory() const;

  /// Compute the winding numbers of #Q x 3 points. A point that is not finite gets NaN and causes a
  /// warning. The status reports counts.queries, counts.on_surface and, if it is not 0,
  /// counts.not_finite. If the returned status is canceled, `out` is incomplete.
  Status evaluate(ExecutionContext& context, PointsView queries, Eigen::VectorXd& out) const;
  /// Compute the winding numbers at the samples of a grid; x varies fastest.
  Status evaluate(ExecutionContext& context, const SampleGrid& grid, Eigen::VectorXd& out) const;
  /// Write the winding numbers to `out`, which the caller allocates for #Q or grid.count() values.
  /// If `on_surface` is not null, set its entries to 1 for points that touch a triangle, otherwise
  /// to 0.
  Status evaluate(ExecutionContext& context, PointsView queries, double* out,
    unsigned char* on_surface = nullptr) const;
  Status evaluate(ExecutionContext& context, const SampleGrid& grid, double* out,
    unsigned char* on_surface = nullptr) const;
  /// Compute the derivatives of the winding number along x, y and z, #Q x 3 or grid.count() x 3.
  /// The jump across the surface is excluded, so the derivatives of closed surfaces are 0. The
  /// derivatives are unbounded near a boundary edge; an edge that touches the point contributes 0.
  /// The error of the fast method is about 10 x tolerance / (distance to the boundary). If the
  /// returned status is canceled, `out` is incomplete. Cost: 10 ns x #open edges per point. With
  /// the fast method, a gradient takes about as long as a winding number.
  Status evaluate_gradient(ExecutionContext& context, PointsView queries, double* out) const;
  Status evaluate_gradient(ExecutionContext& context, const SampleGrid& grid, double* out) const;

  /// Return the winding number at one point, or NaN if the point is not finite. Thread-safe, does
  /// not allocate.
  double evaluate_at(const Vec3& point, bool* on_surface = nullptr) const;
  /// Return the exact winding number at one point, independently of the method in use. Slower than
  /// evaluate_at() if the method is fast.
  double evaluate_exactly_at(const Vec3& point, bool* on_surface = nullptr) const;

private:
  struct Impl;
  template <typename PointAt>
  Status evaluate_points(ExecutionContext& context, Index count, const PointAt& point_at,
    double* out, unsigned char* on_surface) const;
  template <typename PointAt>
  Status evaluate_gradients(
    ExecutionContext& context, Index count, const PointAt& point_at, double* out) const;

  Status evaluate_rows(ExecutionContext& context, const SampleGrid& grid, double* out,
    unsigned char* on_surface) const;

  std::unique_ptr<Impl> impl_;
};

/// Return the winding number as the plain sum over all triangles, without a build. For a point on
/// the surface, the value is the same as that of WindingNumber. This is the reference
/// implementation. The mesh must be valid (check_mesh); the result is 0 without triangles. Cost:
/// ~25 ns x #F.
double winding_number_direct(
  PointsView points, TrianglesView triangles, const Vec3& point, bool* on_surface = nullptr);

} // namespace bindpose

#endif

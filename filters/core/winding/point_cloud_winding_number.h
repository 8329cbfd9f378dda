#ifndef bindpose_winding_point_cloud_winding_number_h
#define bindpose_winding_point_cloud_winding_number_h

#include "winding/winding_number.h"

namespace bindpose
{

/// #P numbers, one a point.
using NumbersView = MatrixView<Eigen::VectorXd>;

/// Winding number of oriented points, samples of a surface (Barill, Dickson, Schmidt, Levin,
/// Jacobson, Fast Winding Numbers for Soups and Clouds, 2018): the sum over all points of
///
///   area n . (p - q) / (4 pi |p - q|^3)
///
/// at q, with each point's normal n (outwards gives +1 inside) and the area that it stands for.
///
/// - **Near the samples** this sum is singular by nature, and nothing is done about it: within
///   about one spacing of the samples (reported) its values mean nothing, and towards each sample
///   they grow without bound. Measured on a sphere, largest errors: evenly spread samples 0.1 half
///   a spacing away, 2e-2 at one, 2e-3 at two spacings; random samples 0.4 at one, 0.2 at two, 0.05
///   at eight.
/// - **On a sample**: a point at the very place of samples (within 2^-49 of the largest coordinate)
///   gets the sum over all others, and is flagged.
/// - **Normals** of any length count as directions; normals of length 0 count 0, and are counted.
/// - **Precision**: double; coordinates are shifted and scaled without rounding. The fast method
///   keeps its tolerance at every point, by a bound that it adds up beside the value; round-off,
///   1e-16 of the points' unsigned shares, is not in it. Measured errors are some ten times
///   smaller.
/// - **Cost** for 100k points on one core: build 0.15 s, estimated areas 0.3 s more, 90 bytes a
///   point. A value within 1e-3: 4 us, near the points 8 us; within 1e-5: 6 and 10 us; the plain
///   sum: 90 us.
///
/// Build once, evaluate often; evaluation is thread-safe and deterministic for any thread count.
class PointCloudWindingNumber
{
public:
  struct Options
  {
    /// direct, exact (both: the plain sum), fast (within the tolerance), or automatic: direct up to
    /// 3000 points, else fast. The other methods are for triangles.
    WindingMethod method = WindingMethod::automatic;
    /// Largest error of the fast method, 1e-8 … 0.1.
    double tolerance = 1e-3;
    /// Neighbours that bound a point's area where areas are not given, 3 … 64.
    Index area_neighbors = 20;
  };

  PointCloudWindingNumber();
  PointCloudWindingNumber(PointCloudWindingNumber&&) noexcept;
  PointCloudWindingNumber& operator=(PointCloudWindingNumber&&) noexcept;
  ~PointCloudWindingNumber();

  /// Takes a copy of what it needs: #P x 3 points, #P x 3 normals, and #P areas or none: then they
  /// are estimated, see estimate_point_areas().
  /// invalid_input: numbers that are not finite, a negative area, unequal counts, a single point
  /// without an area, areas out of all proportion to the points' distances, options out of range,
  /// 2^29 points or more. No point is valid and winds 0 times around everything; a warning says so.
  /// The status reports method, method_reason, for fast error_bound (the tolerance) and
  /// measured_error (largest difference from the plain sum on a sample of the build's own, near the
  /// points and around them), counts.points, .zero_normals, .zero_areas, area (of all), spacing
  /// (square root of the mean area) and volume (by the divergence theorem).
  Status build(PointsView points, PointsView normals, NumbersView areas, ExecutionContext& context,
    const Options& options);
  Status build(PointsView points, PointsView normals, NumbersView areas, ExecutionContext& context)
  {
    return this->build(points, normals, areas, context, Options());
  }

  /// The last build's status.
  const Status& status() const;
  /// fast or direct.
  WindingMethod method() const;
  /// #P areas, given or estimated.
  const Eigen::VectorXd& areas() const;
  /// Bytes held.
  Index memory() const;

  /// Winding numbers of #Q x 3 points, and 1 for every point on a sample, else 0 (unless null),
  /// into memory of the caller's. A point that is not finite gets NaN, and a warning. Reports
  /// counts.queries, counts.on_surface and, when there are any, counts.not_finite.
  /// cancelled: `out` is not complete.
  Status evaluate(PointsView queries, ExecutionContext& context, double* out,
    unsigned char* on_surface = nullptr) const;
  Status evaluate(PointsView queries, ExecutionContext& context, Eigen::VectorXd& out) const;
  /// The same for a grid's samples, x fastest.
  Status evaluate(const SampleGrid& grid, ExecutionContext& context, double* out,
    unsigned char* on_surface = nullptr) const;

  /// Derivatives along x, y, z, #Q x 3 or grid.count() x 3 numbers, NaN at points that are not
  /// finite. As singular near the samples as the value, and more: it goes with the distance's third
  /// power. Samples at the very place of a point have no share in it. Within 10 x tolerance /
  /// (distance to the nearest sample) for the fast method, as measured. cancelled: `out` is not
  /// complete. Cost: about twice a value's.
  Status evaluate_gradient(PointsView queries, ExecutionContext& context, double* out) const;
  Status evaluate_gradient(const SampleGrid& grid, ExecutionContext& context, double* out) const;

  /// At one point; NaN when it is not finite. Thread-safe, allocates nothing.
  double evaluate_at(const Vec3& point, bool* on_surface = nullptr) const;
  /// The same by the plain sum, whatever the method.
  double evaluate_exactly_at(const Vec3& point, bool* on_surface = nullptr) const;

private:
  struct Parts;
  template <typename PointAt>
  Status evaluate_points(Index count, const PointAt& point_at, ExecutionContext& context,
    double* out, unsigned char* on_surface) const;
  template <typename PointAt>
  Status evaluate_gradients(
    Index count, const PointAt& point_at, ExecutionContext& context, double* out) const;

  std::unique_ptr<Parts> parts_;
};

} // namespace bindpose

#endif

#ifndef bindpose_inside_point_cloud_winding_number_h
#define bindpose_inside_point_cloud_winding_number_h

#include "inside/winding_number.h"

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
///   about one spacing of the samples (reported) its values mean nothing, and they grow without
///   bound towards each sample. Two spacings away they are those of the surface to about 1e-2 and
///   soon better, if the samples lie evenly.
/// - **On a sample**: a point at the very place of samples (within 2^-49 of the largest coordinate)
///   gets the sum over all others, and is flagged.
/// - **Normals** of any length count as directions; normals of length 0 count 0, and are counted.
/// - **Precision**: double; coordinates are shifted and scaled without rounding.
/// - **Cost**: build O(#P log #P), see WindingMethod::fast and direct below for a point.
///
/// Build once, evaluate often; evaluation is thread-safe and deterministic for any thread count.
class PointCloudWindingNumber
{
public:
  struct Options
  {
    /// direct, exact (both: the plain sum, 1 ns x #P a point), fast (within the tolerance), or
    /// automatic: direct for few points. The other methods are for triangles.
    WindingMethod method = WindingMethod::automatic;
    /// Largest error of the fast method, 1e-8 … 0.1.
    double tolerance = 1e-3;
    /// Neighbours that bound a point's area where areas are not given, 3 … 64.
    Index area_neighbors = 12;
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

  /// At one point; NaN when it is not finite. Thread-safe, allocates nothing.
  double evaluate_at(const Vec3& point, bool* on_surface = nullptr) const;
  /// The same by the plain sum, whatever the method.
  double evaluate_exactly_at(const Vec3& point, bool* on_surface = nullptr) const;

private:
  struct Parts;
  template <typename PointAt>
  Status evaluate_points(Index count, const PointAt& point_at, ExecutionContext& context,
    double* out, unsigned char* on_surface) const;

  std::unique_ptr<Parts> parts_;
};

} // namespace bindpose

#endif

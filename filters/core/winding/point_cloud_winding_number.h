#ifndef bindpose_winding_point_cloud_winding_number_h
#define bindpose_winding_point_cloud_winding_number_h

#include "winding/winding_number.h"

namespace bindpose
{

/// #P numbers, one per point.
using NumbersView = MatrixView<Eigen::VectorXd>;

/// Winding number of oriented points that sample a surface (Barill, Dickson, Schmidt, Levin,
/// Jacobson, Fast Winding Numbers for Soups and Clouds, 2018). It is the sum over all points p of
///
///   area n . (p - q) / (4 pi |p - q|^3)
///
/// at the query point q. n is the normal of p (outwards gives +1 inside), and area is the surface
/// area that p represents.
///
/// - **Near the samples** the sum is singular, and the values are not corrected. Within about one
///   spacing of the samples (reported) the values are meaningless, and they grow without bound
///   toward each sample. Largest errors, measured on a sphere: for evenly spread samples 0.1 at
///   half a spacing, 2e-2 at one and 2e-3 at two spacings; for random samples 0.4 at one, 0.2 at
///   two and 0.05 at eight spacings.
/// - **On a sample**: a point at the position of samples (within 2^-49 of the largest coordinate)
///   gets the sum over all other samples and is flagged.
/// - **Normals** of any length count as directions. Normals of length 0 count 0 and are counted in
///   the report.
/// - **Precision**: double. Coordinates are shifted and scaled without rounding. The fast method
///   keeps its tolerance at every point, by an error bound that it computes with the value. The
///   bound does not include round-off, which is 1e-16 of the sum of the points' absolute
///   contributions. Measured errors are some ten times smaller than the tolerance.
/// - **Cost** for 100k points on one core: build 0.15 s, plus 0.3 s to estimate areas, and 90 bytes
///   per point. A value within 1e-3 takes 4 us, near the points 8 us. A value within 1e-5 takes 6
///   us, near the points 10 us. The plain sum takes 90 us.
///
/// Build once, evaluate often; evaluation is thread-safe and deterministic for any thread count.
class PointCloudWindingNumber
{
public:
  struct Options
  {
    /// direct or exact (both are the plain sum), fast (within the tolerance), or automatic: direct
    /// for up to 3000 points, otherwise fast. The other methods are for triangles.
    WindingMethod method = WindingMethod::automatic;
    /// Largest error of the fast method, 1e-8 … 0.1.
    double tolerance = 1e-3;
    /// Number of neighbors that bound a point's area if areas are not given, 3 … 64.
    Index area_neighbors = 20;
  };

  PointCloudWindingNumber();
  PointCloudWindingNumber(PointCloudWindingNumber&&) noexcept;
  PointCloudWindingNumber& operator=(PointCloudWindingNumber&&) noexcept;
  ~PointCloudWindingNumber();

  /// Build from copies of #P x 3 points, #P x 3 normals and #P areas. Without areas they are
  /// estimated, see estimate_point_areas().
  /// invalid_input: a number is not finite, an area is negative, the counts differ, a single point
  /// has no area, the areas are far too large for the distances between the points, an option is
  /// out of its range, or there are 2^29 points or more. An empty cloud is valid and has the
  /// winding number 0 everywhere; a warning reports it.
  /// The status reports method, method_reason, counts.points, .zero_normals, .zero_areas, area (of
  /// all points), spacing (square root of the mean area) and volume (by the divergence theorem).
  /// For the fast method it also reports error_bound (the tolerance) and measured_error, the
  /// largest difference from the plain sum on a sample that the build chooses near the points and
  /// around them.
  Status build(PointsView points, PointsView normals, NumbersView areas, ExecutionContext& context,
    const Options& options);
  Status build(PointsView points, PointsView normals, NumbersView areas, ExecutionContext& context)
  {
    return this->build(points, normals, areas, context, Options());
  }

  /// Return the status of the last build.
  const Status& status() const;
  /// Return the method in use: fast or direct.
  WindingMethod method() const;
  /// Return #P areas, given or estimated.
  const Eigen::VectorXd& areas() const;
  /// Return the memory in use, in bytes.
  Index memory() const;

  /// Write the winding numbers of #Q x 3 points to `out`, memory of the caller. Unless it is null,
  /// `on_surface` gets 1 for every point on a sample, else 0. A point that is not finite gets NaN
  /// and causes a warning. The status reports counts.queries, counts.on_surface and, if it is not
  /// 0, counts.not_finite.
  /// canceled: `out` is incomplete.
  Status evaluate(PointsView queries, ExecutionContext& context, double* out,
    unsigned char* on_surface = nullptr) const;
  Status evaluate(PointsView queries, ExecutionContext& context, Eigen::VectorXd& out) const;
  /// Compute the winding numbers of the samples of a grid, x fastest.
  Status evaluate(const SampleGrid& grid, ExecutionContext& context, double* out,
    unsigned char* on_surface = nullptr) const;

  /// Compute the derivatives along x, y and z, #Q x 3 or grid.count() x 3 numbers, NaN at points
  /// that are not finite. Near a sample they grow with the third power of the inverse distance,
  /// faster than the value. Samples at the position of the point add nothing. The measured error of
  /// the fast method is at most 10 x tolerance / (distance to the nearest sample).
  /// canceled: `out` is incomplete. Cost: about twice that of a value.
  Status evaluate_gradient(PointsView queries, ExecutionContext& context, double* out) const;
  Status evaluate_gradient(const SampleGrid& grid, ExecutionContext& context, double* out) const;

  /// Return the winding number at one point, or NaN if the point is not finite. Thread-safe, does
  /// not allocate.
  double evaluate_at(const Vec3& point, bool* on_surface = nullptr) const;
  /// Return the plain sum at one point, with every method.
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

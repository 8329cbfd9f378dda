#ifndef bindpose_winding_point_cloud_winding_number_h
#define bindpose_winding_point_cloud_winding_number_h

// Winding numbers of oriented point clouds (Barill, Dickson, Schmidt, Levin, Jacobson 2018).

#include "winding/winding_number.h"

namespace bindpose
{

/// #P values, one per point.
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
///   spacing of the samples (`spacing` in the report) the values are meaningless. They grow without
///   bound toward each sample. Largest errors, measured on a sphere: for evenly spread samples 0.1
///   at half a spacing, 2e-2 at one and 2e-3 at two spacings; for random samples 0.4 at one, 0.2 at
///   two and 0.05 at eight spacings.
/// - **On a sample**: the value at the position of a sample (within 2^-49 of the largest
///   coordinate) is the sum over all other samples. Such a query point is flagged.
/// - **Normals** may have any length; they are normalized. Points with a normal of length 0
///   contribute 0; their number is reported.
/// - **Precision**: double. Coordinates are shifted and scaled without rounding. The error of the
///   fast method is within the tolerance at every point, because the method computes an error bound
///   with each value. The bound does not include round-off, which is 1e-16 of the sum of the
///   points' absolute contributions. Measured errors are some ten times smaller than the tolerance.
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
    /// direct or exact: the plain sum. fast: a sum with errors up to the tolerance. automatic:
    /// direct for up to 3000 points, otherwise fast. The other values of WindingMethod require
    /// triangles.
    WindingMethod method = WindingMethod::automatic;
    /// Largest error of the fast method, 1e-8 … 0.1.
    double tolerance = 1e-3;
    /// Number of nearest neighbors, 3 … 64, from which the area of a point is estimated. Used only
    /// if no areas are specified.
    Index area_neighbors = 20;
  };

  PointCloudWindingNumber();
  PointCloudWindingNumber(PointCloudWindingNumber&&) noexcept;
  PointCloudWindingNumber& operator=(PointCloudWindingNumber&&) noexcept;
  ~PointCloudWindingNumber();

  /// Build from copies of #P x 3 points, #P x 3 normals and #P areas. If `areas` is empty, areas
  /// are estimated, see estimate_point_areas(). Return invalid_input if a value is not finite, an
  /// area is negative, the three arrays have different lengths, the cloud is a single point without
  /// a specified area, the areas are far too large for the distances between the points, an option
  /// is out of its range, or there are 2^29 points or more. An empty cloud is valid and has the
  /// winding number 0 everywhere; a warning reports it. The status reports method, method_reason,
  /// counts.points, .zero_normals, .zero_areas, area (of all points), spacing (square root of the
  /// mean area) and volume (by the divergence theorem). For the fast method it also reports
  /// error_bound (the tolerance) and measured_error, the largest difference from the plain sum at
  /// test points that the build chooses near the cloud and around it.
  Status build(ExecutionContext& context, PointsView points, PointsView normals, NumbersView areas,
    const Options& options);
  Status build(ExecutionContext& context, PointsView points, PointsView normals, NumbersView areas)
  {
    return this->build(context, points, normals, areas, Options());
  }

  /// Return the status of the last build.
  const Status& status() const;
  /// Return the method in use: fast or direct.
  WindingMethod method() const;
  /// Return #P areas, specified or estimated.
  const Eigen::VectorXd& areas() const;
  /// Return the memory in use, in bytes.
  Index memory() const;

  /// Write the winding numbers of #Q x 3 points to `out`, which the caller allocates. If
  /// `on_surface` is not null, set its entries to 1 for query points on a sample, otherwise to 0. A
  /// point that is not finite gets NaN and causes a warning. The status reports counts.queries,
  /// counts.on_surface and, if it is not 0, counts.not_finite. If the returned status is canceled,
  /// `out` is incomplete.
  Status evaluate(ExecutionContext& context, PointsView queries, double* out,
    unsigned char* on_surface = nullptr) const;
  Status evaluate(ExecutionContext& context, PointsView queries, Eigen::VectorXd& out) const;
  /// Compute the winding numbers at the samples of a grid; x varies fastest.
  Status evaluate(ExecutionContext& context, const SampleGrid& grid, double* out,
    unsigned char* on_surface = nullptr) const;

  /// Compute the derivatives of the winding number along x, y and z, #Q x 3 or grid.count() x 3.
  /// They are NaN at points that are not finite. Near a sample they grow with the third power of
  /// the inverse distance, faster than the value. Samples at the position of the query point
  /// contribute 0. The measured error of the fast method is at most 10 x tolerance / (distance to
  /// the nearest sample). If the returned status is canceled, `out` is incomplete. Cost: about
  /// twice the cost of a value.
  Status evaluate_gradient(ExecutionContext& context, PointsView queries, double* out) const;
  Status evaluate_gradient(ExecutionContext& context, const SampleGrid& grid, double* out) const;

  /// Return the winding number at one point, or NaN if the point is not finite. Thread-safe, does
  /// not allocate.
  double evaluate_at(const Vec3& point, bool* on_surface = nullptr) const;
  /// Return the plain sum at one point, independently of the method in use.
  double evaluate_exactly_at(const Vec3& point, bool* on_surface = nullptr) const;

private:
  struct Impl;
  template <typename PointAt>
  Status evaluate_points(ExecutionContext& context, Index count, const PointAt& point_at,
    double* out, unsigned char* on_surface) const;
  template <typename PointAt>
  Status evaluate_gradients(
    ExecutionContext& context, Index count, const PointAt& point_at, double* out) const;

  std::unique_ptr<Impl> impl_;
};

} // namespace bindpose

#endif

// Computes the sample grid that a user requests. The grid is centered on the requested box. If the
// box is not a whole number of voxels wide, the grid extends equally beyond both ends.
#include "grid_request.h"

#include <cmath>
#include <limits>
#include <sstream>

namespace bindpose
{

namespace
{
/// Upper limit of the number of samples; as doubles, they would take 8 TB. A larger request is
/// probably a typing error.
constexpr double maximum_samples = 1e12;

/// Return the number of samples along each side of a box. `step` contains the distances between
/// samples. The 1e-9 keeps rounding from adding a sample to a side whose length is a multiple of
/// the distance.
Vec3 sample_counts(const Vec3& size, const Vec3& step)
{
  return (size.cwiseQuotient(step).array() - 1e-9).ceil().max(0.0) + 1.0;
}

/// Return the smallest sample distance of a grid of cubic voxels with at most `count` samples.
double step_for_count(const Vec3& size, double count)
{
  double fine = 0.0;
  double coarse = size.maxCoeff();
  for (int i = 0; i < 100; ++i)
  {
    const double middle = 0.5 * (fine + coarse);
    const bool fits = middle > 0.0 && sample_counts(size, Vec3::Constant(middle)).prod() <= count;
    (fits ? coarse : fine) = middle;
  }
  return coarse;
}
} // namespace

Status make_grid(const GridRequest& request, const Box& data_bounds, SampleGrid& grid)
{
  const double* b = request.bounds;
  const int* n = request.dimensions;
  const Eigen::Map<const Vec3> spacing(request.spacing);
  const bool has_bounds = b[0] <= b[1] && b[2] <= b[3] && b[4] <= b[5];
  const bool has_dimensions = n[0] != 0 || n[1] != 0 || n[2] != 0;
  const bool has_spacing = (spacing.array() != 0.0).any();
  if (has_dimensions && (n[0] < 1 || n[1] < 1 || n[2] < 1))
  {
    return Status::invalid_input("each of the grid's dimensions must be at least 1");
  }
  if (has_spacing && !(spacing.allFinite() && spacing.minCoeff() > 0.0))
  {
    return Status::invalid_input("the grid's spacing must be greater than 0 along each axis");
  }
  if (request.count < 0 || (request.count > 0 && request.count < 8))
  {
    return Status::invalid_input("the grid must have at least 8 samples");
  }
  Box box = data_bounds;
  if (has_bounds)
  {
    box.lower = Vec3(b[0], b[2], b[4]);
    box.upper = Vec3(b[1], b[3], b[5]);
    if (!box.lower.allFinite() || !box.upper.allFinite())
    {
      return Status::invalid_input("the grid's bounds must be finite numbers");
    }
  }
  else
  {
    const double padding = request.padding * data_bounds.diagonal();
    box.lower.array() -= padding;
    box.upper.array() += padding;
  }
  if (request.flat_axis >= 0)
  {
    box.lower[request.flat_axis] = box.upper[request.flat_axis] =
      data_bounds.center()[request.flat_axis];
  }

  const Vec3 size = box.size();
  const double longest = size.maxCoeff();
  Vec3 count;
  if (has_dimensions)
  {
    count = Vec3(n[0], n[1], n[2]);
    // If a side has a single sample, the sample is in the middle of the side.
    const Vec3 step =
      (count.array() > 1.0).select((size.array() / (count.array() - 1.0)).matrix(), Vec3::Zero());
    const double largest = step.maxCoeff() > 0.0 ? step.maxCoeff() : 1.0;
    grid.spacing = Vec3::Constant(largest);
    if (has_bounds)
    {
      grid.spacing = (step.array() > 0.0).select(step, grid.spacing);
    }
  }
  else
  {
    const double side = request.count > 0
      ? step_for_count(size, static_cast<double>(request.count))
      : longest / static_cast<double>(request.samples_along_longest_side - 1);
    grid.spacing = has_spacing ? Vec3(spacing) : Vec3::Constant(longest > 0.0 ? side : 1.0);
    count = sample_counts(size, grid.spacing);
  }
  if (request.flat_axis >= 0)
  {
    count[request.flat_axis] = 1.0;
  }
  if (!(count.prod() <= maximum_samples && count.maxCoeff() <= std::numeric_limits<int>::max()))
  {
    std::ostringstream text;
    text << "the grid would have " << count.prod()
         << " samples, which is too many; use a coarser grid";
    return Status::invalid_input(text.str());
  }
  for (int k = 0; k < 3; ++k)
  {
    grid.extent[2 * k] = 0;
    grid.extent[2 * k + 1] = static_cast<Index>(count[k]) - 1;
  }
  grid.origin = box.center() - 0.5 * grid.spacing.cwiseProduct(count - Vec3::Ones());
  return {};
}

} // namespace bindpose

// If a surface is bent with weights from a coarse lattice, its shading must be smooth. The shading
// must not show the facets of the lattice tets. The reference is the shading with weights from
// conforming tets. The test measures lightness and needs no baseline.
#include "render/drawing.h"
#include "render/harness.h"
#include "render/shapes.h"

#include "conversion.h"
#include "helper/mesher_process.h"
#include "support/meshes.h"
#include "weights/bounded_biharmonic_weights.h"
#include "weights/surface_weights.h"
#include "transfer/transfer.h"

#include "vtkImageData.h"
#include "vtkPolyData.h"

#include <Eigen/Geometry>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace bindpose;
using namespace bindpose::test;

namespace
{
/// Return a spindle from z = -1 to 1. Its triangles are much smaller than the cubes of the lattice.
TriangleMesh spindle()
{
  TriangleMesh mesh = sphere(5);
  mesh.points.leftCols(2) *= 0.45;
  return mesh;
}

Handles three_handles_on_axis()
{
  Handles handles(3);
  const char* const names[] = { "bottom", "middle", "top" };
  for (int k = 0; k < 3; ++k)
  {
    handles[k].name = names[k];
    handles[k].head = handles[k].tail = Vec3(0, 0, 0.8 * (k - 1));
  }
  return handles;
}

/// Bend the shape by linear blend skinning: the end handles are rotated by -40 and 40 degrees about
/// the y axis.
Points bent_points(const Points& rest, const Weights& weights)
{
  Points posed(rest.rows(), 3);
  for (Index v = 0; v < rest.rows(); ++v)
  {
    Vec3 position = Vec3::Zero();
    for (int k = 0; k < 3; ++k)
    {
      const Eigen::AngleAxisd rotation((k - 1) * 40.0 * M_PI / 180.0, Vec3::UnitY());
      position += weights(v, k) * (rotation * Vec3(rest.row(v)));
    }
    posed.row(v) = position.transpose();
  }
  return posed;
}

Drawing draw_bent(const TriangleMesh& mesh, const Weights& weights)
{
  PictureOptions options = small_picture();
  options.width = 600;
  options.height = 600;
  const Points posed = bent_points(mesh.points, weights);
  return draw({ { to_polydata(posed, mesh.triangles), nullptr, "" } }, options);
}

/// Return the roughness of the shading, in levels of 255: the root mean square of the second
/// differences of the lightness between pixels at a distance of 4. Pixels near the silhouette are
/// skipped. The roughness is near zero for smooth shading and large at the borders of facets.
double roughness(const Drawing& drawing)
{
  int size[3];
  drawing.image->GetDimensions(size);
  constexpr int h = 4;
  constexpr int outline = 24;
  const auto inside = [&](int x, int y) { return !is_background(pixel_at(drawing.image, x, y)); };
  const auto lightness_at = [&](int x, int y) { return lightness(pixel_at(drawing.image, x, y)); };
  double sum = 0.0;
  long long count = 0;
  for (int y = outline; y + outline < size[1]; ++y)
  {
    for (int x = outline; x + outline < size[0]; ++x)
    {
      if (inside(x - outline, y) && inside(x + outline, y) && inside(x, y - outline) &&
        inside(x, y + outline))
      {
        const double here = 2.0 * lightness_at(x, y);
        const double across = lightness_at(x - h, y) + lightness_at(x + h, y) - here;
        const double along = lightness_at(x, y - h) + lightness_at(x, y + h) - here;
        sum += across * across + along * along;
        count += 2;
      }
    }
  }
  EXPECT_GT(count, 40000) << "the shape fills the picture";
  return std::sqrt(sum / static_cast<double>(count));
}
} // namespace

TEST(Render, no_facets_of_the_embedding)
{
  ASSERT_FALSE(find_mesher().empty()) << "bindpose-mesher is not built: libcgal-dev, libtet1.5-dev";
  const TriangleMesh mesh = spindle();
  const auto solve = [&](WeightsDomain domain, SurfaceWeights& result)
  {
    SurfaceWeightsOptions options;
    options.domain = domain;
    options.resolution = 12;
    options.check_resolution = false;
    ExecutionContext context;
    const Status status = surface_weights(
      context, mesh.points, mesh.triangles, {}, three_handles_on_axis(), options, {},
      [](ExecutionContext& method_context, const WeightsProblem& problem, WeightsResult& weights)
      { return bounded_biharmonic_weights(method_context, problem, {}, weights); },
      result);
    ASSERT_TRUE(status.usable()) << status.message;
    EXPECT_EQ(status.report.text("tetrahedralize.method"),
      domain == WeightsDomain::volume ? "cdt" : "embed");
  };
  SurfaceWeights conforming;
  SurfaceWeights embedded;
  solve(WeightsDomain::volume, conforming);
  solve(WeightsDomain::embedding, embedded);
  // Weights that are interpolated linearly in each lattice tet make the facets visible.
  Weights linear;
  ExecutionContext context;
  TransferCounts counts;
  ASSERT_TRUE(transfer(
    context, embedded.problem.mesh.domain, embedded.solved.weights, mesh.points, {}, linear, counts)
                .ok());
  const double conforming_roughness = roughness(draw_bent(mesh, conforming.weights));
  const double embedded_roughness = roughness(draw_bent(mesh, embedded.weights));
  const double linear_roughness = roughness(draw_bent(mesh, linear));
  RecordProperty("conforming", std::to_string(conforming_roughness));
  RecordProperty("embedded", std::to_string(embedded_roughness));
  RecordProperty("linear", std::to_string(linear_roughness));
  // The measured roughness is 0.778 levels for conforming tets, 0.782 for the embedding and 1.172
  // for linear interpolation. Without smoothing along the surface, the embedding gives 0.834.
  EXPECT_LT(embedded_roughness, 1.03 * conforming_roughness) << "facets are seen";
  EXPECT_GT(linear_roughness, 1.3 * conforming_roughness)
    << "what is looked for is not there to be found";
}

// Segmentation of tets into inside and outside: the energy is compared with brute force.
#include "segmentation/segmentation.h"

#include "geometry/tet_facets.h"
#include "segmentation/graph_cut.h"

#include "support/meshes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace bindpose;
using namespace bindpose::test;

namespace
{
Segmentation segmented(
  const TetMesh& mesh, const Eigen::VectorXd& w, SegmentationOptions options = {})
{
  ExecutionContext context;
  Segmentation result;
  const Status status = segment_tets(context, mesh.points, mesh.tets, w, options, result);
  EXPECT_TRUE(status.ok()) << status.message;
  return result;
}

/// Evaluate the energy as segmentation.h defines it, with a loop over all pairs of tets.
double reference_energy(const TetMesh& mesh, const Eigen::VectorXd& w, const SegmentationOptions& o,
  const std::vector<char>& inside)
{
  double data = 0.0;
  for (Index t = 0; t < mesh.tets.rows(); ++t)
  {
    const double shifted = w[t] - o.winding_threshold + 0.5;
    data += inside[t] ? std::max(1.0 - shifted, 0.0) : std::max(shifted, 0.0);
  }
  double cut = 0.0;
  double areas = 0.0;
  Index facets = 0;
  for (Index i = 0; i < mesh.tets.rows(); ++i)
  {
    for (Index j = 0; j < i; ++j)
    {
      std::vector<Index> common;
      for (int a = 0; a < 4; ++a)
      {
        for (int b = 0; b < 4; ++b)
        {
          if (mesh.tets(i, a) == mesh.tets(j, b))
          {
            common.push_back(mesh.tets(i, a));
          }
        }
      }
      if (common.size() != 3)
      {
        continue;
      }
      const Vec3 p = mesh.points.row(common[0]);
      const Vec3 q = mesh.points.row(common[1]);
      const Vec3 r = mesh.points.row(common[2]);
      const double area = 0.5 * (q - p).cross(r - p).norm();
      areas += area;
      ++facets;
      if (inside[i] != inside[j])
      {
        cut += area * std::exp(-std::pow(w[i] - w[j], 2.0) / (2.0 * o.cut_sigma * o.cut_sigma));
      }
    }
  }
  return data + o.cut_smoothness * cut / (areas / static_cast<double>(facets));
}

Eigen::VectorXd noisy_winding_numbers(Index count, Random& random)
{
  Eigen::VectorXd w(count);
  for (Index t = 0; t < count; ++t)
  {
    w[t] = random.uniform(-0.5, 1.8);
  }
  return w;
}
} // namespace

TEST(Segmentation, EqualsBruteForce)
{
  Random random(3);
  for (int instance = 0; instance < 240; ++instance)
  {
    // The boxes have 6, 12 or 18 tets and random side lengths.
    TetMesh mesh = tet_box(1 + static_cast<int>(random.below(3)), 1, 1, Vec3::Zero(),
      random.in_box(Vec3::Constant(0.2), Vec3::Constant(3.0)));
    if (mesh.tets.rows() > 12 && instance % 4 != 0)
    {
      mesh = tet_box(2, 1, 1); // brute force is slow for 18 tets (2^18 labelings)
    }
    const Eigen::VectorXd w = noisy_winding_numbers(mesh.tets.rows(), random);
    SegmentationOptions options;
    options.winding_threshold = random.uniform(0.3, 0.9);
    options.cut_smoothness = random.uniform(0.0, 2.0);
    options.cut_sigma = random.uniform(0.05, 1.0);
    const Segmentation found = segmented(mesh, w, options);
    // Compute the costs of single tets and of facets only once. The energy of each labeling is then
    // a sum of these costs.
    CutEnergy energy;
    const auto nodes = static_cast<std::size_t>(mesh.tets.rows());
    std::vector<char> labels(nodes, 0);
    const double none = reference_energy(mesh, w, options, labels);
    for (std::size_t t = 0; t < nodes; ++t)
    {
      const double shifted = w[static_cast<Index>(t)] - options.winding_threshold + 0.5;
      energy.inside_costs.push_back(std::max(1.0 - shifted, 0.0));
      energy.outside_costs.push_back(std::max(shifted, 0.0));
    }
    std::vector<double> alone; // energy of the facets if only this tet is inside
    for (std::size_t t = 0; t < nodes; ++t)
    {
      labels.assign(nodes, 0);
      labels[t] = 1;
      alone.push_back(reference_energy(mesh, w, options, labels) - none - energy.inside_costs[t] +
        energy.outside_costs[t]);
    }
    for (std::size_t s = 0; s < nodes; ++s)
    {
      for (std::size_t t = 0; t < s; ++t)
      {
        labels.assign(nodes, 0);
        labels[s] = labels[t] = 1;
        const double both = reference_energy(mesh, w, options, labels) - none -
          energy.inside_costs[s] + energy.outside_costs[s] - energy.inside_costs[t] +
          energy.outside_costs[t];
        const double between = 0.5 * (alone[s] + alone[t] - both);
        if (between > 1e-12)
        {
          energy.edges.push_back({ static_cast<Index>(s), static_cast<Index>(t), between });
        }
      }
    }
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t mask = 0; mask < (std::size_t(1) << nodes); ++mask)
    {
      for (std::size_t t = 0; t < nodes; ++t)
      {
        labels[t] = (mask >> t) & 1;
      }
      least = std::min(least, energy.evaluate(labels));
    }
    ASSERT_NEAR(found.energy, least, 1e-9) << "instance " << instance;
    ASSERT_NEAR(found.energy, reference_energy(mesh, w, options, found.inside), 1e-9);
    ASSERT_LE(found.energy, found.threshold_energy);
  }
}

TEST(Segmentation, NoSmoothnessIsTheThreshold)
{
  Random random(4);
  const TetMesh mesh = tet_box(5, 4, 3);
  const Eigen::VectorXd w = noisy_winding_numbers(mesh.tets.rows(), random);
  SegmentationOptions smooth, plain;
  smooth.cut_smoothness = 0.0;
  plain.method = SegmentationMethod::threshold;
  const Segmentation a = segmented(mesh, w, smooth);
  const Segmentation b = segmented(mesh, w, plain);
  EXPECT_EQ(a.inside, b.inside);
  EXPECT_EQ(a.changed, 0);
  EXPECT_EQ(b.changed, 0);
  for (Index t = 0; t < w.size(); ++t)
  {
    EXPECT_EQ(b.inside[t], w[t] >= 0.5);
  }
}

TEST(Segmentation, FillsPitsAndDropsSpecks)
{
  // The left half is inside, the right half outside, except for one noisy tet in each half.
  const TetMesh mesh = tet_box(8, 4, 4);
  Eigen::VectorXd w(mesh.tets.rows());
  Index pit = -1;
  Index speck = -1;
  for (Index t = 0; t < w.size(); ++t)
  {
    Vec3 center = Vec3::Zero();
    for (int k = 0; k < 4; ++k)
    {
      center += 0.25 * mesh.points.row(mesh.tets(t, k)).transpose();
    }
    w[t] = center[0] < 0.5 ? 1.0 : 0.0;
    const bool middle = (center - Vec3(center[0], 0.5, 0.5)).cwiseAbs().maxCoeff() < 0.2;
    pit = middle && center[0] < 0.2 ? t : pit;
    speck = middle && center[0] > 0.8 ? t : speck;
  }
  ASSERT_GE(pit, 0);
  ASSERT_GE(speck, 0);
  const Eigen::VectorXd clean = w;
  w[pit] = 0.45;
  w[speck] = 0.55;
  SegmentationOptions options;
  options.cut_sigma = 0.5;
  const Segmentation cut = segmented(mesh, w, options);
  EXPECT_EQ(cut.changed, 2);
  EXPECT_LT(cut.energy, cut.threshold_energy);
  for (Index t = 0; t < w.size(); ++t)
  {
    EXPECT_EQ(cut.inside[t], clean[t] == 1.0);
  }
}

TEST(Segmentation, ScaleAndOrderDoNotMatter)
{
  Random random(5);
  const TetMesh mesh = tet_box(4, 4, 4);
  const Eigen::VectorXd w = noisy_winding_numbers(mesh.tets.rows(), random);
  const Segmentation first = segmented(mesh, w);
  for (const double scale : { 1e-9, 1e9 })
  {
    TetMesh other = mesh;
    other.points *= scale;
    EXPECT_EQ(segmented(other, w).inside, first.inside);
  }
  TetMesh backwards = mesh;
  backwards.tets = mesh.tets.colwise().reverse().eval();
  const Segmentation reversed = segmented(backwards, w.reverse());
  for (Index t = 0; t < w.size(); ++t)
  {
    EXPECT_EQ(reversed.inside[w.size() - 1 - t], first.inside[t]);
  }
}

TEST(Segmentation, OptionsOutOfRange)
{
  const TetMesh mesh = tet_box(1, 1, 1);
  ExecutionContext context;
  Segmentation result;
  SegmentationOptions options;
  const Eigen::VectorXd inside = Eigen::VectorXd::Ones(6);
  const auto code = [&]
  { return segment_tets(context, mesh.points, mesh.tets, inside, options, result).code; };
  options.cut_sigma = 0.0;
  EXPECT_EQ(code(), StatusCode::invalid_input);
  options.cut_sigma = 0.1;
  options.cut_smoothness = -1.0;
  EXPECT_EQ(code(), StatusCode::invalid_input);
  options.cut_smoothness = 1.0;
  EXPECT_EQ(code(), StatusCode::ok);
  for (const double threshold : { 0.0, -1.0, std::nan(""), HUGE_VAL })
  {
    options.winding_threshold = threshold;
    EXPECT_EQ(code(), StatusCode::invalid_input) << threshold;
  }
}

// Fuzz test of skinning and as-rigid-as-possible solvers with sequences of extreme poses. Handles
// are collapsed, mirrored or huge, and weights are repeated, zero or negative. Finite input gives
// finite output, the rest pose gives the rest shape, and results are deterministic.
#include "arap/full_arap.h"
#include "arap/reduced_arap.h"
#include "skinning/skinning.h"

#include "core/arap/arap_cases.h"
#include "support/bars.h"
#include "support/fuzz.h"
#include "support/handles.h"

#include <algorithm>
#include <cmath>

using namespace bindpose;
using namespace bindpose::test;

namespace
{
/// Return 1 with probability 1/3, else 10^x with a random x in [-exponent, exponent].
double random_scale(Random& random, double exponent)
{
  return chance(random, 0.33) ? 1.0 : std::pow(10.0, random.uniform(-exponent, exponent));
}

Affine transform(Random& random, double exponent)
{
  if (chance(random, 0.15))
  {
    return identity_affine();
  }
  const Vec3 ones = Vec3::Ones();
  static const double special[] = { 0.0, 90.0, 180.0, -180.0, 360.0, 1e-7 };
  const double degrees =
    chance(random, 0.4) ? special[random.below(6)] : random.uniform(-360.0, 360.0);
  const Vec3 axis =
    chance(random, 0.3) ? Vec3(Vec3::Unit(random.below(3))) : random.in_box(-ones, ones);
  Affine t = rigid(degrees, axis, random_scale(random, exponent) * random.in_box(-ones, ones));
  switch (random.below(6))
  {
    case 0:
      t.leftCols<3>() *= random_scale(random, exponent);
      break;
    case 1: // non-uniform scaling, mirrored, or collapsed to a plane or line
      for (int k = 0; k < 3; ++k)
      {
        t.col(k) *= chance(random, 0.3) ? 0.0 : random.uniform(-2.0, 2.0);
      }
      break;
    case 2: // shear
      t.col(random.below(3)) += random.uniform(-3.0, 3.0) * t.col(random.below(3));
      break;
    case 3:
      t.leftCols<3>() *= chance(random, 0.5) ? -1.0 : 0.0;
      break;
    default: // rigid motion
      break;
  }
  return t;
}

/// Turn some handles into bones. Some bones have the same tail. Other tails are at random vertices
/// or at random points inside or outside of the shape. Some bones are very short.
void make_bones(Random& random, const TetMesh& mesh, Handles& handles)
{
  const Box box = bounding_box(mesh.points);
  const Vec3 meeting = random.in_box(box.lower, box.upper);
  for (Handle& handle : handles)
  {
    if (chance(random, 0.5))
    {
      continue;
    }
    handle.kind = HandleKind::bone;
    switch (random.below(4))
    {
      case 0:
        handle.tail = meeting;
        break;
      case 1:
        handle.tail = mesh.points.row(random.below(mesh.points.rows()));
        break;
      case 2: // short bone
        handle.tail = handle.head + 1e-4 * random.in_box(-Vec3::Ones(), Vec3::Ones());
        break;
      default:
        handle.tail = random.in_box(1.2 * box.lower, 1.2 * box.upper);
        break;
    }
    const bool twice = std::any_of(handles.begin(), handles.end(),
      [&](const Handle& other) { return other.head == handle.tail && other.tail == handle.head; });
    if (twice)
    {
      // Move the tail, because the bone has length zero, or because another bone connects the same
      // two points in the opposite direction.
      handle.tail += Vec3(0.1, 0.2, 0.3);
    }
  }
}

/// Set a random mode that the handle supports and a random transform. For bones, also set a random
/// stretch and twist.
void randomize_pose(Random& random, double exponent, const Handle& handle, HandlePose& pose)
{
  const bool bone = handle.kind == HandleKind::bone;
  pose.mode = static_cast<HandleMode>(random.below(bone ? 5 : 3));
  pose.transform = transform(random, exponent);
  if (bone)
  {
    pose.stretch = chance(random, 0.5) ? 1.0
      : chance(random, 0.2)            ? 0.0
                                       : random.uniform(-1.0, 3.0);
    pose.twist = chance(random, 0.5)
      ? Eigen::Vector2d(0.0, 0.0)
      : Eigen::Vector2d(random.uniform(-720.0, 720.0), random.uniform(-720.0, 720.0));
  }
}

/// Return the size of a pose: the largest absolute entry of any transform, but at least 1. The
/// entries of a handle whose |stretch| exceeds 1 are first multiplied by |stretch|.
double size_of_pose(const Pose& pose)
{
  double size = 1.0;
  for (const HandlePose& handle : pose)
  {
    size = std::max(
      size, handle.transform.cwiseAbs().maxCoeff() * std::max(std::abs(handle.stretch), 1.0));
  }
  return size;
}

/// Return the given weights, unchanged or damaged at random.
Weights defective_weights(Random& random, const Weights& good)
{
  Weights weights = good;
  const Index m = weights.cols(), a = random.below(m), b = random.below(m);
  switch (random.below(6))
  {
    case 0: // a repeated column of weights; rows still sum to 1
      weights.col(a) = 0.5 * (good.col(a) + good.col(b));
      weights.col(b) = weights.col(a);
      break;
    case 1:
      weights.col(a).setZero();
      break;
    case 2: // random nonnegative rows that sum to 1
    case 3: // random rows of both signs with any sum
    {
      const bool signs = chance(random, 0.5);
      for (Index v = 0; v < weights.rows(); ++v)
      {
        for (Index j = 0; j < m; ++j)
        {
          weights(v, j) = random.uniform(signs ? -1.0 : 0.0, 1.0);
        }
        weights.row(v) /= signs ? 1.0 : weights.row(v).sum();
      }
      break;
    }
    case 4:
      weights.row(random.below(weights.rows())).setZero();
      weights.col(a) *= 1e-13;
      break;
    default:
      break;
  }
  return weights;
}

const Rig& small_rig(Index which)
{
  static const Rig rigs[2] = { bar(4), box(2) };
  return rigs[which];
}
} // namespace

TEST(FuzzPoses, Skinning)
{
  fuzz("poses through linear blending, dual quaternions and bones", 3000,
    [](Random& random)
    {
      Rig shape = small_rig(random.below(2));
      make_bones(random, shape.mesh, shape.handles);
      const Points& rest = shape.mesh.points;
      const Weights weights = defective_weights(random, shape.weights);
      const double exponent = chance(random, 0.2) ? 90.0 : 6.0;
      Pose pose(shape.handles.size());
      for (std::size_t h = 0; h < pose.size(); ++h)
      {
        randomize_pose(random, exponent, shape.handles[h], pose[h]);
      }
      if (chance(random, 0.1) && !constrains_tail(pose[0].mode))
      {
        pose.assign(pose.size(), pose[0]); // the same pose for all handles
      }
      std::vector<Affine> transforms;
      expect_valid_messages(skinning_transforms(shape.handles, pose, transforms));
      double size = 1.0;
      for (const Affine& t : transforms)
      {
        size = std::max(size, t.cwiseAbs().maxCoeff());
      }
      const bool rests = std::all_of(transforms.begin(), transforms.end(),
        [](const Affine& t) { return t == identity_affine(); });

      ExecutionContext serial, parallel;
      serial.set_threads(1);
      parallel.set_threads(4);
      Skinning skinning;
      expect_valid_messages(skinning.bind(serial, weights));
      Points blended, again;
      ASSERT_TRUE(skinning.linear_blend(serial, rest, transforms, blended).ok());
      ASSERT_TRUE(skinning.linear_blend(parallel, rest, transforms, again).ok());
      EXPECT_EQ(blended, again);
      for (Index v = 0; v < rest.rows(); ++v)
      {
        // Compute linear blend skinning for one point from its definition.
        const Vec3 p = rest.row(v);
        Vec3 expected = p;
        for (Index j = 0; j < weights.cols(); ++j)
        {
          expected += weights(v, j) * (transforms[j] * p.homogeneous() - p);
        }
        ASSERT_LE((blended.row(v).transpose() - expected).cwiseAbs().maxCoeff(), 1e-13 * 16 * size);
      }
      Points quaternions;
      const Points pivots = handle_pivots(shape.handles);
      ASSERT_TRUE(skinning.dual_quaternion(serial, rest, transforms, pivots, quaternions).ok());
      ASSERT_TRUE(skinning.dual_quaternion(parallel, rest, transforms, pivots, again).ok());
      EXPECT_EQ(quaternions, again);
      ASSERT_TRUE(quaternions.allFinite());
      for (Index v = 0; v < rest.rows(); ++v)
      {
        Index j = 0;
        if (weights.row(v).cwiseAbs().sum() == 0.0)
        {
          ASSERT_EQ(quaternions.row(v), rest.row(v));
        }
        else if (weights.row(v).maxCoeff(&j) == 1.0 && weights.row(v).cwiseAbs().sum() == 1.0)
        {
          // If a point has the weight 1 for one handle, it moves by the transform of this handle,
          // even if the transform is not rigid.
          const Vec3 expected = transforms[j] * rest.row(v).transpose().homogeneous();
          const double near = 1e-12 * std::max(1.0, transforms[j].cwiseAbs().maxCoeff());
          ASSERT_LE((quaternions.row(v).transpose() - expected).cwiseAbs().maxCoeff(), near);
        }
      }
      const std::vector<BoneChange> bones = bone_changes(shape.handles, pose);
      Points bent;
      ASSERT_TRUE(
        skinning.stretchable_bones(serial, rest, transforms, bones, Weights(), bent).ok());
      ASSERT_TRUE(
        skinning.stretchable_bones(parallel, rest, transforms, bones, Weights(), again).ok());
      EXPECT_EQ(bent, again);
      ASSERT_TRUE(bent.allFinite());
      if (std::none_of(bones.begin(), bones.end(), [](const BoneChange& b) { return b.any(); }))
      {
        EXPECT_EQ(bent, blended);
      }
      if (rests)
      {
        EXPECT_EQ(blended, rest);
        EXPECT_EQ(quaternions, rest);
      }

      Points normals(rest.rows(), 3);
      for (Index v = 0; v < rest.rows(); ++v)
      {
        normals.row(v) = random.in_box(Vec3::Constant(-1.0), Vec3::Ones()).normalized().transpose();
      }
      ASSERT_TRUE(skinning.linear_blend_normals(serial, normals, transforms, blended).ok());
      ASSERT_TRUE(
        skinning.dual_quaternion_normals(serial, normals, transforms, pivots, quaternions).ok());
      for (const Points* turned : { &blended, &quaternions })
      {
        ASSERT_LE((turned->rowwise().norm().array() - 1.0).abs().maxCoeff(), 1e-9);
      }
    });
}

namespace
{
/// A reduced ARAP solver with random options and random weights.
struct ReducedCase
{
  Rig shape;
  Triangles surface; ///< used if the case is bound as a surface
  ReducedArapOptions options;

  explicit ReducedCase(Random& random) : shape(small_rig(random.below(2)))
  {
    this->shape.weights = defective_weights(random, this->shape.weights);
    make_bones(random, this->shape.mesh, this->shape.handles);
    this->options.energy = static_cast<ArapEnergy>(random.below(3));
    this->options.clusters = random.below(3) == 0 ? 1000 : random.below(9);
    this->options.extra_weights = chance(random, 0.3) ? random.below(6) : 0;
    if (chance(random, 0.3))
    {
      this->surface = boundary_triangles(this->shape.mesh.tets);
    }
  }

  Status bind(ExecutionContext& context, ReducedArap& arap) const
  {
    return this->surface.rows() > 0
      ? arap.bind(context, this->shape.mesh.points, this->surface, this->shape.weights,
          this->shape.handles, this->options)
      : arap.bind(context, this->shape.mesh.points, this->shape.mesh.tets, this->shape.weights,
          this->shape.handles, this->options);
  }
};

ReducedArap::SolveOptions solve_options(Random& random)
{
  return { chance(random, 0.5) ? 0.0 : 1e-6, random.below(25),
    static_cast<ReducedArap::Start>(random.below(3)), random.below(8), 0.0, chance(random, 0.5) };
}
} // namespace

TEST(FuzzPoses, ReducedArap)
{
  Index solves = 0;
  fuzz("sequences of poses through reduced ARAP", 12000,
    [&](Random& random)
    {
      const ReducedCase shape(random);
      const Points& rest = shape.shape.mesh.points;
      const double diagonal = bounding_box(rest).diagonal();
      ExecutionContext serial, parallel;
      serial.set_threads(1);
      parallel.set_threads(4);
      ReducedArap arap, parallel_arap;
      const Status bound = shape.bind(serial, arap);
      expect_valid_messages(bound);
      ASSERT_TRUE(bound.ok()) << bound.message;
      ASSERT_TRUE(shape.bind(parallel, parallel_arap).ok());
      const double exponent = chance(random, 0.2) ? 30.0 : 4.0;
      Pose pose(shape.shape.handles.size());
      Points result, again;
      const Index length = 1 + random.below(8);
      for (Index step = 0; step < length; ++step)
      {
        for (std::size_t h = 0; h < pose.size(); ++h)
        {
          if (chance(random, 0.5))
          {
            randomize_pose(random, exponent, shape.shape.handles[h], pose[h]);
          }
        }
        const ReducedArap::SolveOptions options = solve_options(random);
        const Status status = arap.solve(serial, pose, options);
        ++solves;
        expect_valid_messages(status);
        ASSERT_TRUE(status.usable()) << status.message;
        ASSERT_TRUE(arap.deform(serial, rest, result).ok());
        ASSERT_TRUE(result.allFinite());
        for (std::size_t h = 0; h < pose.size(); ++h)
        {
          if (pose[h].mode == HandleMode::full)
          {
            ASSERT_EQ(arap.transforms()[h], pose[h].transform);
          }
        }
        for (const Eigen::Matrix3d& r : arap.rotations())
        {
          ASSERT_LT((r.transpose() * r - Eigen::Matrix3d::Identity()).norm(), 1e-9);
          ASSERT_GT(r.determinant(), 0.0);
        }
        // Round-off is proportional to the largest summands, which grow with the square of the
        // pose's size. The largest of a million errors was 1.1e-12.
        const double size = size_of_pose(pose);
        const double relative_tolerance = options.mixed_precision ? 1e-6 : 1e-11;
        const double unit = relative_tolerance * arap.rest_energy() * size * size;
        for (std::size_t i = 1; i < arap.energies().size(); ++i)
        {
          ASSERT_LE(arap.energies()[i],
            arap.energies()[i - 1] + unit + relative_tolerance * std::abs(arap.energies()[i - 1]))
            << i << " size " << size;
        }
        ASSERT_TRUE(parallel_arap.solve(parallel, pose, options).usable());
        ASSERT_TRUE(parallel_arap.deform(parallel, rest, again).ok());
        ASSERT_EQ(result, again);
        ASSERT_EQ(arap.energies(), parallel_arap.energies());
      }
      // The rest pose gives the rest shape in all modes.
      for (HandlePose& handle : pose)
      {
        handle.transform = identity_affine();
        handle.stretch = 1.0;
      }
      for (const auto start : { ReducedArap::Start::guess, ReducedArap::Start::rest })
      {
        ASSERT_TRUE(arap.solve(serial, pose, { 1e-6, 100, start }).usable());
        ASSERT_TRUE(arap.deform(serial, rest, result).ok());
        ASSERT_LT((result - rest).cwiseAbs().maxCoeff(), 1e-8 * diagonal)
          << (start == ReducedArap::Start::guess ? "guess" : "rest");
      }
    });
  std::cout << "[ fuzz ] " << solves << " poses\n";
}

namespace
{
/// A problem for the full ARAP solver: a shape with random points, bones and regions as handles.
struct FullCase
{
  const TetMesh& mesh;
  Triangles surface; ///< used if the case is bound as a surface
  Handles handles;
  FullArapOptions options;
  bool only_vertices = true; ///< only vertices are constrained, no points inside of elements

  explicit FullCase(Random& random) : mesh(small_rig(random.below(2)).mesh)
  {
    this->options.energy = static_cast<ArapEnergy>(random.below(3));
    this->options.region_ids.assign(static_cast<std::size_t>(this->mesh.points.rows()), 0);
    if (chance(random, 0.4))
    {
      this->surface = boundary_triangles(this->mesh.tets);
    }
    const Box box = bounding_box(this->mesh.points);
    const Index count = 1 + random.below(5);
    for (Index h = 0; h < count; ++h)
    {
      const std::string name = "h" + std::to_string(h);
      const Index v = random.below(this->mesh.points.rows());
      const bool on_vertex = chance(random, 0.5);
      const Vec3 at = on_vertex ? Vec3(this->mesh.points.row(v))
                                : random.in_box(1.1 * box.lower, 1.1 * box.upper);
      const Index kind = random.below(4);
      this->only_vertices = this->only_vertices && on_vertex && kind > 1;
      switch (kind)
      {
        case 0:
          this->handles.push_back(region_handle(name, h + 1, at));
          this->options.region_ids[static_cast<std::size_t>(v)] = h + 1;
          for (Index u = 0; u < this->mesh.points.rows(); ++u)
          {
            if (chance(random, 0.1))
            {
              this->options.region_ids[static_cast<std::size_t>(u)] = h + 1;
            }
          }
          break;
        case 1:
          this->handles.push_back(bone_handle(name, at, at + random.in_box(box.lower, box.upper)));
          break;
        default:
          this->handles.push_back(point_handle(name, at));
          break;
      }
    }
  }

  Status bind(ExecutionContext& context, FullArap& arap) const
  {
    return this->surface.rows() > 0
      ? arap.bind(context, this->mesh.points, this->surface, this->handles, this->options)
      : arap.bind(context, this->mesh.points, this->mesh.tets, this->handles, this->options);
  }
};
} // namespace

TEST(FuzzPoses, FullArap)
{
  Index solves = 0;
  fuzz("sequences of poses through full ARAP", 6000,
    [&](Random& random)
    {
      const FullCase shape(random);
      ExecutionContext serial, parallel;
      serial.set_threads(1);
      parallel.set_threads(4);
      FullArap arap, parallel_arap;
      const Status bound = shape.bind(serial, arap);
      expect_valid_messages(bound);
      ASSERT_EQ(shape.bind(parallel, parallel_arap).code, bound.code);
      if (!bound.usable())
      {
        // The bind fails, for example, if two handles have the same position, or if the vertices of
        // a region are already constrained.
        ASSERT_EQ(bound.code, StatusCode::invalid_input);
        return;
      }
      const double exponent = chance(random, 0.2) ? 30.0 : 4.0;
      Pose pose(shape.handles.size());
      const Index length = 1 + random.below(5);
      for (Index step = 0; step < length; ++step)
      {
        for (std::size_t h = 0; h < pose.size(); ++h)
        {
          if (chance(random, 0.5))
          {
            randomize_pose(random, exponent, shape.handles[h], pose[h]);
          }
        }
        const FullArap::SolveOptions options{ chance(random, 0.5) ? 0.0 : 1e-6, random.below(25),
          static_cast<FullArap::Start>(random.below(3)), random.below(6) };
        const Status status = arap.solve(serial, pose, options);
        ++solves;
        expect_valid_messages(status);
        ASSERT_TRUE(status.usable()) << status.message;
        ASSERT_TRUE(arap.posed().allFinite());
        for (const Eigen::Matrix3d& r : arap.rotations())
        {
          ASSERT_LT((r.transpose() * r - Eigen::Matrix3d::Identity()).norm(), 1e-9);
          ASSERT_GT(r.determinant(), 0.0);
        }
        // If only vertices are constrained, the energy never increases. Point handles inside of
        // elements add linear constraints. Two close handles that are dragged apart raise the
        // condition number to 1e8. The energy is then only as accurate as the constraints, so only
        // the total decrease is checked.
        const double size = size_of_pose(pose);
        const double unit = 1e-12 * arap.rest_energy() * size * size;
        for (std::size_t i = 1; shape.only_vertices && i < arap.energies().size(); ++i)
        {
          ASSERT_LE(arap.energies()[i],
            arap.energies()[i - 1] + unit + 1e-12 * std::abs(arap.energies()[i - 1]))
            << i << " size " << size;
        }
        ASSERT_LE(arap.energies().back(),
          arap.energies().front() + unit + 1e-6 * std::abs(arap.energies().front()));
        ASSERT_TRUE(parallel_arap.solve(parallel, pose, options).usable());
        ASSERT_EQ(arap.posed(), parallel_arap.posed());
        ASSERT_EQ(arap.energies(), parallel_arap.energies());
      }
      // The rest pose gives the rest shape in all modes.
      for (HandlePose& handle : pose)
      {
        handle.transform = identity_affine();
        handle.stretch = 1.0;
      }
      const double diagonal = bounding_box(shape.mesh.points).diagonal();
      for (const auto start : { FullArap::Start::guess, FullArap::Start::rest })
      {
        ASSERT_TRUE(arap.solve(serial, pose, { 1e-6, 100, start, 5 }).usable());
        ASSERT_LT((arap.posed() - shape.mesh.points).cwiseAbs().maxCoeff(), 1e-8 * diagonal)
          << (start == FullArap::Start::guess ? "guess" : "rest");
      }
    });
  std::cout << "[ fuzz ] " << solves << " poses\n";
}

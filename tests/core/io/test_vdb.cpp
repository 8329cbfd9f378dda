// Sampled fields written as OpenVDB files. OpenVDB reads the files back. Every voxel is compared
// with its sample, and the narrow band with its definition, evaluated by brute force. The
// isosurface of a narrow band must equal that of the full grid.
#include "io/vdb.h"

#include "support/files.h"
#include "support/meshes.h"

#define IMATH_HALF_NO_LOOKUP_TABLE // as in vdb.cpp
#include <openvdb/openvdb.h>
#include <openvdb/tools/Diagnostics.h>
#include <openvdb/tools/VolumeToMesh.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <limits>
#include <map>

#include <sys/resource.h>

using namespace bindpose;
using testing::HasSubstr;

namespace
{
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

struct Field
{
  SampleGrid grid;
  std::vector<double> values;

  Field(const std::array<Index, 6>& extent, const std::function<double(const Vec3&)>& f)
  {
    this->grid.origin = Vec3(0.5, -1.25, 3.0);
    this->grid.spacing = Vec3(0.1, 0.25, 0.07);
    this->grid.extent = extent;
    this->for_each([&](Index i, Index j, Index k, Index)
      { this->values.push_back(f(this->grid.point(i, j, k))); });
  }
  /// Call visit(i, j, k, sample) for each sample.
  template <typename Visit>
  void for_each(const Visit& visit) const
  {
    Index sample = 0;
    const auto& e = this->grid.extent;
    for (Index k = e[4]; k <= e[5]; ++k)
    {
      for (Index j = e[2]; j <= e[3]; ++j)
      {
        for (Index i = e[0]; i <= e[1]; ++i)
        {
          visit(i, j, k, sample++);
        }
      }
    }
  }
};

openvdb::Coord coord(Index i, Index j, Index k)
{
  return openvdb::Coord(static_cast<int>(i), static_cast<int>(j), static_cast<int>(k));
}

/// Return a function that is 1 in a ball and 0 outside. Between the two regions it decreases
/// linearly, over a third of the radius.
std::function<double(const Vec3&)> soft_ball(const Vec3& center, double radius)
{
  return [=](const Vec3& p)
  { return std::clamp(0.5 + 3.0 * (1.0 - (p - center).norm() / radius), 0.0, 1.0); };
}

/// Return a ball inside of the grid. Some indices are negative, and the sizes are not multiples of
/// 8.
Field ball()
{
  const Field frame({ -21, 24, -5, 13, 3, 60 }, [](const Vec3&) { return 0.0; });
  return Field(frame.grid.extent, soft_ball(frame.grid.point(2, 4, 31), 1.6));
}

class Vdb : public testing::Test
{
protected:
  Status write(const Field& field, const std::string& name = "field.vdb", int threads = 0)
  {
    ExecutionContext context;
    context.set_threads(threads);
    return write_vdb(context, this->folder / name, field.grid, field.values.data(), this->options);
  }
  openvdb::FloatGrid::Ptr read(const std::string& name = "field.vdb")
  {
    openvdb::initialize();
    openvdb::io::File file(this->folder / name);
    file.open();
    EXPECT_TRUE(file.hasGrid(this->options.grid_name));
    const auto grids = file.getGrids();
    EXPECT_EQ(grids->size(), 1u);
    return openvdb::gridPtrCast<openvdb::FloatGrid>(grids->front());
  }

  test::Folder folder;
  VdbOptions options;
};
} // namespace

TEST_F(Vdb, EveryVoxelIsItsSample)
{
  const Field field = ball();
  const Status status = this->write(field);
  ASSERT_TRUE(status.ok()) << status.message;
  const auto grid = this->read();
  ASSERT_NE(grid, nullptr);
  Index active = 0;
  field.for_each(
    [&](Index i, Index j, Index k, Index sample)
    {
      const double value = field.values[sample];
      ASSERT_EQ(grid->tree().getValue(coord(i, j, k)), static_cast<float>(value));
      ASSERT_EQ(grid->tree().isValueOn(coord(i, j, k)), value > 0.0);
      active += value > 0.0;
      const openvdb::Vec3d at = grid->indexToWorld(coord(i, j, k));
      const Vec3 expected = field.grid.point(i, j, k);
      ASSERT_LT((Vec3(at.x(), at.y(), at.z()) - expected).norm(), 2e-15);
    });
  EXPECT_GT(active, 1000);
  EXPECT_EQ(static_cast<Index>(grid->activeVoxelCount()), active);
  EXPECT_EQ(status.report.number("counts.active_voxels", 0), static_cast<double>(active));
  EXPECT_EQ(status.report.number("counts.samples", 0), 46.0 * 19 * 58);
  EXPECT_EQ(status.report.number("file_bytes", 0),
    static_cast<double>(std::filesystem::file_size(this->folder / "field.vdb")));
  EXPECT_EQ(grid->tree().getValue(coord(1000, 0, 0)), 0.0f);
  EXPECT_EQ(grid->background(), 0.0f);
  EXPECT_EQ(grid->getName(), "winding_number");
  EXPECT_EQ(grid->getGridClass(), openvdb::GRID_FOG_VOLUME);
  EXPECT_EQ(openvdb::tools::checkFogVolume(*grid), "");
  EXPECT_TRUE(grid->transform().baseMap()->isType<openvdb::math::ScaleTranslateMap>());
}

TEST_F(Vdb, FloatsAndDoublesGiveTheSameFile)
{
  const Field field = ball();
  const std::vector<float> floats(field.values.begin(), field.values.end());
  // Set the tolerance to 0, because a positive tolerance is applied to doubles before the
  // conversion to float.
  this->options.tolerance = 0.0;
  ASSERT_TRUE(this->write(field).ok());
  ExecutionContext context;
  ASSERT_TRUE(
    write_vdb(context, this->folder / "floats.vdb", field.grid, floats.data(), this->options).ok());
  EXPECT_EQ(this->folder.read("field.vdb"), this->folder.read("floats.vdb"));
}

TEST_F(Vdb, CubicVoxelsAreUniform)
{
  Field field = ball();
  field.grid.spacing.setConstant(0.1);
  ASSERT_TRUE(this->write(field).ok());
  EXPECT_TRUE(this->read()->hasUniformVoxels());
}

TEST_F(Vdb, FinePointsFarAwayStayWhereTheyAre)
{
  Field field = ball();
  field.grid.origin = Vec3(1e6, -3e6, 2e6);
  field.grid.spacing = Vec3(1e-3, 2e-3, 7e-4);
  ASSERT_TRUE(this->write(field).ok());
  const openvdb::Vec3d at = this->read()->indexToWorld(openvdb::Vec3d(1e6, 1e6, 1e6));
  const Vec3 expected = field.grid.point(1000000, 1000000, 1000000);
  // The positions are equal up to the last bits of the coordinates.
  EXPECT_LT((Vec3(at.x(), at.y(), at.z()) - expected).norm(), 1e-9);
}

TEST_F(Vdb, AxesMayBeTurned)
{
  const Field field = ball();
  this->options.direction =
    Eigen::AngleAxisd(0.7, Vec3(1.0, 2.0, -1.0).normalized()).toRotationMatrix();
  ASSERT_TRUE(this->write(field).ok());
  const openvdb::Vec3d at = this->read()->indexToWorld(coord(-3, 5, 7));
  const Vec3 expected = field.grid.origin +
    this->options.direction * field.grid.spacing.cwiseProduct(Vec3(-3.0, 5.0, 7.0));
  EXPECT_LT((Vec3(at.x(), at.y(), at.z()) - expected).norm(), 1e-14);
}

TEST_F(Vdb, RegionsOfOneValueAreTiles)
{
  const auto one = [](const Vec3&) { return 1.0; };
  ASSERT_TRUE(this->write(Field({ -128, -1, 0, 127, 0, 127 }, one)).ok());
  auto grid = this->read();
  EXPECT_EQ(grid->tree().leafCount(), 0u);
  EXPECT_EQ(grid->tree().activeTileCount(), 1u); // a tile of 128^3 voxels
  EXPECT_EQ(grid->activeVoxelCount(), 128u * 128u * 128u);

  this->options.overwrite = true;
  // The field is one layer of voxels larger than the tile.
  ASSERT_TRUE(this->write(Field({ 0, 8, 0, 7, 0, 7 }, one)).ok());
  grid = this->read();
  EXPECT_EQ(grid->tree().leafCount(), 1u);
  EXPECT_EQ(grid->tree().activeTileCount(), 1u);
  EXPECT_EQ(grid->activeVoxelCount(), 9u * 8u * 8u);
}

TEST_F(Vdb, ValuesNearTheBackgroundBecomeIt)
{
  Field field({ 0, 3, 0, 0, 0, 0 }, [](const Vec3&) { return 0.0; });
  field.values = { 1e-7, -1e-7, 2e-6, -1.0 };
  ASSERT_TRUE(this->write(field).ok());
  auto grid = this->read();
  EXPECT_EQ(grid->activeVoxelCount(), 2u);
  EXPECT_EQ(grid->tree().getValue(coord(0, 0, 0)), 0.0f);
  EXPECT_EQ(grid->tree().getValue(coord(3, 0, 0)), -1.0f);

  this->options.tolerance = 0.0;
  this->options.overwrite = true;
  ASSERT_TRUE(this->write(field).ok());
  grid = this->read();
  EXPECT_EQ(grid->activeVoxelCount(), 4u);
  EXPECT_EQ(grid->tree().getValue(coord(0, 0, 0)), 1e-7f);
}

TEST_F(Vdb, TheBackgroundMayBeTheInside)
{
  Field field = ball();
  for (double& value : field.values)
  {
    value = 1.0 - value;
  }
  this->options.background = 1.0;
  ASSERT_TRUE(this->write(field).ok());
  auto grid = this->read();
  EXPECT_EQ(grid->tree().getValue(coord(1000, 0, 0)), 1.0f);
  EXPECT_EQ(grid->getGridClass(), openvdb::GRID_UNKNOWN);
  EXPECT_FALSE(grid->tree().isValueOn(coord(-21, -5, 3)));
  EXPECT_TRUE(grid->tree().isValueOn(coord(2, 4, 31)));

  this->options.band = VdbBand::narrow;
  this->options.overwrite = true;
  ASSERT_TRUE(this->write(field).ok());
  grid = this->read();
  // Outside of the band, voxels on the same side of the threshold as the background have the
  // background value 1. Voxels on the other side have the value 2 * threshold - background = 0.
  EXPECT_EQ(grid->tree().getValue(coord(2, 4, 31)), 0.0f);
  EXPECT_EQ(grid->tree().getValue(coord(-21, -5, 3)), 1.0f);
  EXPECT_FALSE(grid->tree().isValueOn(coord(2, 4, 31)));
}

TEST_F(Vdb, ANarrowBandIsWhatItsDefinitionSays)
{
  test::Random random(7);
  // A few random samples are above the isovalue, some of them at the ends of the extent. The value
  // outside of the extent is 0.
  const Field field({ -9, 9, -2, 14, 5, 17 },
    [&](const Vec3&) { return random.below(300) == 0 ? 0.8 : 0.3 * random.uniform(); });
  for (const double background : { 0.0, 1.0 })
  {
    for (const Index width : { 1, 2, 4 })
    {
      SCOPED_TRACE(std::to_string(background) + " " + std::to_string(width));
      this->options = VdbOptions();
      this->options.overwrite = true;
      this->options.band = VdbBand::narrow;
      this->options.band_width = width;
      this->options.background = background;
      ASSERT_TRUE(this->write(field).ok());
      const auto grid = this->read();
      std::map<std::array<Index, 3>, bool> inside;
      field.for_each(
        [&](Index i, Index j, Index k, Index sample) {
          inside[{ i, j, k }] = field.values[sample] >= 0.5;
        });
      const auto is_inside = [&](Index i, Index j, Index k)
      {
        const auto entry = inside.find({ i, j, k });
        return entry == inside.end() ? background >= 0.5 : entry->second;
      };
      Index active = 0;
      field.for_each(
        [&](Index i, Index j, Index k, Index sample)
        {
          bool near = false;
          for (Index x = i - width; x <= i + width && !near; ++x)
          {
            for (Index y = j - width; y <= j + width && !near; ++y)
            {
              for (Index z = k - width; z <= k + width && !near; ++z)
              {
                near = is_inside(x, y, z) != is_inside(i, j, k);
              }
            }
          }
          active += near;
          ASSERT_EQ(grid->tree().isValueOn(coord(i, j, k)), near) << i << " " << j << " " << k;
          const float far_value = is_inside(i, j, k) ? 1.0f : 0.0f;
          ASSERT_EQ(grid->tree().getValue(coord(i, j, k)),
            near ? static_cast<float>(field.values[sample]) : far_value);
        });
      EXPECT_EQ(static_cast<Index>(grid->activeVoxelCount()), active);
    }
  }
}

TEST_F(Vdb, ANarrowBandHasTheSameIsosurface)
{
  // The first ball is inside of the grid. The second ball is cut by the boundary of the grid.
  const Field frame({ -21, 42, -5, 34, 3, 90 }, [](const Vec3&) { return 0.0; });
  for (const Vec3& center : { frame.grid.point(10, 15, 46), frame.grid.point(-21, 15, 46) })
  {
    const Field field(frame.grid.extent, soft_ball(center, 2.4));
    this->options = VdbOptions();
    this->options.overwrite = true;
    ASSERT_TRUE(this->write(field, "full.vdb").ok());
    this->options.band = VdbBand::narrow;
    this->options.band_width = 1;
    ASSERT_TRUE(this->write(field, "narrow.vdb").ok());
    const auto full = this->read("full.vdb");
    const auto narrow = this->read("narrow.vdb");
    EXPECT_LT(2 * narrow->activeVoxelCount(), full->activeVoxelCount());
    EXPECT_LT(std::filesystem::file_size(this->folder / "narrow.vdb"),
      std::filesystem::file_size(this->folder / "full.vdb"));
    EXPECT_EQ(narrow->getGridClass(), openvdb::GRID_UNKNOWN);

    const auto surface = [](const openvdb::FloatGrid& grid)
    {
      std::vector<openvdb::Vec3s> points;
      std::vector<openvdb::Vec4I> quads;
      openvdb::tools::volumeToMesh(grid, points, quads, 0.5);
      // A sorted set of quads is independent of the order in which the quads are generated.
      std::multiset<std::array<float, 12>> corners;
      double volume = 0.0;
      for (const openvdb::Vec4I& quad : quads)
      {
        std::array<float, 12> c;
        for (int k = 0; k < 12; ++k)
        {
          c[k] = points[quad[k / 3]][k % 3];
        }
        corners.insert(c);
        const auto at = [&](int k) { return Vec3(c[3 * k], c[3 * k + 1], c[3 * k + 2]); };
        volume += at(0).dot(at(1).cross(at(2))) / 6.0 + at(0).dot(at(2).cross(at(3))) / 6.0;
      }
      return std::make_pair(corners, volume);
    };
    const auto expected = surface(*full);
    EXPECT_GT(expected.first.size(), 1000u);
    EXPECT_TRUE(surface(*narrow) == expected);
    if (center == frame.grid.point(10, 15, 46))
    {
      // At the radius of the ball the linear ramp has the value 1/2. The sign of the volume is
      // ignored, because OpenVDB orients the quads inwards here.
      EXPECT_NEAR(std::abs(expected.second), 4.0 / 3.0 * M_PI * std::pow(2.4, 3), 0.6);
    }
  }
}

TEST_F(Vdb, TheSameBytesForAnyNumberOfThreads)
{
  const Field field = ball();
  for (const VdbBand band : { VdbBand::full, VdbBand::narrow })
  {
    this->options.band = band;
    this->options.overwrite = true;
    ASSERT_TRUE(this->write(field, "one.vdb", 1).ok());
    ASSERT_TRUE(this->write(field, "two.vdb", 2).ok());
    EXPECT_TRUE(this->folder.read("one.vdb") == this->folder.read("two.vdb"));
  }
  const auto tag = [this](const std::string& name)
  {
    openvdb::io::File file(this->folder / name);
    file.open();
    return file.getUniqueTag();
  };
  Field other = field;
  other.values[20000] += 0.25;
  ASSERT_TRUE(this->write(other, "other.vdb").ok());
  EXPECT_EQ(tag("one.vdb"), tag("two.vdb"));
  // Programs use this tag to detect that a file has changed.
  EXPECT_NE(tag("one.vdb"), tag("other.vdb"));
  EXPECT_EQ(tag("one.vdb").size(), 36u);
  EXPECT_EQ(tag("one.vdb")[14], '8');
}

TEST_F(Vdb, AnEmptyGridIsAWarning)
{
  const Field field({ 0, 9, 0, 9, 0, 9 }, [](const Vec3&) { return 0.25; });
  this->options.background = 0.25;
  Status status = this->write(field);
  ASSERT_TRUE(status.ok()) << status.message;
  ASSERT_EQ(status.warnings.size(), 1u);
  EXPECT_THAT(status.warnings[0], HasSubstr("background"));
  this->options = VdbOptions();
  this->options.band = VdbBand::narrow;
  this->options.overwrite = true;
  status = this->write(field);
  ASSERT_TRUE(status.ok()) << status.message;
  ASSERT_EQ(status.warnings.size(), 1u);
  EXPECT_THAT(status.warnings[0], HasSubstr("threshold"));
  EXPECT_TRUE(this->read()->empty());
}

TEST_F(Vdb, WhatCannotBeWrittenIsOneSentence)
{
  const Field good = ball();
  const auto expect_rejected = [this](const Field& field, const char* word)
  {
    const Status status = this->write(field);
    EXPECT_EQ(status.code, StatusCode::invalid_input) << word;
    EXPECT_THAT(status.message, HasSubstr(word));
    EXPECT_EQ(this->folder.number_of_files(), 0u);
  };
  for (const double value : { not_a_number, 1.0 / 0.0, 1e300 })
  {
    Field field = good;
    field.values[70] = value;
    field.values[30000] = not_a_number;
    expect_rejected(field, "sample 70 ");
  }
  for (const double value : { not_a_number, 0.0, -0.5, 1.0 / 0.0 })
  {
    Field field = good;
    field.grid.spacing[1] = value;
    expect_rejected(field, "spacing");
  }
  Field field = good;
  field.grid.origin[0] = not_a_number;
  expect_rejected(field, "origin");
  field = good;
  field.grid.extent = { 0, -1, 0, 5, 0, 5 };
  expect_rejected(field, "no samples");
  field.grid.extent = { 0, 0, 0, 0, Index(1) << 40, Index(1) << 40 };
  expect_rejected(field, "index 1099511627776");
  field.grid.extent = { 0, 1 << 30, 0, 1 << 30, 0, 1 << 30 };
  expect_rejected(field, "too many");

  const auto refuses_options = [&](const VdbOptions& invalid_options, const char* word)
  {
    this->options = invalid_options;
    expect_rejected(good, word);
  };
  VdbOptions invalid_options;
  invalid_options.grid_name = "";
  refuses_options(invalid_options, "name");
  invalid_options = VdbOptions();
  invalid_options.background = not_a_number;
  refuses_options(invalid_options, "background");
  invalid_options = VdbOptions();
  invalid_options.tolerance = not_a_number;
  refuses_options(invalid_options, "tolerance");
  invalid_options = VdbOptions();
  invalid_options.direction(0, 1) = 0.5;
  refuses_options(invalid_options, "orthonormal");
  invalid_options = VdbOptions();
  invalid_options.band = VdbBand::narrow;
  invalid_options.band_width = 0;
  refuses_options(invalid_options, "1 voxel");
  invalid_options.band_width = 3;
  invalid_options.threshold = not_a_number;
  refuses_options(invalid_options, "threshold");
  invalid_options.threshold = 0.0;
  refuses_options(invalid_options, "differ from the threshold");
}

TEST_F(Vdb, FilesAreThereWholeOrNotAtAll)
{
  const Field field = ball();
  EXPECT_THAT(this->write(field, "no/field.vdb").message, HasSubstr("No such file"));
  ASSERT_TRUE(this->write(field).ok());
  const std::string before = this->folder.read("field.vdb");
  EXPECT_THAT(this->write(field).message, HasSubstr("the file exists"));
  this->options.overwrite = true;

  // Simulate a full disk by a limit on the file size.
  rlimit saved{};
  getrlimit(RLIMIT_FSIZE, &saved);
  rlimit small = saved;
  small.rlim_cur = 4096;
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  setrlimit(RLIMIT_FSIZE, &small);
  const Status status = this->write(field);
  setrlimit(RLIMIT_FSIZE, &saved);
  std::signal(SIGXFSZ, handler);
  EXPECT_EQ(status.code, StatusCode::invalid_input);
  EXPECT_THAT(status.message, HasSubstr("field.vdb: File too large"));
  EXPECT_EQ(this->folder.number_of_files(), 1u);
  EXPECT_TRUE(this->folder.read("field.vdb") == before);
}

TEST_F(Vdb, CancelsAndTellsHowFarItIs)
{
  const Field field = ball();
  for (const VdbBand band : { VdbBand::full, VdbBand::narrow })
  {
    this->options = VdbOptions();
    this->options.band = band;
    this->options.overwrite = true;
    std::vector<double> fractions;
    std::atomic<int> asked{ 0 };
    ExecutionContext counted([&](double fraction, const std::string&)
      { fractions.push_back(fraction); },
      [&] { return ++asked < 0; });
    counted.set_threads(1);
    ASSERT_TRUE(
      write_vdb(counted, this->folder / "f.vdb", field.grid, field.values.data(), this->options)
        .ok());
    EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
    EXPECT_GT(fractions.back(), 0.55);
    std::filesystem::remove(this->folder / "f.vdb");
    const int all = asked;
    EXPECT_GT(all, 20);
    for (const int last : { 1, all / 3, all - 1 })
    {
      std::atomic<int> count{ 0 };
      ExecutionContext context({}, [&] { return ++count >= last; });
      context.set_threads(1);
      const Status status =
        write_vdb(context, this->folder / "f.vdb", field.grid, field.values.data(), this->options);
      EXPECT_EQ(status.code, StatusCode::canceled) << last << " of " << all;
      EXPECT_EQ(this->folder.number_of_files(), 0u);
    }
  }
}

// Writer of OpenVDB files (see vdb.h). The samples are divided in parallel into blocks that have
// the size of the leaf nodes of a VDB tree, 8 x 8 x 8. A block with a constant value becomes a
// tile, any other block a leaf. The blocks are inserted into the tree sequentially, and pruning
// merges equal tiles into larger ones. OpenVDB's archive code then writes the tree through a stream
// buffer that is defined in this file. The buffer reports progress, checks for cancel and reports a
// full disk, which OpenVDB's file class ignores.
//
// A voxel is in the narrow band if the box of (2 N + 1)^3 voxels around the voxel contains values
// on both sides of the threshold, where N is the band width. The box is searched along one axis
// after the other.
//
// This is the only file that includes OpenVDB.
#include "io/vdb.h"

#ifdef BINDPOSE_HAS_OPENVDB
#include "base/parallel.h"
#include "io/atomic_file.h"

#define IMATH_HALF_NO_LOOKUP_TABLE // avoids linking a table of the library Imath
#include <openvdb/io/Archive.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/Prune.h>

#include <atomic>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <memory>
#endif

namespace bindpose
{

const char* to_string(VdbBand band)
{
  return band == VdbBand::full ? "full" : "narrow";
}

#ifndef BINDPOSE_HAS_OPENVDB

Status check_vdb_available()
{
  return Status::failure(StatusCode::unavailable,
    "this build cannot write .vdb files; install the package libopenvdb-dev and rebuild");
}

Status write_vdb(
  ExecutionContext&, const std::string&, const SampleGrid&, const float*, const VdbOptions&)
{
  return check_vdb_available();
}

Status write_vdb(
  ExecutionContext&, const std::string&, const SampleGrid&, const double*, const VdbOptions&)
{
  return check_vdb_available();
}

#else

namespace
{
using Leaf = openvdb::FloatTree::LeafNodeType;
constexpr Index leaf_size = Leaf::DIM;
/// Limit of indices. OpenVDB's indices have 32 bits; the limit leaves room for the outer nodes,
/// which extend beyond the samples.
constexpr Index largest_index = Index(1) << 30;
/// Maximum number of samples: more than any memory can store, but within the range of Index.
constexpr double maximum_samples = 1e15;

Status check(const SampleGrid& grid, const VdbOptions& options)
{
  double samples = 1.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    for (const Index i : { grid.extent[2 * axis], grid.extent[2 * axis + 1] })
    {
      if (i < -largest_index || i > largest_index)
      {
        return Status::invalid_input(
          "the grid index " + std::to_string(i) + " is outside the range of a .vdb file");
      }
    }
    samples *= static_cast<double>(grid.size(axis));
  }
  if (samples == 0.0)
  {
    return Status::invalid_input("the grid has no samples");
  }
  if (samples > maximum_samples)
  {
    return Status::invalid_input("the grid has too many samples");
  }
  if (!grid.origin.allFinite() || !grid.spacing.allFinite() || grid.spacing.minCoeff() <= 0.0)
  {
    return Status::invalid_input("the grid's origin must be finite and its spacing positive");
  }
  const Eigen::Matrix3d& d = options.direction;
  if (!((d.transpose() * d - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() < 1e-6))
  {
    return Status::invalid_input("the axes of the grid must be orthonormal");
  }
  if (options.grid_name.empty())
  {
    return Status::invalid_input("the name of the grid must not be empty");
  }
  if (!std::isfinite(static_cast<float>(options.background)))
  {
    return Status::invalid_input("the background must be a finite float");
  }
  if (!(options.tolerance >= 0.0))
  {
    return Status::invalid_input("the tolerance must be at least 0");
  }
  if (options.band == VdbBand::narrow)
  {
    if (options.band_width < 1 || options.band_width > largest_index)
    {
      return Status::invalid_input("a narrow band must be at least 1 voxel wide");
    }
    if (!std::isfinite(static_cast<float>(options.threshold)) ||
      !std::isfinite(static_cast<float>(2.0 * options.threshold - options.background)))
    {
      return Status::invalid_input("the threshold must be a finite float");
    }
    if (static_cast<float>(options.threshold) == static_cast<float>(options.background))
    {
      return Status::invalid_input(
        "the background must differ from the threshold, which separates inside and outside");
    }
  }
  return {};
}

/// The grid divided into blocks of 8 x 8 x 8 voxels, aligned with the leaf nodes of a tree.
class Blocks
{
public:
  explicit Blocks(const SampleGrid& grid)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      this->lower_[axis] = grid.extent[2 * axis];
      this->upper_[axis] = grid.extent[2 * axis + 1];
      // Rounds down to a multiple of 8, also for negative indices.
      this->first_[axis] = this->lower_[axis] & ~(leaf_size - 1);
      this->count_[axis] = (this->upper_[axis] - this->first_[axis]) / leaf_size + 1;
      this->size_[axis] = grid.size(axis);
    }
  }
  Index count() const { return this->count_[0] * this->count_[1] * this->count_[2]; }
  openvdb::Coord origin(Index block) const
  {
    const Index x = block % this->count_[0];
    const Index y = block / this->count_[0] % this->count_[1];
    const Index z = block / this->count_[0] / this->count_[1];
    return openvdb::Coord(static_cast<int>(this->first_[0] + x * leaf_size),
      static_cast<int>(this->first_[1] + y * leaf_size),
      static_cast<int>(this->first_[2] + z * leaf_size));
  }
  /// Call visit(offset in the leaf, id of the sample) for those voxels of the block that are in the
  /// extent.
  template <typename Visit>
  void for_each_sample(const openvdb::Coord& origin, const Visit& visit) const
  {
    Index begin[3];
    Index end[3];
    for (int axis = 0; axis < 3; ++axis)
    {
      begin[axis] = std::max<Index>(origin[axis], this->lower_[axis]);
      end[axis] = std::min<Index>(origin[axis] + leaf_size, this->upper_[axis] + 1);
    }
    for (Index k = begin[2]; k < end[2]; ++k)
    {
      for (Index j = begin[1]; j < end[1]; ++j)
      {
        const Index row =
          ((k - this->lower_[2]) * this->size_[1] + (j - this->lower_[1])) * this->size_[0];
        for (Index i = begin[0]; i < end[0]; ++i)
        {
          const Index offset = ((i - origin[0]) * leaf_size + (j - origin[1])) * leaf_size +
            (k - origin[2]); // in a leaf, z varies fastest
          visit(static_cast<openvdb::Index>(offset), row + (i - this->lower_[0]));
        }
      }
    }
  }

private:
  Index lower_[3], upper_[3]; // first and last voxel of the extent along each axis
  Index first_[3]; // first voxel of the first block
  Index count_[3]; // number of blocks along each axis
  Index size_[3];
};

// ---- The narrow band ----------------------------------------------------------------------------
using Sides = std::vector<unsigned char>;
constexpr unsigned char below = 1;
constexpr unsigned char above = 2;

/// Each entry of a line is a bit mask of the sides of the threshold (`below`, `above`). Replace
/// each entry by the union of all entries at a distance of at most `width`.
/// @param outside bit mask of the entries beyond the ends of the line.
/// @param found working memory.
void spread_along_line(
  unsigned char* line, Index stride, Index size, Index width, unsigned char outside, Sides& found)
{
  found.assign(static_cast<std::size_t>(size), 0);
  for (const unsigned char side : { below, above })
  {
    // Index of the last visited entry whose bit mask contains `side`. The initial value represents
    // the samples beyond the end of the line. If these samples are on `side`, the initial value is
    // the index next to the line; otherwise, it is too far from the line to have an effect.
    Index last = outside & side ? -1 : -width - 1;
    for (Index i = 0; i < size; ++i)
    {
      last = line[i * stride] & side ? i : last;
      found[i] |= i - last <= width ? side : 0;
    }
    last = outside & side ? size : size + width;
    for (Index i = size - 1; i >= 0; --i)
    {
      last = line[i * stride] & side ? i : last;
      found[i] |= last - i <= width ? side : 0;
    }
  }
  for (Index i = 0; i < size; ++i)
  {
    line[i * stride] = found[i];
  }
}

/// For every sample, find whether the box around the sample contains values below the threshold
/// (bit `below`), and whether it contains other values (bit `above`). The box extends by
/// options.band_width samples in both directions along each axis.
/// @return false if canceled.
template <typename Value>
bool find_sides(ExecutionContext& context, const SampleGrid& grid, const Value* values,
  const VdbOptions& options, Sides& sides)
{
  const Phase phase(context, "band", 0.0, 0.3);
  const auto threshold = static_cast<float>(options.threshold);
  const auto side_of = [threshold](float value) { return value < threshold ? below : above; };
  const unsigned char outside = side_of(static_cast<float>(options.background));
  const Index nx = grid.size(0);
  const Index ny = grid.size(1);
  const Index nz = grid.size(2);
  sides.resize(static_cast<std::size_t>(grid.count()));
  unsigned char* const data = sides.data();
  // Call spread_along_line() along x and y in each layer of constant z, then along z in each layer
  // of constant y.
  bool completed = false;
  {
    const ProgressRange range(context, 0.0, 0.6);
    completed = parallel_for(context, nz, 1,
      [&](Index k, Index)
      {
        Sides found;
        unsigned char* const layer = data + k * nx * ny;
        for (Index i = 0; i < nx * ny; ++i)
        {
          layer[i] = side_of(static_cast<float>(values[k * nx * ny + i]));
        }
        for (Index j = 0; j < ny; ++j)
        {
          spread_along_line(layer + j * nx, 1, nx, options.band_width, outside, found);
        }
        for (Index i = 0; i < nx; ++i)
        {
          spread_along_line(layer + i, nx, ny, options.band_width, outside, found);
        }
      });
  }
  const ProgressRange range(context, 0.6, 1.0);
  return completed &&
    parallel_for(context, ny, 1,
      [&](Index j, Index)
      {
        Sides found;
        for (Index i = 0; i < nx; ++i)
        {
          spread_along_line(data + j * nx + i, nx * ny, nz, options.band_width, outside, found);
        }
      });
}

// ---- The tree -----------------------------------------------------------------------------------
struct Voxel
{
  float value = 0.0f;
  bool active = false;
};

/// Converts a sample to a voxel of the grid.
class Classifier
{
public:
  explicit Classifier(const VdbOptions& options)
    : narrow_(options.band == VdbBand::narrow), tolerance_(options.tolerance),
      exact_background_(options.background), background_(static_cast<float>(options.background)),
      threshold_(static_cast<float>(options.threshold)),
      mirror_(static_cast<float>(2.0 * options.threshold - options.background))
  {
  }
  Voxel background() const { return { this->background_, false }; }
  Voxel operator()(double exact, const unsigned char* sides, Index sample) const
  {
    const auto value = static_cast<float>(exact);
    if (!this->narrow_)
    {
      const bool differs =
        std::abs(exact - this->exact_background_) > this->tolerance_ && value != this->background_;
      return differs ? Voxel{ value, true } : this->background();
    }
    if (sides[sample] == (below | above))
    {
      return { value, true };
    }
    const bool as_background = (value < this->threshold_) == (this->background_ < this->threshold_);
    return { as_background ? this->background_ : this->mirror_, false };
  }

private:
  bool narrow_;
  double tolerance_;
  double exact_background_;
  float background_;
  float threshold_;
  float mirror_;
};

/// The node that represents a block of voxels: a leaf or, if all voxels of the block are equal, a
/// tile with their common value. `leaf` is null for a tile.
struct Block
{
  std::unique_ptr<Leaf> leaf;
  Voxel tile;
};

/// Build the tree.
/// @param first_nonfinite set to the first sample that is not a finite float, or -1.
/// @return false if canceled.
template <typename Value>
bool make_tree(ExecutionContext& context, const SampleGrid& grid, const Value* values,
  const Sides& sides, const VdbOptions& options, openvdb::FloatTree& tree, Index& first_nonfinite)
{
  const Phase phase(context, "grid", options.band == VdbBand::narrow ? 0.3 : 0.0, 0.6);
  const Blocks blocks(grid);
  const Classifier classify(options);
  const Voxel background = classify.background();
  std::vector<Block> built_blocks(static_cast<std::size_t>(blocks.count()));
  std::atomic<Index> first_invalid{ grid.count() };
  const auto build_leaf = [&](Index b, Leaf& leaf)
  {
    const openvdb::Coord origin = blocks.origin(b);
    leaf.setOrigin(origin);
    leaf.fill(background.value, false);
    float* const voxels = leaf.buffer().data();
    Leaf::NodeMaskType& active = leaf.getValueMask();
    blocks.for_each_sample(origin,
      [&](openvdb::Index offset, Index sample)
      {
        const auto exact = static_cast<double>(values[sample]);
        if (!std::isfinite(static_cast<float>(exact)))
        {
          Index first = first_invalid.load();
          while (sample < first && !first_invalid.compare_exchange_weak(first, sample))
          {
          }
        }
        const Voxel voxel = classify(exact, sides.data(), sample);
        voxels[offset] = voxel.value;
        if (voxel.active)
        {
          active.setOn(offset);
        }
      });
    Block& block = built_blocks[static_cast<std::size_t>(b)];
    if (!leaf.isConstant(block.tile.value, block.tile.active))
    {
      block.leaf = std::make_unique<Leaf>(leaf);
    }
  };
  if (!parallel_for(context, blocks.count(), 32,
        [&](Index begin, Index end)
        {
          Leaf leaf(openvdb::Coord(), background.value, false);
          for (Index b = begin; b < end; ++b)
          {
            build_leaf(b, leaf);
          }
        }))
  {
    return false;
  }
  first_nonfinite = first_invalid < grid.count() ? first_invalid.load() : -1;
  for (Index b = 0; b < blocks.count() && first_nonfinite < 0; ++b)
  {
    Block& block = built_blocks[static_cast<std::size_t>(b)];
    if (block.leaf)
    {
      tree.addLeaf(block.leaf.release());
    }
    else if (block.tile.active || block.tile.value != background.value)
    {
      tree.addTile(1, blocks.origin(b), block.tile.value, block.tile.active);
    }
  }
  openvdb::tools::pruneTiles(tree, 0.0f, false);
  return true;
}

openvdb::math::Transform::Ptr make_transform(const SampleGrid& grid, const VdbOptions& options)
{
  openvdb::Mat4R matrix = openvdb::Mat4R::identity(); // OpenVDB multiplies row vectors: x' = x M
  for (int axis = 0; axis < 3; ++axis)
  {
    for (int k = 0; k < 3; ++k)
    {
      matrix(axis, k) = options.direction(k, axis) * grid.spacing[axis];
    }
  }
  // OpenVDB selects the simplest map type for this matrix. The origin is added afterward. If the
  // matrix contained the origin, OpenVDB would compute the spacing as the difference of two points,
  // with rounding errors.
  auto transform = openvdb::math::Transform::createLinearTransform(matrix);
  transform->postTranslate(openvdb::Vec3d(grid.origin.data()));
  return transform;
}

// ---- The file -----------------------------------------------------------------------------------
/// A file buffer that reports progress and rejects writes after a cancel.
class WatchedFile : public std::filebuf
{
public:
  WatchedFile(ExecutionContext& context, double expected_bytes)
    : context_(context), expected_bytes_(expected_bytes)
  {
  }

protected:
  std::streamsize xsputn(const char* text, std::streamsize size) override
  {
    if (this->context_.canceled())
    {
      return 0; // the stream treats the result 0 as a failure and throws
    }
    this->bytes_ += static_cast<double>(size);
    this->context_.progress(std::min(1.0, this->bytes_ / this->expected_bytes_));
    return std::filebuf::xsputn(text, size);
  }

private:
  ExecutionContext& context_;
  double expected_bytes_;
  double bytes_ = 0.0;
};

/// Writes the same bytes as openvdb::io::File, but to a stream.
class StreamArchive : public openvdb::io::Archive
{
public:
  void write_grid(std::ostream& stream, const openvdb::GridBase::Ptr& grid) const
  {
    // The argument `true` writes offsets, as for files that support seeking.
    this->write(stream, openvdb::GridCPtrVec{ grid }, true);
  }
};

/// The hash FNV-1a, on 64-bit words instead of bytes.
class Hash
{
public:
  explicit Hash(std::uint64_t seed) : state_(0xcbf29ce484222325ull ^ seed) {}
  void add(const char* bytes, std::streamsize size)
  {
    for (std::streamsize at = 0; at < size; at += sizeof(std::uint64_t))
    {
      std::uint64_t word = 0;
      std::memcpy(&word, bytes + at, std::min<std::streamsize>(sizeof(word), size - at));
      this->state_ = (this->state_ ^ word) * 0x100000001b3ull;
      // Also propagate high bits to low bits, which multiplication does not do.
      this->state_ ^= this->state_ >> 32;
    }
  }
  std::uint64_t value() const { return this->state_; }

private:
  std::uint64_t state_;
};

/// Return "xxxxxxxx-xxxx-8xxx-8xxx-xxxxxxxxxxxx": a UUID of version 8, for which any digits x are
/// valid (RFC 9562).
std::string make_uuid(std::uint64_t first, std::uint64_t second)
{
  char digits[33];
  std::snprintf(digits, sizeof(digits), "%016llx%016llx", static_cast<unsigned long long>(first),
    static_cast<unsigned long long>(second));
  digits[12] = '8';
  digits[16] = '8';
  const std::string text = digits;
  return text.substr(0, 8) + "-" + text.substr(8, 4) + "-" + text.substr(12, 4) + "-" +
    text.substr(16, 4) + "-" + text.substr(20);
}

/// Replace the random UUID in the file's header by a UUID that is computed from the rest of the
/// file. Programs use the UUID to detect changes of a file.
/// @return false if the file cannot be read or written.
bool replace_uuid_by_hash(
  ExecutionContext& context, const std::string& path, const std::string& tag)
{
  std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
  std::vector<char> chunk(1 << 20);
  Hash first(0);
  Hash second(0x9e3779b97f4a7c15ull);
  std::streamoff at = -1;
  for (bool head = true; file && !context.canceled(); head = false)
  {
    file.read(chunk.data(), static_cast<std::streamsize>(chunk.size()));
    const std::streamsize size = file.gcount();
    if (head)
    {
      char* const end = chunk.data() + std::min<std::streamsize>(size, 256);
      char* const found = std::search(chunk.data(), end, tag.begin(), tag.end());
      if (found == end)
      {
        return size > 0; // this version of OpenVDB stores no UUID
      }
      at = found - chunk.data();
      std::fill_n(found, tag.size(), '0');
    }
    first.add(chunk.data(), size);
    second.add(chunk.data(), size);
  }
  file.clear();
  file.seekp(at);
  file << make_uuid(first.value(), second.value());
  file.close();
  return !file.fail();
}

Status write_file(ExecutionContext& context, const std::string& path,
  const openvdb::FloatGrid::Ptr& grid, const VdbOptions& options, std::streamoff& bytes)
{
  const Phase phase(context, "write", 0.6, 1.0);
  AtomicFile file;
  Status status = file.open(path, options.overwrite);
  if (!status.ok())
  {
    return status;
  }
  const auto cannot_write = [&path]
  {
    return Status::invalid_input("cannot write " + path + ": " +
      (errno ? std::strerror(errno) : "the file could not be written"));
  };
  StreamArchive archive;
  WatchedFile buffer(context, static_cast<double>(grid->memUsage()));
  errno = 0;
  if (!buffer.open(file.temporary(), std::ios::out | std::ios::trunc | std::ios::binary))
  {
    return cannot_write();
  }
  bool written = true;
  try
  {
    std::ostream stream(&buffer);
    stream.exceptions(std::ios::badbit | std::ios::failbit);
    archive.write_grid(stream, grid);
    stream.seekp(0, std::ios::end);
    bytes = stream.tellp();
  }
  catch (const std::ios::failure&)
  {
    written = false;
  }
  catch (const openvdb::IoError&)
  {
    written = false;
  }
  written = buffer.close() && written;
  written = written && replace_uuid_by_hash(context, file.temporary(), archive.getUniqueTag());
  if (context.canceled())
  {
    return Status::canceled();
  }
  return written ? file.commit() : cannot_write();
}

template <typename Value>
Status write_any(ExecutionContext& context, const std::string& path, const SampleGrid& samples,
  const Value* values, const VdbOptions& options)
{
  Status status = check(samples, options);
  if (status.ok())
  {
    status = AtomicFile::check(path, options.overwrite); // check the target before the computation
  }
  if (!status.ok())
  {
    return status;
  }
  openvdb::initialize(); // this function may be called repeatedly and from any thread
  Sides sides;
  if (options.band == VdbBand::narrow && !find_sides(context, samples, values, options, sides))
  {
    return Status::canceled();
  }
  const auto grid = openvdb::FloatGrid::create(static_cast<float>(options.background));
  grid->setName(options.grid_name);
  grid->setCreator("Bindpose");
  grid->setGridClass(options.band == VdbBand::full && options.background == 0.0
      ? openvdb::GRID_FOG_VOLUME
      : openvdb::GRID_UNKNOWN);
  grid->setTransform(make_transform(samples, options));
  Index first_nonfinite = -1;
  if (!make_tree(context, samples, values, sides, options, grid->tree(), first_nonfinite))
  {
    return Status::canceled();
  }
  if (first_nonfinite >= 0)
  {
    return Status::invalid_input(
      "the value of sample " + std::to_string(first_nonfinite) + " must be a finite float");
  }
  std::streamoff bytes = 0;
  status = write_file(context, path, grid, options, bytes);
  if (!status.ok())
  {
    return status;
  }
  const auto active = static_cast<Index>(grid->activeVoxelCount());
  status.report.set("counts.samples", samples.count());
  status.report.set("counts.active_voxels", active);
  status.report.set("counts.leaf_nodes", static_cast<Index>(grid->tree().leafCount()));
  status.report.set("file_bytes", static_cast<Index>(bytes));
  if (active == 0)
  {
    status.warnings.push_back(options.band == VdbBand::full
        ? "the grid is empty: all values equal the background"
        : "the grid is empty: no value crosses the threshold");
  }
  return status;
}
} // namespace

Status check_vdb_available()
{
  return {};
}

Status write_vdb(ExecutionContext& context, const std::string& path, const SampleGrid& grid,
  const float* values, const VdbOptions& options)
{
  return write_any(context, path, grid, values, options);
}

Status write_vdb(ExecutionContext& context, const std::string& path, const SampleGrid& grid,
  const double* values, const VdbOptions& options)
{
  return write_any(context, path, grid, values, options);
}

#endif

} // namespace bindpose

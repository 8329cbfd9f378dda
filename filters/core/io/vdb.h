#ifndef bindpose_io_vdb_h
#define bindpose_io_vdb_h

#include "base/execution.h"
#include "base/sample_grid.h"

#include <string>

namespace bindpose
{

/// Which voxels of a VDB grid are active, that is, hold values of their own.
enum class VdbBand
{
  full, ///< all that differ from the background
  narrow ///< only those near where the values cross the threshold
};

/// "full", "narrow".
const char* to_string(VdbBand band);

struct VdbOptions
{
  /// What programs that read the file call the grid; not empty.
  std::string grid_name = "winding_number";
  /// Columns: unit directions of the grid's axes, as in vtkImageData. The spacing counts along
  /// them.
  Eigen::Matrix3d direction = Eigen::Matrix3d::Identity();
  /// Value of everything outside of the extent: 0 for winding numbers, 1 for a field whose outside
  /// is 1, such as 1 - winding number.
  double background = 0.0;
  VdbBand band = VdbBand::full;
  /// Narrow: how many voxels from the crossing along each axis, 1 … 2^30. 3, as for level sets.
  Index band_width = 3;
  /// Narrow: the level of the surface.
  double threshold = 0.5;
  /// Values this near to the background become it; 0 … Full band only.
  double tolerance = 1e-6;
  /// Replace an existing file?
  bool overwrite = false;
};

/// ok, or unavailable, naming the package that this build was made without.
Status check_vdb_available();

/// Writes grid.count() values, x fastest, as one float grid of an OpenVDB file (.vdb). Voxel
/// (i, j, k) has the index (i, j, k) of the sample, also below 0, and its centre lies at the
/// sample's point, so that the file and a vtkImageData agree in world coordinates.
///
/// - **Full**: a fog volume, OpenVDB's word for a density that is 0 outside and 1 inside. Values
///   within `tolerance` of the background become inactive background, all others are active floats;
///   regions of one value are stored as tiles. Nothing is clamped: overlapping parts wind 2 times,
///   inside-out ones -1, and programs that draw densities expect 0 … 1. A background other than 0
///   makes the class "unknown", as no fog volume has one.
/// - **Narrow**: active are voxels with a voxel of the other side of `threshold` at most
///   `band_width` away along each axis; the outside of the extent counts as background. All others
///   are inactive and hold one value a side: the background, or its mirror image at the threshold
///   (0 and 1 by default). So the isosurface at the threshold is that of the full grid, in a much
///   smaller file. The class is "unknown": neither a density, the inside being inactive, nor a
///   level set, the values being no distances. Extract it at isovalue `threshold`.
///
/// The file is there whole or not at all. The same values give the same bytes for any number of
/// threads; the file's UUID, which OpenVDB takes at random, is made from its contents.
///
/// Reports counts.samples, counts.active_voxels, counts.leaf_nodes (of 8 x 8 x 8 voxels that are
/// not constant), file_bytes. A warning when nothing is active.
/// unavailable: built without OpenVDB. invalid_input: an empty grid, spacing that is not positive,
/// directions that are not orthonormal, an index beyond 2^30, a value or option that is not finite
/// as a float, options out of range, a background equal to the threshold, an unwritable file.
/// A cancel is heard within 100 ms, but for OpenVDB's preparation of what it writes, 16 ns a voxel
/// in leaf nodes. Cost on one core: 11 ns a sample, narrow 33 ns, and 30 ns a voxel in leaf nodes
/// to compress it; 5 bytes such a voxel, narrow a byte a sample more.
Status write_vdb(const std::string& path, const SampleGrid& grid, const float* values,
  const VdbOptions& options, ExecutionContext& context);
Status write_vdb(const std::string& path, const SampleGrid& grid, const double* values,
  const VdbOptions& options, ExecutionContext& context);

} // namespace bindpose

#endif

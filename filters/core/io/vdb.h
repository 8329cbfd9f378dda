#ifndef bindpose_io_vdb_h
#define bindpose_io_vdb_h

#include "base/execution.h"
#include "geometry/sample_grid.h"

#include <string>

namespace bindpose
{

/// The set of voxels of a VDB grid that are active. Active voxels store individual values.
enum class VdbBand
{
  full, ///< all voxels whose value differs from the background
  narrow ///< only voxels near the threshold
};

/// Return "full" or "narrow".
const char* to_string(VdbBand band);

/// Options of write_vdb().
struct VdbOptions
{
  /// Name of the grid in programs that read the file; not empty.
  std::string grid_name = "winding_number";
  /// Unit vectors along the grid's axes, in the columns, as in vtkImageData. The spacing is
  /// measured along these vectors.
  Eigen::Matrix3d direction = Eigen::Matrix3d::Identity();
  /// Value outside the extent: 0 for winding numbers; 1 for a field that is 1 outside, for example
  /// 1 - winding number.
  double background = 0.0;
  VdbBand band = VdbBand::full;
  /// Narrow band only: half of the band's width, in voxels along each axis, 1 … 2^30. 3 is usual
  /// for level sets.
  Index band_width = 3;
  /// Narrow band only: value at the surface.
  double threshold = 0.5;
  /// Full band only: tolerance >= 0. Values that differ from the background by at most the
  /// tolerance are replaced by the background.
  double tolerance = 1e-6;
  /// Whether an existing file is replaced.
  bool overwrite = false;
};

/// Return ok if this build can write .vdb files, else unavailable with the name of the missing
/// package.
Status check_vdb_available();

/// Write grid.count() values, x fastest, as one float grid of an OpenVDB file (.vdb). Voxel (i, j,
/// k) stores the sample with the index (i, j, k). Indices may be negative. The voxel's center is at
/// the sample's point, so that the file and a vtkImageData have the same world coordinates.
/// - **Full**: a fog volume, OpenVDB's term for a density that is 0 outside and 1 inside. Voxels
///   with values within `tolerance` of the background are inactive; all other voxels are active.
///   Regions of one value are stored as tiles. Values are not clamped: the winding number is 2 in
///   overlapping parts and -1 in inverted parts, whereas programs that draw densities expect 0 … 1.
///   If the background is not 0, the grid class is "unknown", because fog volumes have the
///   background 0.
/// - **Narrow**: a voxel is active if a voxel on the other side of `threshold` is at most
///   `band_width` away along each axis; points outside the extent count as background. An inactive
///   voxel on the same side of the threshold as the background has the background value. An
///   inactive voxel on the other side has the value 2 x threshold - background. By default these
///   two values are 0 and 1. The isosurface at the threshold is therefore equal to the isosurface
///   of the full grid, and the file is much smaller. The grid class is "unknown": the grid is not a
///   density, because the inside is inactive, and not a level set, because the values are not
///   distances. Programs must extract the surface at isovalue `threshold`.
///
/// The file is either complete or missing. The same values result in the same bytes for any number
/// of threads: the file's UUID, which is random in OpenVDB, is computed from the file's contents.
///
/// Report: counts.samples, counts.active_voxels, counts.leaf_nodes (blocks of 8 x 8 x 8 voxels that
/// are not constant), file_bytes. There is a warning if no voxel is active.
/// Return unavailable if built without OpenVDB. Return invalid_input for an empty grid, a spacing
/// that is not positive, directions that are not orthonormal, an index beyond 2^30, a value or
/// option that is not finite as a float, options out of range, a background equal to the threshold,
/// or an unwritable file.
/// A cancel takes effect within 100 ms, except while OpenVDB prepares the output, which takes 16 ns
/// per voxel in leaf nodes. Cost on one core: 11 ns per sample (narrow: 33 ns), plus 30 ns per
/// voxel in leaf nodes for compression. Memory: 5 bytes per voxel in leaf nodes (narrow: plus one
/// byte per sample).
Status write_vdb(ExecutionContext& context, const std::string& path, const SampleGrid& grid,
  const float* values, const VdbOptions& options);
Status write_vdb(ExecutionContext& context, const std::string& path, const SampleGrid& grid,
  const double* values, const VdbOptions& options);

} // namespace bindpose

#endif

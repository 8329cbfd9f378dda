#ifndef bindpose_helper_mesher_format_h
#define bindpose_helper_mesher_format_h

#include "geometry/mesh.h"
#include "winding/curve_winding_number.h"

#include <vector>

namespace bindpose
{

/// Meshes and curves that Bindpose and its helper executable bindpose-mesher exchange, as one
/// binary record. Arrays that a job does not use are empty.
struct MesherData
{
  Points points; ///< #V x 3
  Triangles triangles; ///< #F x 3
  Tets tets; ///< #T x 4
  /// #T or empty: region numbers, equal for tets that no triangle separates.
  std::vector<Index> regions;
  Segments segments; ///< #E x 2: curves in the plane z = 0
};

/// Write the record to a file descriptor.
/// @return false if the record is incomplete (for example because the disk is full).
bool write_mesher_data(int file, const MesherData& data);

/// Read a record up to the end of the file. The record is validated, because it was written by
/// another process.
/// @return true if the record has the expected size and magic bytes, all ids are in range and all
/// coordinates are finite.
bool read_mesher_data(int file, MesherData& data);

} // namespace bindpose

#endif

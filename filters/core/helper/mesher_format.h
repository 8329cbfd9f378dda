#ifndef bindpose_helper_mesher_format_h
#define bindpose_helper_mesher_format_h

#include "base/mesh.h"
#include "winding/curve_winding_number.h"

#include <vector>

namespace bindpose
{

/// Data that Bindpose and its helper executable bindpose-mesher exchange, as one binary record.
/// Parts that a job does not use are empty.
struct MesherData
{
  Points points; ///< #V x 3
  Triangles triangles; ///< #F x 3
  Tets tets; ///< #T x 4
  std::vector<Index> regions; ///< #T or empty: equal for tets that no triangle separates
  Segments segments; ///< #E x 2: curves in the plane z = 0
};

/// Write the record to a file descriptor. @return false if the record is incomplete (disk full).
bool write_mesher_data(int file, const MesherData& data);

/// Read a record up to the end of the file. Data of another process are not trusted. @return false
/// unless the record is complete: sizes and end match, all ids are in range and all coordinates are
/// finite.
bool read_mesher_data(int file, MesherData& data);

} // namespace bindpose

#endif

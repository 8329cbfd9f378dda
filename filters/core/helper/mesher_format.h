#ifndef bindpose_helper_mesher_format_h
#define bindpose_helper_mesher_format_h

#include "base/mesh.h"
#include "winding/curve_winding_number.h"

#include <vector>

namespace bindpose
{

/// What Bindpose and its helper executable bindpose-mesher hand to each other, as one binary
/// record. Parts that a job does not use stay empty.
struct MesherData
{
  Points points; ///< #V x 3
  Triangles triangles; ///< #F x 3
  Tets tets; ///< #T x 4
  std::vector<Index> regions; ///< #T or none: equal for tets that no triangle separates
  Segments segments; ///< #E x 2: curves in the plane z = 0
};

/// Writes the record to a file descriptor. @return false when not all could be written (disk full).
bool write_mesher_data(int file, const MesherData& data);

/// Reads a record up to the end of the file. @return false unless it is whole: sizes and ends fit,
/// all ids are in range and all coordinates finite. What comes from another process is not trusted.
bool read_mesher_data(int file, MesherData& data);

} // namespace bindpose

#endif

#ifndef bindpose_pictures_sequence_file_h
#define bindpose_pictures_sequence_file_h

#include "base/status.h"

#include <string>
#include <vector>

namespace bindpose
{

// Names of the numbered files of an animation, and ParaView's collection files (.pvd) that list
// them.

/// The frames of a sequence: files and times.
struct Sequence
{
  std::vector<std::string> files;
  std::vector<double> times; ///< time of each file, in seconds
};

/// Return the file of one frame of a sequence: OUT_0007.vtp for OUT.vtp.
std::string numbered_file(const std::string& path, int frame);
/// Return the collection file next to the frames: OUT.pvd for OUT.vtp.
std::string collection_file(const std::string& path);

/// Return the text of ParaView's collection file (.pvd) for files in the same folder.
std::string format_collection(const std::vector<std::string>& files, double frames_per_second);

/// Read a collection. File names are relative to its folder; files are sorted by time. Return
/// invalid_input if the file is not a collection, contains no file name, or has a time that is not
/// a number.
Status read_collection(const std::string& path, Sequence& sequence);

/// Return the number of frames per second; 24 if the times do not determine it.
double frames_per_second(const Sequence& sequence);

/// Choose at most `maximum_count` of `count` items and return their indices. They are evenly spaced
/// and include the first and the last item.
std::vector<std::size_t> evenly_spaced(std::size_t count, std::size_t maximum_count);

} // namespace bindpose

#endif

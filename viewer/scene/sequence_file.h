#ifndef bindpose_scene_sequence_file_h
#define bindpose_scene_sequence_file_h

#include "base/status.h"

#include <string>
#include <vector>

namespace bindpose
{

/// The frames of a sequence: files and when they are.
struct Sequence
{
  std::vector<std::string> files;
  std::vector<double> times; ///< seconds, one a file
};

/// OUT_0007.vtp for OUT.vtp: one frame of a sequence.
std::string numbered_file(const std::string& path, int frame);
/// OUT.pvd for OUT.vtp: the collection beside them.
std::string collection_file(const std::string& path);

/// ParaView's collection (.pvd) of files that stand beside it.
std::string format_collection(const std::vector<std::string>& files, double frames_per_second);

/// Reads a collection; its files' names are taken from its folder on, in the order of their times.
/// invalid_input: what is no collection, or one without a file or with times that are no numbers.
Status read_collection(const std::string& path, Sequence& sequence);

/// The number of frames a second, 24 where times do not tell.
double frames_per_second(const Sequence& sequence);

/// Which of `count` things to take when there is place for `most`: evenly, first and last among
/// them.
std::vector<std::size_t> evenly(std::size_t count, std::size_t most);

} // namespace bindpose

#endif

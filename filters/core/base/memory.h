#ifndef bindpose_base_memory_h
#define bindpose_base_memory_h

#include "base/mesh.h"
#include "base/status.h"

#include <string>

namespace bindpose
{

constexpr double mebibyte = 1024.0 * 1024.0;

/// Bytes that this process holds in memory; 0 where that is not known (other systems than Linux).
double resident_memory();

/// Bytes that it held at most so far. Unlike getrusage()'s, not what its parent held when it was
/// made.
double peak_memory();

/// Bytes that it could still take: the least of what the machine has available and of what the
/// limits on the process's address space and on its control group leave. Infinite where none is
/// known.
double available_memory();

/// Whether a computation fits: asked before it takes its memory, so that it ends with a sentence
/// and is not killed.
/// @param what "the weights of 24 handles on 63000 vertices", the subject of the message.
/// @param bytes that it will take besides what the process holds.
/// @param limit MiB that the whole process may hold; 0: as much as is available.
/// @return ok, or internal_error with both numbers.
Status check_memory(const std::string& what, double bytes, Index limit);

/// Bytes left under that limit.
double memory_left(Index limit);

} // namespace bindpose

#endif

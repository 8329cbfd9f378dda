#ifndef bindpose_base_memory_h
#define bindpose_base_memory_h

// Memory use of the process and checks of memory limits.

#include "base/mesh_types.h"
#include "base/status.h"

#include <string>

namespace bindpose
{

constexpr double mebibyte = 1024.0 * 1024.0;

/// Return the resident memory of this process in bytes; 0 if it is unknown (on systems other than
/// Linux).
double resident_memory();

/// Return the peak resident memory of this process in bytes. Unlike the peak that getrusage()
/// returns, the result does not include memory of the parent process.
double peak_memory();

/// Return the number of bytes that this process can still allocate. This is the minimum of the
/// machine's available memory and of the unused parts of the limits on the process's address space
/// and on its control group. The result is infinite if none of these values is known.
double available_memory();

/// Check whether a computation fits into memory. Call it before the memory is allocated, so that
/// the computation ends with a message instead of being killed.
/// @param subject subject of the error message, such as "the weights of 24 handles on 63000
/// vertices"
/// @param bytes memory of the computation in addition to the current memory of the process
/// @param limit MiB that the whole process may use; 0: all available memory
/// @return ok, or internal_error with the needed and the available memory.
Status check_memory(const std::string& subject, double bytes, Index limit);

/// Return the number of bytes that the process can still allocate.
/// @param limit MiB that the whole process may use; 0: all available memory
double remaining_memory(Index limit);

} // namespace bindpose

#endif

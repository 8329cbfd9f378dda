#ifndef bindpose_base_memory_h
#define bindpose_base_memory_h

#include "base/mesh.h"
#include "base/status.h"

namespace bindpose
{

constexpr double mebibyte = 1024.0 * 1024.0;

/// Bytes that this process could still take: the least of what the machine has available, what its
/// limit on address space leaves and what its control group leaves. Infinite where none is known
/// (other systems than Linux).
double available_memory();

/// Whether what is about to be done fits.
/// @param bytes that it will take, roughly.
/// @param limit MiB that it may take, 0: what is available.
/// @return ok or invalid_input: "WHAT needs about 5100 MiB of memory, 2048 MiB are allowed" with
/// the way out.
Status check_memory(const std::string& what, double bytes, Index limit);

} // namespace bindpose

#endif

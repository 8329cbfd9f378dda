#ifndef bindpose_linear_serial_blas_h
#define bindpose_linear_serial_blas_h

#include <mutex>

namespace bindpose
{

/// Scope in which calls of BLAS and CHOLMOD from this thread run on this thread only. If the BLAS
/// does not support concurrent calls, concurrent scopes are serialized, too.
///
/// A threaded OpenBLAS is configured once to use one thread. OpenMP regions started from this
/// thread are made inactive. OpenBLAS built without threads (libopenblas0-serial) has no locks: two
/// concurrent calls would share a work buffer and occasionally return wrong results. Therefore,
/// with this library, only one thread at a time can be in such a scope.
class SerialBlas
{
public:
  SerialBlas();
  ~SerialBlas();
  SerialBlas(const SerialBlas&) = delete;
  SerialBlas& operator=(const SerialBlas&) = delete;

private:
  std::unique_lock<std::mutex> lock_;
  void (*set_levels_)(int) = nullptr;
  int levels_ = 1;
};

} // namespace bindpose

#endif

#ifndef bindpose_base_serial_blas_h
#define bindpose_base_serial_blas_h

#include <mutex>

namespace bindpose
{

/// While it lives, calls of BLAS and CHOLMOD from this thread run on this thread alone, and never
/// at the same time as others where the BLAS cannot stand that.
///
/// A threaded OpenBLAS is told once to use one thread. OpenMP regions started from this thread are
/// made inactive. OpenBLAS built without threads (libopenblas0-serial) has no locks either: two
/// calls at the same time share a work buffer and give wrong numbers now and then. With it, one
/// call at a time.
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

// Limits BLAS and OpenMP to one thread within a scope. The functions of the BLAS in use are looked
// up at run time.
#include "linear/serial_blas.h"

#include <dlfcn.h>

namespace bindpose
{

namespace
{
template <typename Function>
Function* find_function(const char* name)
{
  return reinterpret_cast<Function*>(dlsym(RTLD_DEFAULT, name));
}
} // namespace

SerialBlas::SerialBlas()
{
  static std::once_flag once;
  std::call_once(once,
    []
    {
      if (auto* set_threads = find_function<void(int)>("openblas_set_num_threads"))
      {
        set_threads(1);
      }
    });

  static const bool exclusive = []
  {
    auto* parallel = find_function<int()>("openblas_get_parallel");
    return parallel && parallel() == 0;
  }();
  static std::mutex serial_mutex;
  if (exclusive)
  {
    this->lock_ = std::unique_lock<std::mutex>(serial_mutex);
  }

  static auto* get_levels = find_function<int()>("omp_get_max_active_levels");
  static auto* set_levels = find_function<void(int)>("omp_set_max_active_levels");
  if (get_levels && set_levels)
  {
    this->set_levels_ = set_levels;
    this->levels_ = get_levels();
    set_levels(0);
  }
}

SerialBlas::~SerialBlas()
{
  if (this->set_levels_)
  {
    this->set_levels_(this->levels_);
  }
}

} // namespace bindpose

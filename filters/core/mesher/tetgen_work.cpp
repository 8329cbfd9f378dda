// Counts the evaluations of TetGen's predicates. The dynamic linker searches the program before
// TetGen's shared library. Therefore TetGen calls the predicates in this file. These predicates
// count the evaluations and call the predicates of the library.
#include "mesher/tetgen_work.h"

#include "helper/helper_start.h"
#include "mesher/jobs.h"

#include <tetgen.h>

#include <cstdint>
#include <limits>
#include <string>

#ifdef BINDPOSE_COUNT_TETGEN_WORK
#include <dlfcn.h>
#endif

namespace
{
std::uint64_t work = 0;
std::uint64_t work_limit = std::numeric_limits<std::uint64_t>::max();
} // namespace

namespace bindpose
{

void limit_tetgen_work(double limit)
{
  work_limit = static_cast<std::uint64_t>(limit);
}

void report_tetgen_work()
{
  report_value("work", static_cast<double>(work));
}

} // namespace bindpose

#ifdef BINDPOSE_COUNT_TETGEN_WORK
namespace
{
/// Return the function of TetGen's library with this mangled name.
template <typename Function>
Function* library_function(const char* name)
{
  void* function = ::dlsym(RTLD_NEXT, name);
  if (!function)
  {
    bindpose::helper_fail(std::string("TetGen's library has no function ") + name);
  }
  return reinterpret_cast<Function*>(function);
}

void count_evaluation()
{
  if (++work > work_limit)
  {
    bindpose::report_value("work_limit_reached", 1.0);
    bindpose::report_tetgen_work();
    bindpose::helper_fail(
      "TetGen was stopped after " + std::to_string(work_limit) + " evaluations of its predicates");
  }
}
} // namespace

double orient3d(double* a, double* b, double* c, double* d)
{
  static auto* const function =
    library_function<double(double*, double*, double*, double*)>("_Z8orient3dPdS_S_S_");
  count_evaluation();
  return function(a, b, c, d);
}

double insphere(double* a, double* b, double* c, double* d, double* e)
{
  static auto* const function =
    library_function<double(double*, double*, double*, double*, double*)>("_Z8inspherePdS_S_S_S_");
  count_evaluation();
  return function(a, b, c, d, e);
}
#endif

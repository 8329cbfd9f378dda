#include "cli/fast_blas.h"

#include <cstdlib>
#include <string>

#include <dlfcn.h>
#include <unistd.h>

namespace bindpose::cli
{

void restart_with_fast_blas([[maybe_unused]] char** arguments)
{
#if defined(__x86_64__)
  constexpr const char* variable = "OPENBLAS_CORETYPE";
  auto* core_name =
    reinterpret_cast<const char* (*)()>(dlsym(RTLD_DEFAULT, "openblas_get_corename"));
  const bool has_avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  if (core_name && has_avx2 && !std::getenv(variable) && std::string(core_name()) == "Prescott")
  {
    // Haswell kernels use AVX2. On a processor with AVX-512 they are as fast as those of SkylakeX.
    setenv(variable, "Haswell", 1);
    execv("/proc/self/exe", arguments); // returns only if it fails; then continue with slow kernels
  }
#endif
}

} // namespace bindpose::cli

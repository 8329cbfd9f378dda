#ifndef bindpose_base_flush_denormals_h
#define bindpose_base_flush_denormals_h

#include <cstdint>

#if defined(__x86_64__) || defined(_M_X64)
#include <xmmintrin.h>
#endif

namespace bindpose
{

/// Scope in which this thread treats denormal numbers as zero. Denormals are numbers below 1e-38 in
/// single precision and below 1e-308 in double precision. A processor needs about 100 times as long
/// for an operation on a denormal. Denormals occur in single-precision Cholesky factors of mesh
/// matrices, because an entry decays exponentially with the distance of its two vertices. No effect
/// on processors other than x86-64 and AArch64.
class FlushDenormals
{
public:
  FlushDenormals() : before_(read()) { write(this->before_ | flush); }
  ~FlushDenormals()
  {
    // Restore only the flush bits. The exception flags and the rounding mode, which may have
    // changed in the scope, remain.
    write((read() & ~flush) | (this->before_ & flush));
  }
  FlushDenormals(const FlushDenormals&) = delete;
  FlushDenormals& operator=(const FlushDenormals&) = delete;

private:
#if defined(__x86_64__) || defined(_M_X64)
  // Denormal results (bit 15) and operands (bit 6) become zero.
  static constexpr std::uint64_t flush = 0x8040;
  static std::uint64_t read()
  {
    return _mm_getcsr();
  }
  static void write(std::uint64_t control)
  {
    _mm_setcsr(static_cast<unsigned int>(control));
  }
#elif defined(__aarch64__)
  static constexpr std::uint64_t flush = std::uint64_t(1) << 24;
  static std::uint64_t read()
  {
    std::uint64_t control = 0;
    asm volatile("mrs %0, fpcr" : "=r"(control));
    return control;
  }
  static void write(std::uint64_t control)
  {
    asm volatile("msr fpcr, %0" : : "r"(control));
  }
#else
  static constexpr std::uint64_t flush = 0;
  static std::uint64_t read()
  {
    return 0;
  }
  static void write(std::uint64_t) {}
#endif

  std::uint64_t before_; ///< value of the control register before the scope
};

} // namespace bindpose

#endif

#ifndef bindpose_base_simd_h
#define bindpose_base_simd_h

/// BINDPOSE_SIMD_CLONES in front of a function compiles it for several instruction sets; the best
/// one for the machine is selected at run time. Use it only for loops that the compiler vectorizes
/// over independent items. Then every clone computes the same bits, because multiplications and
/// additions are contracted to fused operations only in files that request it (see
/// BindposeCompiler.cmake). Functions called in the loop must be BINDPOSE_ALWAYS_INLINE, because
/// other functions use the baseline instruction set.
///
/// BINDPOSE_SIMD_WIDTHS(define, Scalar) is for loops over packs (base/packs.h). Each pack fills one
/// register. The macro expands define(version, bytes, Scalar) once for each instruction set.
/// `define` is the name of a macro that defines a function and puts `version`, a target attribute,
/// in front of it. The function works on packs of `bytes` bytes.
#if defined(__GNUC__) && !defined(__clang__) && defined(__x86_64__) && defined(__linux__) && \
  !defined(__SANITIZE_ADDRESS__)
#define BINDPOSE_SIMD_CLONES \
  __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#define BINDPOSE_SIMD_WIDTHS(define, Scalar)                      \
  define(__attribute__((target("default"))), 16, Scalar)          \
    define(__attribute__((target("arch=x86-64-v3"))), 32, Scalar) \
      define(__attribute__((target("arch=x86-64-v4"))), 64, Scalar)
#else
#define BINDPOSE_SIMD_CLONES
#define BINDPOSE_SIMD_WIDTHS(define, Scalar) define(, 16, Scalar)
#endif

#if defined(__GNUC__)
#define BINDPOSE_ALWAYS_INLINE inline __attribute__((always_inline))
#else
#define BINDPOSE_ALWAYS_INLINE inline
#endif

#endif

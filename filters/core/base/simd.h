#ifndef bindpose_base_simd_h
#define bindpose_base_simd_h

/// BINDPOSE_SIMD_CLONES in front of a function: it is compiled for several instruction sets and the
/// machine's best is taken at run time. Only for loops that the compiler vectorises over
/// independent items: then every clone gives the same bits (nothing is contracted to fused
/// operations but in files that ask for it, see BindposeCompiler.cmake). What the function calls
/// must be BINDPOSE_ALWAYS_INLINE, or it stays in the plain instruction set.
///
/// BINDPOSE_SIMD_WIDTHS(define, Scalar), where a loop works on packs of a register's size: puts
/// define(version, bytes, Scalar), a macro for a function that begins with `version` and works on
/// packs of so many bytes, once for each instruction set.
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

// SPDX-License-Identifier: BSD-3-Clause
// Functions compiled for more than one instruction set, chosen when the program starts.
#pragma once

// g++ on x86-64 only: elsewhere the one version takes what the compiler's target has. Not under a sanitizer, whose run-time is not there
// yet when the choice is made.
#if defined(__GNUC__) && !defined(__clang__) && defined(__x86_64__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define GONIO_MULTIVERSION __attribute__((target_clones("avx2", "default")))
#else
#define GONIO_MULTIVERSION
#endif

// Code written with that instruction set's own functions: behind has_avx2(), and only where GONIO_AVX2 is defined. Half numbers are
// converted by F16C, which came before AVX2 but is counted apart.
#if defined(__GNUC__) && !defined(__clang__) && defined(__x86_64__)
#define GONIO_AVX2 __attribute__((target("avx2,f16c")))
namespace gonio::tabulated {
inline bool has_avx2() noexcept {
  static const bool has = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("f16c");
  return has;
}
}  // namespace gonio::tabulated
#endif

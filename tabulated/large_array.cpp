// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/large_array.hpp"

#include <sys/mman.h>

#include <cstdlib>

namespace gonio::tabulated {
namespace {

/// Of x86-64 and most others; only speed depends on it.
constexpr std::size_t page = std::size_t{2} << 20;

}  // namespace

void* large_pages(std::size_t bytes) noexcept {
  if (bytes < page) return std::malloc(bytes);
  if (bytes > std::numeric_limits<std::size_t>::max() - page) return nullptr;
  const std::size_t whole = (bytes + page - 1) / page * page;
  void* const memory = std::aligned_alloc(page, whole);
#ifdef MADV_HUGEPAGE
  if (memory != nullptr) madvise(memory, whole, MADV_HUGEPAGE);  // a hint: refused, the memory is as good, only slower
#endif
  return memory;
}

void free_large_pages(void* memory) noexcept { std::free(memory); }

}  // namespace gonio::tabulated

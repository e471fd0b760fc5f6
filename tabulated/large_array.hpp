// SPDX-License-Identifier: BSD-3-Clause
// Memory for tables that are looked up at random places.
#pragma once

#include <cstddef>
#include <limits>
#include <new>
#include <vector>

namespace gonio::tabulated {

/// Memory in large pages where the system gives them: a table of many megabytes then needs a handful of page translations instead of
/// thousands, which is half the time of a random lookup. Null if there is none left.
void* large_pages(std::size_t bytes) noexcept;
void free_large_pages(void* memory) noexcept;

template <class T>
struct LargePageAllocator {
  using value_type = T;
  LargePageAllocator() = default;
  template <class U>
  LargePageAllocator(const LargePageAllocator<U>&) noexcept {}

  T* allocate(std::size_t count) {
    void* const memory = count > std::numeric_limits<std::size_t>::max() / sizeof(T) ? nullptr : large_pages(count * sizeof(T));
    if (memory == nullptr) throw std::bad_alloc();
    return static_cast<T*>(memory);
  }
  void deallocate(T* memory, std::size_t) noexcept { free_large_pages(memory); }
  friend bool operator==(const LargePageAllocator&, const LargePageAllocator&) { return true; }
};

template <class T>
using LargeArray = std::vector<T, LargePageAllocator<T>>;

}  // namespace gonio::tabulated

// array.hpp: the contiguous, 64-byte aligned array that all per-particle and per-contact data live in.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

namespace wedge {

/// Index of a particle, an image or a contact row. 32 bits: two billion rows, half the traffic of 64.
using Index = std::int32_t;

inline constexpr std::size_t cache_line = 64;  // bytes; also the width of one AVX-512 register

/// Allocator of cache-line aligned storage that leaves new numbers unset, so that the thread
/// that first writes a page is the thread that gets it (first touch).
template <class T>
struct AlignedAllocator {
  using value_type = T;
  AlignedAllocator() = default;
  template <class U>
  AlignedAllocator(const AlignedAllocator<U>&) noexcept {}
  T* allocate(std::size_t n) {
    return static_cast<T*>(::operator new (n * sizeof(T), std::align_val_t{cache_line}));
  }
  void deallocate(T* p, std::size_t) noexcept { ::operator delete (p, std::align_val_t{cache_line}); }
  template <class U, class... Arguments>
  void construct(U* p, Arguments&&... arguments) {
    if constexpr (sizeof...(Arguments) == 0 && std::is_trivially_default_constructible_v<U>) {
      ::new (static_cast<void*>(p)) U;
    } else {
      ::new (static_cast<void*>(p)) U(std::forward<Arguments>(arguments)...);
    }
  }
  template <class U>
  bool operator==(const AlignedAllocator<U>&) const noexcept {
    return true;
  }
  template <class U>
  bool operator!=(const AlignedAllocator<U>&) const noexcept {
    return false;
  }
};

/// A std::vector whose resize() does not initialise: whoever resizes, writes.
template <class T>
using Array = std::vector<T, AlignedAllocator<T>>;

/// Resizes without keeping what was there: the old numbers are gone before there are new ones. Makes room for
/// growth, and gives back memory that a fuller time needed.
template <class T>
void resize_anew(Array<T>& array, std::size_t n) {
  const std::size_t room = n + n / 16 + 64;
  if (n > array.capacity() || array.capacity() > 2 * room) {
    Array<T>().swap(array);
    array.reserve(room);
  }
  array.resize(n);
}

}  // namespace wedge

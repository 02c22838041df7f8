// parallel.hpp: the one header with OpenMP in it: blocks of fixed size, and sums in a fixed order.
//
// A loop is cut into blocks of `block_size` elements, whatever the number of threads. A block is always
// computed as a whole, so the elements that fall into a scalar remainder are the same for 1 or 64 threads, and a
// reduction adds block results in block order. Results are therefore bit-identical for any number of threads.
#pragma once

#include <algorithm>
#include <vector>

#include "core/array.hpp"

#ifdef _OPENMP
#include <omp.h>
#endif

/// Put before an inner loop whose iterations are independent (each writes its own slot).
#define WEDGE_SIMD _Pragma("omp simd")
/// The same where the iterations also add to the named local sums (in a fixed order of lanes).
#define WEDGE_PRAGMA(text) _Pragma(#text)
#define WEDGE_SIMD_SUM(...) WEDGE_PRAGMA(omp simd reduction(+ : __VA_ARGS__))

namespace wedge {

inline constexpr Index block_size = 512;  // a multiple of every vector width

inline Index block_count(Index n) { return (n + block_size - 1) / block_size; }

#ifdef _OPENMP
inline void set_thread_count(int threads) { omp_set_num_threads(std::max(1, threads)); }
inline int thread_count() { return omp_get_max_threads(); }
inline int processor_count() { return omp_get_num_procs(); }
#else
inline void set_thread_count(int) {}
inline int thread_count() { return 1; }
inline int processor_count() { return 1; }
#endif

/// Calls body(block) for block = 0 .. blocks-1 in parallel. Pre: bodies write disjoint memory and do not throw.
template <class Body>
void for_each_block(Index blocks, Body&& body) {
  if (blocks <= 1) {  // not worth waking the threads
    if (blocks == 1) body(Index{0});
    return;
  }
#ifdef _OPENMP
#pragma omp parallel for schedule(static)
#endif
  for (Index b = 0; b < blocks; ++b) body(b);
}

/// Calls body(begin, end) for each block of 0 .. n-1 in parallel. Pre: as for_each_block.
template <class Body>
void for_blocks(Index n, Body&& body) {
  for_each_block(block_count(n), [&](Index b) { body(b * block_size, std::min<Index>(n, (b + 1) * block_size)); });
}

/// Calls body(i) for i = 0 .. n-1 in parallel. Pre: as for_each_block.
template <class Body>
void for_each(Index n, Body&& body) {
  for_blocks(n, [&](Index begin, Index end) {
    for (Index i = begin; i < end; ++i) body(i);
  });
}

/// Combines body(block) for block = 0 .. blocks-1 in their order, starting from `start`.
/// Post: the result does not depend on the number of threads.
template <class T, class Body, class Combine>
T reduce_each_block(Index blocks, T start, Body&& body, Combine&& combine) {
  std::vector<T> partial(static_cast<std::size_t>(blocks), start);
  for_each_block(blocks, [&](Index b) { partial[static_cast<std::size_t>(b)] = body(b); });
  T total = start;
  for (const T& p : partial) total = combine(total, p);
  return total;
}

/// The same for body(begin, end) of all blocks of 0 .. n-1.
template <class T, class Body, class Combine>
T reduce_blocks(Index n, T start, Body&& body, Combine&& combine) {
  return reduce_each_block(
      block_count(n), start,
      [&](Index b) { return body(b * block_size, std::min<Index>(n, (b + 1) * block_size)); }, combine);
}

}  // namespace wedge

// pack.hpp: as many numbers as the processor computes with one instruction, and records of eight turned into
// columns.
//
// Laws are written once for a number type `Real`: double for one contact, a pack for as many as fit. Packs are
// those of the Parallelism TS 2 in the standard library (std::experimental::native_simd).
#pragma once

#include <experimental/simd>

#include "core/vec3.hpp"

/// For small functions of packs, which must not pass them through memory.
#define WEDGE_INLINE __attribute__((always_inline)) inline

namespace wedge {

namespace simd = std::experimental;

/// A pack of doubles or of floats.
template <class Number>
using PackOf = simd::native_simd<Number>;
using Pack = PackOf<double>;
template <class Number>
using PackVec3Of = Vector3<PackOf<Number>>;
using PackVec3 = PackVec3Of<double>;

/// Numbers in a pack. Divides 8, or 16 of floats, on all processors with vectors of up to 64 bytes.
template <class Number>
inline constexpr Index lanes = static_cast<Index>(PackOf<Number>::size());
inline constexpr Index pack_size = lanes<double>;
static_assert(8 % lanes<double> == 0 && 16 % lanes<float> == 0, "slabs are a whole number of packs");

/// The type of the numbers in Real: itself, or that of the numbers of a pack.
template <class Real>
struct NumberIn {
  using type = Real;
};
template <class Number, class Abi>
struct NumberIn<simd::simd<Number, Abi>> {
  using type = Number;
};
template <class Real>
using number_in = typename NumberIn<Real>::type;

/// A constant in the width of Real. (Packs of floats do not take doubles by themselves.)
template <class Real>
constexpr number_in<Real> constant(double value) {
  return static_cast<number_in<Real>>(value);
}

inline bool any_lane(bool condition) { return condition; }
inline double select(bool condition, double yes, double no) { return condition ? yes : no; }

template <class Number, class Abi>
WEDGE_INLINE simd::simd<Number, Abi> select(const simd::simd_mask<Number, Abi>& condition,
                                            const plain_t<simd::simd<Number, Abi>>& yes,
                                            plain_t<simd::simd<Number, Abi>> no) {
  simd::where(condition, no) = yes;
  return no;
}
template <class Number, class Abi>
WEDGE_INLINE bool any_lane(const simd::simd_mask<Number, Abi>& condition) {
  return simd::any_of(condition);
}

/// Calls visit(lane) for each lane where the condition holds, ascending.
template <class Visit>
WEDGE_INLINE void for_each_lane(Pack::mask_type condition, Visit&& visit) {
  while (simd::any_of(condition)) {
    const int lane = simd::find_first_set(condition);
    condition[static_cast<std::size_t>(lane)] = false;
    visit(static_cast<Index>(lane));
  }
}

/// A pack from memory, or one number.
template <class Real = Pack>
WEDGE_INLINE Real load(const double* numbers) {
  if constexpr (std::is_same_v<Real, double>)
    return *numbers;
  else
    return Real(numbers, simd::element_aligned);
}
template <class Number, class Abi>
WEDGE_INLINE void store(double* numbers, const simd::simd<Number, Abi>& pack) {
  pack.copy_to(numbers, simd::element_aligned);
}
inline void store(double* number, double value) { *number = value; }

/// Records of eight doubles (a cache line), of four, and of eight floats.
typedef double Eight __attribute__((vector_size(64), may_alias));
typedef double Four __attribute__((vector_size(32), may_alias));
typedef float EightFloats __attribute__((vector_size(32), may_alias));
/// The same eight numbers where they begin anywhere.
typedef double UnalignedEight __attribute__((vector_size(64), aligned(8), may_alias));

template <class Number>
struct EightOf {
  using type = Eight;
};
template <>
struct EightOf<float> {
  using type = EightFloats;
};
template <class Number>
using eight_of = typename EightOf<Number>::type;

#ifdef __AVX512F__
/// out[c][r] = in[r][c] for eight records of eight numbers.
WEDGE_INLINE void transpose(const Eight (&in)[8], Eight (&out)[8]) {
  Eight pairs[8], fours[8];
  for (int m = 0; m < 8; m += 2) {
    pairs[m] = __builtin_shufflevector(in[m], in[m + 1], 0, 8, 2, 10, 4, 12, 6, 14);
    pairs[m + 1] = __builtin_shufflevector(in[m], in[m + 1], 1, 9, 3, 11, 5, 13, 7, 15);
  }
  for (int m = 0; m < 8; m += 4) {
    for (int k = 0; k < 2; ++k) {
      fours[m + k] = __builtin_shufflevector(pairs[m + k], pairs[m + k + 2], 0, 1, 8, 9, 4, 5, 12, 13);
      fours[m + k + 2] = __builtin_shufflevector(pairs[m + k], pairs[m + k + 2], 2, 3, 10, 11, 6, 7, 14, 15);
    }
  }
  for (int m = 0; m < 4; ++m) {
    out[m] = __builtin_shufflevector(fours[m], fours[m + 4], 0, 1, 2, 3, 8, 9, 10, 11);
    out[m + 4] = __builtin_shufflevector(fours[m], fours[m + 4], 4, 5, 6, 7, 12, 13, 14, 15);
  }
}
#else
WEDGE_INLINE void transpose(const Eight (&in)[8], Eight (&out)[8]) {
  const auto half = [](const Eight& v, int h) { return reinterpret_cast<const Four*>(&v)[h]; };
  for (int row = 0; row < 2; ++row) {
    for (int column = 0; column < 2; ++column) {
      Four pairs[4];
      for (int m = 0; m < 4; m += 2) {
        const Four a = half(in[4 * row + m], column), b = half(in[4 * row + m + 1], column);
        pairs[m] = __builtin_shufflevector(a, b, 0, 4, 2, 6);
        pairs[m + 1] = __builtin_shufflevector(a, b, 1, 5, 3, 7);
      }
      for (int m = 0; m < 2; ++m) {
        reinterpret_cast<Four*>(&out[4 * column + m])[row] =
            __builtin_shufflevector(pairs[m], pairs[m + 2], 0, 1, 4, 5);
        reinterpret_cast<Four*>(&out[4 * column + m + 2])[row] =
            __builtin_shufflevector(pairs[m], pairs[m + 2], 2, 3, 6, 7);
      }
    }
  }
}
#endif

WEDGE_INLINE void transpose(const EightFloats (&in)[8], EightFloats (&out)[8]) {
  EightFloats pairs[8], fours[8];
  for (int m = 0; m < 8; m += 2) {
    pairs[m] = __builtin_shufflevector(in[m], in[m + 1], 0, 8, 1, 9, 4, 12, 5, 13);
    pairs[m + 1] = __builtin_shufflevector(in[m], in[m + 1], 2, 10, 3, 11, 6, 14, 7, 15);
  }
  for (int m = 0; m < 8; m += 4) {
    for (int k = 0; k < 2; ++k) {
      fours[m + 2 * k] = __builtin_shufflevector(pairs[m + k], pairs[m + k + 2], 0, 1, 8, 9, 4, 5, 12, 13);
      fours[m + 2 * k + 1] = __builtin_shufflevector(pairs[m + k], pairs[m + k + 2], 2, 3, 10, 11, 6, 7, 14, 15);
    }
  }
  for (int m = 0; m < 4; ++m) {
    out[m] = __builtin_shufflevector(fours[m], fours[m + 4], 0, 1, 2, 3, 8, 9, 10, 11);
    out[m + 4] = __builtin_shufflevector(fours[m], fours[m + 4], 4, 5, 6, 7, 12, 13, 14, 15);
  }
}

/// The same for eight records of four, to columns and back.
WEDGE_INLINE void transpose(const Four (&in)[8], Eight (&out)[4]) {
  Eight both[4], pairs[4];
  for (int m = 0; m < 4; ++m) both[m] = __builtin_shufflevector(in[m], in[m + 4], 0, 1, 2, 3, 4, 5, 6, 7);
  for (int m = 0; m < 4; m += 2) {
    pairs[m] = __builtin_shufflevector(both[m], both[m + 1], 0, 8, 2, 10, 4, 12, 6, 14);
    pairs[m + 1] = __builtin_shufflevector(both[m], both[m + 1], 1, 9, 3, 11, 5, 13, 7, 15);
  }
  for (int k = 0; k < 2; ++k) {
    out[k] = __builtin_shufflevector(pairs[k], pairs[k + 2], 0, 1, 8, 9, 4, 5, 12, 13);
    out[k + 2] = __builtin_shufflevector(pairs[k], pairs[k + 2], 2, 3, 10, 11, 6, 7, 14, 15);
  }
}
WEDGE_INLINE void transpose(const Eight (&in)[4], Four (&out)[8]) {
  Eight pairs[4], both[4];
  for (int m = 0; m < 4; m += 2) {
    pairs[m] = __builtin_shufflevector(in[m], in[m + 1], 0, 8, 2, 10, 4, 12, 6, 14);
    pairs[m + 1] = __builtin_shufflevector(in[m], in[m + 1], 1, 9, 3, 11, 5, 13, 7, 15);
  }
  for (int k = 0; k < 2; ++k) {
    both[k] = __builtin_shufflevector(pairs[k], pairs[k + 2], 0, 1, 8, 9, 4, 5, 12, 13);
    both[k + 2] = __builtin_shufflevector(pairs[k], pairs[k + 2], 2, 3, 10, 11, 6, 7, 14, 15);
  }
  for (int m = 0; m < 4; ++m) {
    out[m] = __builtin_shufflevector(both[m], both[m], 0, 1, 2, 3);
    out[m + 4] = __builtin_shufflevector(both[m], both[m], 4, 5, 6, 7);
  }
}

}  // namespace wedge

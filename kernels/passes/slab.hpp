// slab.hpp: rows of the contact table a slab at a time: what their grains show is collected into columns, and what
// comes of it goes from columns to the sums of the grains.
//
// Between the two the law computes packs from columns, without gathers and scatters: a vector that is gathered
// number by number costs more than the law itself (perf/README.md). `Number` is the width of the work on contacts,
// double or float (core/precision.hpp).
#pragma once

#include "core/material.hpp"
#include "core/particles.hpp"
#include "kernels/passes/force_sums.hpp"

namespace wedge {

inline constexpr Index slab_size = 64;  // rows: what a slab needs stays in the first-level cache

template <class Number>
struct alignas(cache_line) ColumnOf {
  using Real = PackOf<Number>;
  Number number[slab_size];
  WEDGE_INLINE Real load(Index row) const { return Real(number + row, simd::element_aligned); }
  WEDGE_INLINE void store(Index row, const Real& pack) { pack.copy_to(number + row, simd::element_aligned); }
  /// Eight numbers, of any width.
  template <class Record>
  WEDGE_INLINE void store_eight(Index row, const Record& eight) {
    *reinterpret_cast<eight_of<Number>*>(number + row) = __builtin_convertvector(eight, eight_of<Number>);
  }
  WEDGE_INLINE eight_of<Number> load_eight(Index row) const {
    return *reinterpret_cast<const eight_of<Number>*>(number + row);
  }
};
using Column = ColumnOf<double>;

template <class Number>
struct VectorColumnsOf {
  ColumnOf<Number> x, y, z;
  WEDGE_INLINE PackVec3Of<Number> load(Index row) const { return {x.load(row), y.load(row), z.load(row)}; }
  WEDGE_INLINE void store(Index row, const PackVec3Of<Number>& v) {
    x.store(row, v.x);
    y.store(row, v.y);
    z.store(row, v.z);
  }
};
using VectorColumns = VectorColumnsOf<double>;

/// What the rows of a slab see of their two grains. From spin_difference on, filled only where grains differ.
template <class Number>
struct SeenSlab {
  VectorColumnsOf<Number> apart;  // m: from the second to the first
  ColumnOf<Number> closeness;     // m2: (r_i + r_j)^2 - |apart|^2, of doubles; only where Number is float
  VectorColumnsOf<Number> speed;  // m/s: first less second
  VectorColumnsOf<Number> spins;  // rad/s: first and second together
  VectorColumnsOf<Number> spin_difference;
  ColumnOf<Number> radius_first, radius_second, mass_first, mass_second;
  Index materials[slab_size];  // slot of the pair in a PairTable
};

/// The grains of the rows of a slab.
struct SlabRows {
  const Index *first, *second;
  const Index* soon;  // `count` entries of `second` of later rows: their grains are asked for meanwhile
  Index count;
};

/// Rows of a slab with those that fill its last pack, or record of eight.
template <class Number>
constexpr Index filled(Index rows) {
  constexpr Index whole = std::max<Index>(8, lanes<Number>);
  return (rows + whole - 1) / whole * whole;
}

/// Collects the rows of a slab, and repeats the last one to fill the last pack. Pre: 0 < rows.count <= slab_size.
/// Compiled once, as add_to_sums is, in slab.cpp.
template <bool alike, bool spinning, class Number>
void collect(const SeenOf<Number>* seen, const SlabRows& rows, SeenSlab<Number>& s);

/// What the first grain of each row feels, in the columns of a sum (see ForceSums); the second feels the opposite
/// force. Its torque is the same where grains are alike, and its own otherwise.
template <class Number>
struct OutcomeSlab {
  ColumnOf<Number> column[ForceSums::sum_size];
  VectorColumnsOf<Number> second_torque;
};

/// Adds the outcome of each row to the sums of its two grains, row by row.
template <bool same_torque, class Number>
void add_to_sums(const OutcomeSlab<Number>& slab, const Index* first, const Index* target, Index rows,
                 Number* sums);

}  // namespace wedge

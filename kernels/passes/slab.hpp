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

/// Calls take(r, first grain, second grain) for eight rows from `row` on; rows beyond the last repeat it.
template <class Number, class Take>
WEDGE_INLINE void for_eight(const SeenOf<Number>* seen, const SlabRows& rows, Index row, Take&& take) {
  for (Index r = 0; r < 8; ++r) {
    const Index k = std::min(row + r, rows.count - 1);
    __builtin_prefetch(&seen[rows.soon[k]]);
    if constexpr (sizeof(*seen) > cache_line) __builtin_prefetch(&seen[rows.soon[k]].angular_velocity);
    take(r, seen[rows.first[k]], seen[rows.second[k]]);
  }
}

/// What eight rows see of the motion of their grains, to columns.
template <bool spinning>
WEDGE_INLINE void collect_motion(const Seen* seen, const SlabRows& rows, Index row, SeenSlab<double>& s) {
  Eight motion[8], columns[8];
  Four spins[8];
  for_eight(seen, rows, row, [&](Index r, const Seen& i, const Seen& j) {
    motion[r] = *reinterpret_cast<const UnalignedEight*>(&i) - *reinterpret_cast<const UnalignedEight*>(&j);
    if constexpr (spinning)
      spins[r] =
          *reinterpret_cast<const Four*>(&i.angular_velocity) + *reinterpret_cast<const Four*>(&j.angular_velocity);
  });
  transpose(motion, columns);
  s.apart.x.store_eight(row, columns[0]);
  s.apart.y.store_eight(row, columns[1]);
  s.apart.z.store_eight(row, columns[2]);
  s.speed.x.store_eight(row, columns[4]);
  s.speed.y.store_eight(row, columns[5]);
  s.speed.z.store_eight(row, columns[6]);
  if constexpr (spinning) {
    Eight turned[4];
    transpose(spins, turned);
    s.spins.x.store_eight(row, turned[0]);
    s.spins.y.store_eight(row, turned[1]);
    s.spins.z.store_eight(row, turned[2]);
  }
}

/// The same in single precision; but an overlap, the small difference of large lengths, begins with doubles.
template <bool spinning>
WEDGE_INLINE void collect_motion(const SeenOf<float>* seen, const SlabRows& rows, Index row, SeenSlab<float>& s) {
  constexpr Four less_but_radii{-1, -1, -1, 1};
  constexpr EightFloats less_but_spins{-1, -1, -1, 1, 1, 1, 1, 1};
  Four places[8];
  Eight columns[4];
  EightFloats motion[8], turned[8];
  for_eight(seen, rows, row, [&](Index r, const SeenOf<float>& i, const SeenOf<float>& j) {
    places[r] =
        *reinterpret_cast<const Four*>(&i.position) + less_but_radii * *reinterpret_cast<const Four*>(&j.position);
    motion[r] = *reinterpret_cast<const EightFloats*>(&i.velocity) +
                less_but_spins * *reinterpret_cast<const EightFloats*>(&j.velocity);
  });
  transpose(places, columns);
  transpose(motion, turned);
  s.apart.x.store_eight(row, columns[0]);
  s.apart.y.store_eight(row, columns[1]);
  s.apart.z.store_eight(row, columns[2]);
  s.closeness.store_eight(
      row, columns[3] * columns[3] - (columns[0] * columns[0] + columns[1] * columns[1] + columns[2] * columns[2]));
  s.speed.x.store_eight(row, turned[0]);
  s.speed.y.store_eight(row, turned[1]);
  s.speed.z.store_eight(row, turned[2]);
  if constexpr (spinning) {
    s.spins.x.store_eight(row, turned[4]);
    s.spins.y.store_eight(row, turned[5]);
    s.spins.z.store_eight(row, turned[6]);
  }
}

/// Rows of a slab with those that fill its last pack, or record of eight.
template <class Number>
constexpr Index filled(Index rows) {
  constexpr Index whole = std::max<Index>(8, lanes<Number>);
  return (rows + whole - 1) / whole * whole;
}

/// What eight rows see of the kinds of their grains, where these differ, and of the difference of their spins.
template <bool spinning, class Number>
inline void collect_kinds(const SeenOf<Number>* seen, const SlabRows& rows, Index row, SeenSlab<Number>& s) {
  for_eight(seen, rows, row, [&](Index r, const SeenOf<Number>& i, const SeenOf<Number>& j) {
    const Index k = row + r;
    s.radius_first.number[k] = static_cast<Number>(i.radius);
    s.radius_second.number[k] = static_cast<Number>(j.radius);
    s.mass_first.number[k] = i.mass;
    s.mass_second.number[k] = j.mass;
    s.materials[k] = PairTable<double>::slot(static_cast<int>(i.material), static_cast<int>(j.material));
    if constexpr (spinning) {
      const Vector3<Number> difference = i.angular_velocity - j.angular_velocity;
      s.spin_difference.x.number[k] = difference.x;
      s.spin_difference.y.number[k] = difference.y;
      s.spin_difference.z.number[k] = difference.z;
    }
  });
}

/// Collects the rows of a slab, and repeats the last one to fill the last pack. Pre: 0 < rows.count <= slab_size.
template <bool alike, bool spinning, class Number>
inline void collect(const SeenOf<Number>* seen, const SlabRows& rows, SeenSlab<Number>& s) {
  for (Index row = 0; row < filled<Number>(rows.count); row += 8) {
    collect_motion<spinning>(seen, rows, row, s);
    if constexpr (!alike) collect_kinds<spinning>(seen, rows, row, s);
  }
}

/// What the first grain of each row feels, in the columns of a sum (see ForceSums); the second feels the opposite
/// force. Its torque is the same where grains are alike, and its own otherwise.
template <class Number>
struct OutcomeSlab {
  ColumnOf<Number> column[ForceSums::sum_size];
  VectorColumnsOf<Number> second_torque;
};

/// Adds the outcome of each row to the sums of its two grains, row by row.
template <bool same_torque, class Number>
inline void add_to_sums(const OutcomeSlab<Number>& slab, const Index* first, const Index* target, Index rows,
                        Number* sums) {
  using Record = eight_of<Number>;
  constexpr Record opposite{-1, -1, -1, 1, 1, 1, 1, 1};
  auto* sum = reinterpret_cast<Record*>(sums);
  for (Index row = 0; row < rows; row += 8) {
    Record columns[8], on_first[8], on_second[8];
    for (std::size_t c = 0; c < 8; ++c) columns[c] = slab.column[c].load_eight(row);
    transpose(columns, on_first);
    if constexpr (!same_torque) {
      columns[3] = slab.second_torque.x.load_eight(row);
      columns[4] = slab.second_torque.y.load_eight(row);
      columns[5] = slab.second_torque.z.load_eight(row);
      transpose(columns, on_second);
    }
    const Index count = std::min<Index>(8, rows - row);
    for (Index r = 0; r < count; ++r) {
      sum[first[row + r]] += on_first[r];
      sum[target[row + r]] += opposite * (same_torque ? on_first[r] : on_second[r]);
    }
  }
}

}  // namespace wedge

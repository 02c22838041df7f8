// slab.hpp: rows of the contact table a slab at a time: what their grains show is collected into columns, and what
// comes of it goes from columns to the sums of the grains.
//
// Between the two the law computes packs from columns, without gathers and scatters: a vector that is gathered
// number by number costs more than the law itself (perf/README.md).
#pragma once

#include "core/material.hpp"
#include "core/particles.hpp"
#include "kernels/reactions.hpp"

namespace wedge {

inline constexpr Index slab_size = 64;  // rows: what a slab needs stays in the first-level cache

struct alignas(cache_line) Column {
  double number[slab_size];
  WEDGE_INLINE Pack load(Index row) const { return Pack(number + row, simd::element_aligned); }
  WEDGE_INLINE void store(Index row, const Pack& pack) { pack.copy_to(number + row, simd::element_aligned); }
};
struct VectorColumns {
  Column x, y, z;
  WEDGE_INLINE PackVec3 load(Index row) const { return {x.load(row), y.load(row), z.load(row)}; }
  WEDGE_INLINE void store(Index row, const PackVec3& v) {
    x.store(row, v.x);
    y.store(row, v.y);
    z.store(row, v.z);
  }
};

/// What the rows of a slab see of their two grains. The last lines are filled only where grains differ.
struct SeenSlab {
  VectorColumns apart;  // m: from the second to the first
  VectorColumns speed;  // m/s: first less second
  VectorColumns spins;  // rad/s: first and second together
  VectorColumns spin_difference;
  Column radius_first, radius_second, mass_first, mass_second;
  Index materials[slab_size];  // slot of the pair in a PairTable
};

template <std::size_t columns>
WEDGE_INLINE void store_columns(const Eight (&records)[8], Column* const (&to)[columns], Index row) {
  Eight turned[8];
  transpose(records, turned);
  for (std::size_t c = 0; c < columns; ++c) *reinterpret_cast<Eight*>(to[c]->number + row) = turned[c];
}

/// The grains of the rows of a slab.
struct SlabRows {
  const Index *first, *second;
  const Index*
      soon;  // `second` of rows that come soon, as many: their grains are fetched while these are collected
  Index count;
};

/// Collects rows, eight at a time; rows beyond the last repeat it. Pre: 0 < rows.count <= slab_size.
template <bool alike, bool spinning>
inline void collect(const Seen* seen, const SlabRows& rows, SeenSlab& s) {
  for (Index row = 0; row < rows.count; row += 8) {
    Eight motion[8], spins[8], difference[8];
    for (Index r = 0; r < 8; ++r) {
      const Index k = std::min(row + r, rows.count - 1);
      const Seen &i = seen[rows.first[k]], &j = seen[rows.second[k]];
      __builtin_prefetch(&seen[rows.soon[k]]);
      __builtin_prefetch(&seen[rows.soon[k]].angular_velocity);
      motion[r] = *reinterpret_cast<const UnalignedEight*>(&i) - *reinterpret_cast<const UnalignedEight*>(&j);
      if constexpr (spinning) {
        const Four wi = *reinterpret_cast<const Four*>(&i.angular_velocity),
                   wj = *reinterpret_cast<const Four*>(&j.angular_velocity);
        const Four sum = wi + wj, less = wi - wj;
        spins[r] = __builtin_shufflevector(sum, sum, 0, 1, 2, 3, 4, 5, 6, 7);
        if constexpr (!alike) difference[r] = __builtin_shufflevector(less, less, 0, 1, 2, 3, 4, 5, 6, 7);
      }
      if constexpr (!alike) {
        s.radius_first.number[row + r] = i.radius;
        s.radius_second.number[row + r] = j.radius;
        s.mass_first.number[row + r] = i.mass;
        s.mass_second.number[row + r] = j.mass;
        s.materials[row + r] = PairTable<double>::slot(static_cast<int>(i.material), static_cast<int>(j.material));
      }
    }
    store_columns<6>(motion, {&s.apart.x, &s.apart.y, &s.apart.z, &s.speed.x, &s.speed.y, &s.speed.z}, row);
    if constexpr (spinning) store_columns<3>(spins, {&s.spins.x, &s.spins.y, &s.spins.z}, row);
    if constexpr (spinning && !alike)
      store_columns<3>(difference, {&s.spin_difference.x, &s.spin_difference.y, &s.spin_difference.z}, row);
  }
}

/// What the first grain of each row feels, in the columns of a sum (see Reactions); the second feels the opposite
/// force. Its torque is the same where grains are alike, and its own otherwise.
struct OutcomeSlab {
  Column column[Reactions::sum_size];
  VectorColumns second_torque;
};

/// Adds the outcome of each row to the sums of its two grains, row by row.
template <bool same_torque>
inline void add_to_sums(const OutcomeSlab& slab, const Index* first, const Index* target, Index rows,
                        double* sums) {
  constexpr Eight opposite{-1, -1, -1, 1, 1, 1, 1, 1};
  auto* sum = reinterpret_cast<Eight*>(sums);
  for (Index row = 0; row < rows; row += 8) {
    Eight columns[8], on_first[8], on_second[8];
    for (std::size_t c = 0; c < 8; ++c) columns[c] = *reinterpret_cast<const Eight*>(slab.column[c].number + row);
    transpose(columns, on_first);
    if constexpr (!same_torque) {
      columns[3] = *reinterpret_cast<const Eight*>(slab.second_torque.x.number + row);
      columns[4] = *reinterpret_cast<const Eight*>(slab.second_torque.y.number + row);
      columns[5] = *reinterpret_cast<const Eight*>(slab.second_torque.z.number + row);
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

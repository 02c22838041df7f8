// slab.cpp: from records to columns, and back.
#include "kernels/passes/slab.hpp"

namespace wedge {
namespace {

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

template <bool alike, bool spinning, class Number>
WEDGE_INLINE void collect_rows(const SeenOf<Number>* seen, const SlabRows& rows, SeenSlab<Number>& s) {
  for (Index row = 0; row < filled<Number>(rows.count); row += 8) {
    collect_motion<spinning>(seen, rows, row, s);
    if constexpr (!alike) collect_kinds<spinning>(seen, rows, row, s);
  }
}

}  // namespace

template <bool alike, bool spinning, class Number>
void collect(const SeenOf<Number>* seen, const SlabRows& rows, SeenSlab<Number>& s) {
  if (rows.count == slab_size)  // most are whole: a bound that the compiler knows
    collect_rows<alike, spinning>(seen, {rows.first, rows.second, rows.soon, slab_size}, s);
  else
    collect_rows<alike, spinning>(seen, rows, s);
}

template <bool same_torque, class Number>
void add_to_sums(const OutcomeSlab<Number>& slab, const Index* first, const Index* target, Index rows,
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

#define WEDGE_SLAB(Number)                                                                                 \
  template void collect<true, true>(const SeenOf<Number>*, const SlabRows&, SeenSlab<Number>&);            \
  template void collect<true, false>(const SeenOf<Number>*, const SlabRows&, SeenSlab<Number>&);           \
  template void collect<false, true>(const SeenOf<Number>*, const SlabRows&, SeenSlab<Number>&);           \
  template void collect<false, false>(const SeenOf<Number>*, const SlabRows&, SeenSlab<Number>&);          \
  template void add_to_sums<true>(const OutcomeSlab<Number>&, const Index*, const Index*, Index, Number*); \
  template void add_to_sums<false>(const OutcomeSlab<Number>&, const Index*, const Index*, Index, Number*);
WEDGE_SLAB(double)
WEDGE_SLAB(float)
#undef WEDGE_SLAB

}  // namespace wedge

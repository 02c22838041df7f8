// grain_columns.cpp: transposes grains eight at a time.
#include "kernels/passes/grain_columns.hpp"

namespace wedge {
namespace {

template <class Number>
WEDGE_INLINE void write_in(const Column* number, SeenOf<Number>* to, Index count) {
  for (Index row = 0; row < count; row += 8) {
    const auto columns = [&](std::size_t c) { return number[c].load_eight(row); };
    const auto narrow = [&](std::size_t c) { return __builtin_convertvector(columns(c), EightFloats); };
    const Index rows = std::min<Index>(8, count - row);
    if constexpr (std::is_same_v<Number, float>) {
      const Eight place[] = {columns(0), columns(1), columns(2), columns(3)};
      const EightFloats motion[] = {narrow(4), narrow(5), narrow(6),  narrow(7),
                                    narrow(8), narrow(9), narrow(10), narrow(11)};
      Four places[8];
      EightFloats motions[8];
      transpose(place, places);
      transpose(motion, motions);
      for (Index r = 0; r < rows; ++r) {
        *reinterpret_cast<Four*>(&to[row + r].position) = places[r];
        *reinterpret_cast<EightFloats*>(&to[row + r].velocity) = motions[r];
      }
    } else {
      const Eight motion[] = {columns(0), columns(1), columns(2), columns(3),
                              columns(4), columns(5), columns(6), columns(7)};
      const Eight spin[] = {columns(8), columns(9), columns(10), columns(11)};
      Eight motions[8];
      Four spins[8];
      transpose(motion, motions);
      transpose(spin, spins);
      for (Index r = 0; r < rows; ++r) {
        *reinterpret_cast<UnalignedEight*>(&to[row + r]) = motions[r];
        *reinterpret_cast<Four*>(&to[row + r].angular_velocity) = spins[r];
      }
    }
  }
}
template <class Number>
WEDGE_INLINE void read_in(Column* number, const Number* sums, Index count) {
  for (Index row = 0; row < count; row += 8) {
    eight_of<Number> records[8], columns[8];
    for (Index r = 0; r < 8; ++r)
      records[r] = reinterpret_cast<const eight_of<Number>*>(sums)[std::min(row + r, count - 1)];
    transpose(records, columns);
    for (std::size_t c = 0; c < ForceSums::sum_size; ++c) number[c].store_eight(row, columns[c]);
  }
}

/// Calls pass(count), with a count that the compiler knows for a whole slab, as most are.
template <class Pass>
WEDGE_INLINE void with_known_count(Index count, Pass&& pass) {
  if (count == slab_size)
    pass(slab_size);
  else
    pass(count);
}

}  // namespace

void GrainColumns::write(SeenTable& seen, Index first, Index count) const {
  const auto in_width = [&](auto* to) {
    with_known_count(
        count, [&](Index rows) __attribute__((always_inline)) { write_in(number, to, rows); });
  };
  if (seen.precision() == Precision::mixed)
    in_width(seen.data<float>() + first);
  else
    in_width(seen.data<double>() + first);
}

void GrainColumns::read(const ForceSums& sums, Index first, Index count) {
  const auto in_width = [&](const auto* from) {
    with_known_count(
        count, [&](Index rows) __attribute__((always_inline)) { read_in(number, from, rows); });
  };
  if (sums.narrow())
    in_width(sums.sum<float>(first));
  else
    in_width(sums.sum<double>(first));
}

}  // namespace wedge

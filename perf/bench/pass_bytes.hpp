// pass_bytes.hpp: how many bytes a pass must move between memory and processor, counted from the arrays it walks.
//
// Rule: what a pass reads counts once, what it writes counts once (a line that is fetched in order to be
// overwritten does not count twice); what is read again within a tile or a block comes from a cache and does not
// count again.
#pragma once

#include "core/state.hpp"
#include "kernels/laws/friction.hpp"
#include "kernels/passes/force_sums.hpp"
#include "kernels/passes/move.hpp"

namespace wedge {

inline constexpr double number_bytes = sizeof(double), vector_bytes = 3 * number_bytes, index_bytes = sizeof(Index);
static_assert(sizeof(Index) == sizeof(std::int32_t), "indices and other whole numbers count alike");

/// Bytes of what is seen of a grain, and of a sum, in the precision of the state.
inline double seen_bytes(const State& state) {
  return state.particles.seen.precision() == Precision::mixed ? sizeof(SeenOf<float>) : sizeof(Seen);
}
inline double sum_bytes(const State& state) {
  const bool mixed = state.particles.seen.precision() == Precision::mixed;
  return ForceSums::sum_size * (mixed ? sizeof(float) : sizeof(double));
}

/// Arithmetic of a row of the default law with rolling friction and energy budget, grains alike: counted in the
/// source (evaluate_contacts.hpp, history.hpp, mindlin_deresiewicz.hpp), comparisons and signs left out. Without
/// the terms of other laws and options.
struct RowArithmetic {
  static constexpr double operations = 111 + 47 + 60;  // approach, law, respond: additions, products, max, min
  static constexpr double roots = 1 + 5 + 0, divisions = 2 + 2 + 0;
};

/// Rows: both grains, the target; displacement read and written where there is friction. Grains and guests of
/// tiles: what is seen of them, and their sum written.
inline double contact_bytes(const State& state, const ReactionMap& map, Friction friction) {
  const double row = 3 * index_bytes + (friction == Friction::none ? 0 : 2 * vector_bytes);
  const double sums = static_cast<double>(map.sums());
  return state.contacts.rows() * row + sums * (seen_bytes(state) + sum_bytes(state));
}

/// Guests: number, turn, sum. Their receivers: number, begin, sum read and written.
inline double fold_bytes(const State& state, const ReactionMap& map) {
  return static_cast<double>(map.source.size()) * (2 * index_bytes + sum_bytes(state)) +
         static_cast<double>(map.receiver.size()) * (2 * index_bytes + 2 * sum_bytes(state));
}

/// Rows: feature; touching, displacement, normal read and written; force, torque, overlap written. Grains near
/// walls: number, begin, material, what is seen of them, sum read and written.
inline double wall_bytes(const State& state) {
  const WallContactTable& w = state.wall_contacts;
  const double row = 3 * index_bytes + 4 * vector_bytes + 2 * vector_bytes + number_bytes;
  const double grain = 3 * index_bytes + seen_bytes(state) + 2 * sum_bytes(state);
  return w.rows() * row + static_cast<double>(w.grain.size()) * grain;
}

/// With rolling friction. Velocities are read and written. First half: position read and written, reference and
/// margin read, what is seen written. Forces (force, torque, cap) of a first half are read, of a second written,
/// from sums that are read; between the two they stay in registers. Grains of two kinds: radius, mass; material
/// where it is shown.
inline double move_bytes(const State& state, Halves halves) {
  const double forces = 2 * vector_bytes + number_bytes;
  double grain = 4 * vector_bytes;
  if (halves != Halves::second) grain += 3 * vector_bytes + number_bytes + seen_bytes(state);
  if (halves != Halves::first) grain += sum_bytes(state);
  if (halves != Halves::second_and_first) grain += forces;
  if (!state.alike) grain += 2 * number_bytes + (halves != Halves::second ? index_bytes : 0);
  return state.particles.count() * grain;
}

/// Images: owner, turn; what is seen read and written, position written.
inline double image_bytes(const State& state) {
  return state.images.count() * (2 * index_bytes + 2 * seen_bytes(state) + vector_bytes);
}

}  // namespace wedge

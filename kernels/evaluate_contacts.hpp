// evaluate_contacts.hpp: the contact pass: every row of the contact table computes its force and moves its history
// on; a tile of grains at a time adds the forces up.
#pragma once

#include "core/parallel.hpp"
#include "core/state.hpp"
#include "kernels/contact_law.hpp"
#include "kernels/friction.hpp"
#include "kernels/history.hpp"
#include "kernels/pair_mix.hpp"
#include "kernels/rolling.hpp"
#include "kernels/slab.hpp"

namespace wedge {

/// Energies lost in one force step [J]; see EnergyLedger.
struct ContactLosses {
  double normal_damping = 0, tangential_damping = 0, sliding = 0, tangential_work = 0;
  double rolling = 0;  // of the couples in contacts; the limiter books its own
};
inline ContactLosses operator+(const ContactLosses& a, const ContactLosses& b) {
  return {a.normal_damping + b.normal_damping, a.tangential_damping + b.tangential_damping, a.sliding + b.sliding,
          a.tangential_work + b.tangential_work, a.rolling + b.rolling};
}

inline void book(const ContactLosses& losses, EnergyLedger& energy) {
  energy.normal_damping += losses.normal_damping;
  energy.tangential_damping += losses.tangential_damping;
  energy.sliding += losses.sliding;
  energy.tangential_work += losses.tangential_work;
  energy.rolling += losses.rolling;
}

/// The losses of a tile, lane by lane.
struct PackLosses {
  Pack normal_damping = 0, tangential_damping = 0, sliding = 0, tangential_work = 0, rolling = 0;
  ContactLosses sum() const {
    return {simd::reduce(normal_damping), simd::reduce(tangential_damping), simd::reduce(sliding),
            simd::reduce(tangential_work), simd::reduce(rolling)};
  }
};

/// The stored vectors of a slab of rows, three numbers a row: in the contact table, or in columns for the rows at
/// the end of a tile, which do not fill a slab.
struct StoredVectors {
  double *x = nullptr, *y = nullptr, *z = nullptr;
  WEDGE_INLINE PackVec3 load(Index row) const {
    return {wedge::load(x + row), wedge::load(y + row), wedge::load(z + row)};
  }
  WEDGE_INLINE void store(Index row, const PackVec3& v) const {
    wedge::store(x + row, v.x);
    wedge::store(y + row, v.y);
    wedge::store(z + row, v.z);
  }
};
struct StoredSlab {
  StoredVectors history, normal, couple, rolling_moment;
};

/// What the law sees of the rows of a slab.
struct ContactSlab {
  Column overlap, approach;
  VectorColumns normal, tangential_velocity, displacement;
};

/// Constants of a force step.
struct ForceStep {
  double dt;               // s, since the last force step
  double rolling_damping;  // of critical, of rolling springs
};

/// Geometry of each row, and transport of its history.
/// The displacement grows by the trapezoidal rule from first touch on: what is stored between steps is
/// delta + (dt/2) v_t, so that the next half step needs no old velocity (kernels/README.md, "Stored displacement").
template <Friction friction, class Mix>
inline void approach(const Mix& mix, const ForceStep& step, const SeenSlab& of, const StoredSlab& stored,
                     Index rows, ContactSlab& to) {
  using std::max, std::sqrt;
  for (Index row = 0; row < rows; row += pack_size) {
    const auto pairs = mix.pairs(of, row);
    const PackVec3 d = -of.apart.load(row);
    const Pack distance = sqrt(dot(d, d));
    const PackVec3 n = (1 / distance) * d;
    const Pack overlap = max(Pack(0.0), pairs.radius_first + pairs.radius_second - distance);
    PackVec3 v = of.speed.load(row);
    to.overlap.store(row, overlap);
    to.normal.store(row, n);
    if constexpr (friction == Friction::none) {
      to.approach.store(row, dot(v, n));
    } else {
      // lever_i w_i + lever_j w_j with the levers radius - overlap/2, which together are the distance of a contact
      const PackVec3 spins = of.spins.load(row);
      v += 0.5 * cross(spins, d);
      if constexpr (!Mix::alike)
        v += (0.5 * (pairs.radius_first - pairs.radius_second)) * cross(of.spin_difference.load(row), n);
      const Pack approach = dot(v, n);
      const PackVec3 tangential = v - approach * n, before = stored.history.load(row);
      const PackVec3 followed = follow_normal(before, stored.normal.load(row), n);
      to.approach.store(row, approach);
      to.tangential_velocity.store(row, tangential);
      to.displacement.store(row, spin_about_normal(followed, n, 0.25 * step.dt * dot(spins, n)) +
                                     slip_time(before, overlap, approach, step.dt) * tangential);
    }
  }
}

/// Rolling couples of a pack of rows, whose normals are still those of the last step. `losses` grow by the work
/// done against them. Pre: grains are not taken as alike (Mix::alike is false).
template <Friction friction, class Pairs>
WEDGE_INLINE PackVec3 couples(const Pairs& pairs, const ForceStep& step, const SeenSlab& of,
                              const StoredSlab& stored, const Column& most_contacts, Index row, const PackVec3& n,
                              const ContactResponseOf<Pack>& response, const Pack& overlap, Pack& loss) {
  using std::abs;
  const Pack on = select(overlap > 0, Pack(1.0), Pack(0.0));
  RollingInputOf<Pack> in{
      of.spin_difference.load(row),     n,         abs(response.normal), response.elastic_normal / (overlap + tiny),
      Pack(pairs.coefficients.rolling), Pack(0.0), step.rolling_damping};
  const Pack mass_first = of.mass_first.load(row), mass_second = of.mass_second.load(row);
  PackVec3 couple;
  if constexpr (friction == Friction::relative) {
    const Pack first = sphere_inertia(mass_first, pairs.radius_first),
               second = sphere_inertia(mass_second, pairs.radius_second);
    in.inertia = first * second / (first + second) / most_contacts.load(row);
    couple = on * relative_couple(in, step.dt);
  } else {
    in.inertia = 1 / (1 / rocking_inertia(mass_first, pairs.radius_first) +
                      1 / rocking_inertia(mass_second, pairs.radius_second));
    const PackVec3 followed = follow_normal(stored.rolling_moment.load(row), stored.normal.load(row), n);
    const PackVec3 moment = spin_about_normal(followed, n, 0.25 * step.dt * dot(of.spins.load(row), n));
    const RollingSpringOf<Pack> spring = rolling_spring(in, moment, step.dt);
    couple = on * spring.couple;
    stored.rolling_moment.store(row, on * spring.moment);
  }
  stored.couple.store(row, couple);
  loss -= step.dt * dot(couple, in.spin);
  return couple;
}

/// Law, forces and torques of each row.
template <class Law, Friction friction, bool with_budget, class Mix>
inline void respond(const Mix& mix, const ForceStep& step, const SeenSlab& of, const ContactSlab& contacts,
                    const StoredSlab& stored, const Column& most_contacts, Index rows, OutcomeSlab& out,
                    PackLosses& total) {
  using std::abs;
  PackLosses losses = total;
  for (Index row = 0; row < rows; row += pack_size) {
    const auto pairs = mix.pairs(of, row);
    ContactInputOf<Pack> in{contacts.overlap.load(row),
                            pairs.effective_radius,
                            pairs.effective_mass,
                            contacts.approach.load(row),
                            {},
                            {}};
    const PackVec3 n = contacts.normal.load(row);
    if constexpr (friction != Friction::none) {
      in.tangential_velocity = contacts.tangential_velocity.load(row);
      in.displacement = contacts.displacement.load(row);
    }
    const ContactResponseOf<Pack> response = Law::respond(pairs.coefficients, in);
    const Pack on = select(in.overlap > 0, Pack(1.0), Pack(0.0));
    PackVec3 force = -(on * response.normal) * n;
    if constexpr (with_budget)
      losses.normal_damping += (on * step.dt) * (response.normal - response.elastic_normal) * in.approach_velocity;
    if constexpr (friction != Friction::none) {
      const PackVec3 tangential = on * response.tangential, turning = cross(n, tangential);
      force += tangential;
      PackVec3 torque = (pairs.radius_first - 0.5 * in.overlap) * turning;
      if constexpr (!Mix::alike) {
        PackVec3 second = (pairs.radius_second - 0.5 * in.overlap) * turning;
        if constexpr (has_couples(friction)) {
          const PackVec3 couple = couples<friction>(pairs, step, of, stored, most_contacts, row, n, response,
                                                    in.overlap, losses.rolling);
          torque += couple;
          second -= couple;
        }
        out.second_torque.store(row, second);
      }
      out.column[3].store(row, torque.x);
      out.column[4].store(row, torque.y);
      out.column[5].store(row, torque.z);
      stored.history.store(row, on * (response.displacement + (0.5 * step.dt) * in.tangential_velocity));
      stored.normal.store(row, n);
      if constexpr (with_budget) {
        losses.tangential_work -= (on * step.dt) * dot(response.elastic_tangential, in.tangential_velocity);
        losses.tangential_damping +=
            (on * step.dt) * dot(response.elastic_tangential - response.tangential, in.tangential_velocity);
        losses.sliding += on * response.sliding_loss;
      }
    }
    out.column[0].store(row, force.x);
    out.column[1].store(row, force.y);
    out.column[2].store(row, force.z);
    if constexpr (friction == Friction::rolling)
      out.column[6].store(row, on * pairs.coefficients.rolling * abs(response.normal));
  }
  total = losses;
}

/// The rows at the end of a tile that do not fill a slab: their stored vectors wait here, so that the packs of the
/// next tile are left alone. What stands in the lanes beyond them goes nowhere.
template <bool with_couples>
class PartSlab {
public:
  PartSlab(ContactTable& c, std::size_t from, std::size_t rows) : c_(c), from_(from), rows_(rows) {
    fill(history_, c.history);
    fill(normal_, c.normal);
    if constexpr (with_couples) fill(couple_, c.couple), fill(rolling_moment_, c.rolling_moment);
  }
  PartSlab(const PartSlab&) = delete;
  PartSlab& operator=(const PartSlab&) = delete;
  ~PartSlab() {
    write_back(history_, c_.history);
    write_back(normal_, c_.normal);
    if constexpr (with_couples) write_back(couple_, c_.couple), write_back(rolling_moment_, c_.rolling_moment);
  }
  StoredSlab stored() { return {vectors(history_), vectors(normal_), vectors(couple_), vectors(rolling_moment_)}; }

private:
  static StoredVectors vectors(VectorColumns& v) { return {v.x.number, v.y.number, v.z.number}; }
  void fill(VectorColumns& to, const Vec3Array& from) const {
    for (std::size_t k = 0; k < static_cast<std::size_t>(slab_size); ++k) {
      const Vec3 v = from.get(from_ + std::min(k, rows_ - 1));
      to.x.number[k] = v.x;
      to.y.number[k] = v.y;
      to.z.number[k] = v.z;
    }
  }
  void write_back(const VectorColumns& from, Vec3Array& to) const {
    for (std::size_t k = 0; k < rows_; ++k)
      to.set(from_ + k, {from.x.number[k], from.y.number[k], from.z.number[k]});
  }
  ContactTable& c_;
  std::size_t from_, rows_;
  VectorColumns history_, normal_, couple_, rolling_moment_;
};

/// One tile: its rows, slab by slab. Rows are numbered from `begin` to `end`.
template <class Law, Friction friction, bool with_budget, class Mix>
class TilePass {
public:
  TilePass(const Mix& mix, const ForceStep& step, State& state, Reactions& reactions)
      : mix_(mix), step_(step), p_(state.particles), c_(state.contacts), reactions_(reactions) {}

  ContactLosses evaluate(Index begin, Index end) {
    for (Index from = begin; from < end; from += slab_size) {
      const Index rows = std::min(slab_size, end - from);
      if (rows == slab_size) {
        evaluate_slab(
            from, rows,
            {at(c_.history, from), at(c_.normal, from), at(c_.couple, from), at(c_.rolling_moment, from)});
      } else {
        PartSlab<has_couples(friction)> part(c_, static_cast<std::size_t>(from), static_cast<std::size_t>(rows));
        evaluate_slab(from, rows, part.stored());
      }
    }
    return losses_.sum();
  }

private:
  static constexpr Index fetched_ahead = 96;  // rows

  static StoredVectors at(Vec3Array& v, Index row) {
    if (v.size() == 0) return {};
    return {v.x.data() + row, v.y.data() + row, v.z.data() + row};
  }

  void evaluate_slab(Index from, Index rows, const StoredSlab& stored) {
    constexpr bool spinning = friction != Friction::none;
    const Index *first = c_.first.data() + from, *second = c_.second.data() + from;
    const Index soon = std::min(from + fetched_ahead, c_.rows() - rows);
    collect<Mix::alike, spinning>(p_.seen.data(), {first, second, c_.second.data() + soon, rows}, seen_);
    for (Index row = rows; row < (rows + 7) / 8 * 8; ++row) part_two_grains(row);
    if constexpr (friction == Friction::relative)
      for (Index row = 0; row < slab_size; ++row)
        most_contacts_.number[row] =
            row < rows ? std::max(contact_count(first[row]), contact_count(second[row])) : 1;
    approach<friction>(mix_, step_, seen_, stored, rows, contacts_);
    respond<Law, friction, with_budget>(mix_, step_, seen_, contacts_, stored, most_contacts_, rows, outcome_,
                                        losses_);
    add_to_sums<Mix::alike>(outcome_, first, reactions_.target.data() + from, rows, reactions_.sums.data());
  }
  /// Lanes without a row hold grains that do not touch, so that they add to no sum.
  void part_two_grains(Index row) { seen_.apart.x.number[row] = 1e9; }
  double contact_count(Index slot) const { return c_.contact_count[static_cast<std::size_t>(slot)]; }

  const Mix& mix_;
  const ForceStep step_;
  const Particles& p_;
  ContactTable& c_;
  Reactions& reactions_;
  PackLosses losses_;
  SeenSlab seen_;
  ContactSlab contacts_;
  OutcomeSlab outcome_{};
  Column most_contacts_{};
};

/// Pre: images are fresh, what contacts see is predicted to the time of the positions, `reactions` fits the list;
/// dt [s] is the time since the last force step (0: forces at the start, no history grows). Post: each row's
/// history and normal are those of now; the sums of grains and guests hold what the rows of each tile do to them.
template <class Law, Friction friction, bool with_budget, class Mix>
void evaluate_contacts(const Mix& mix, State& state, Reactions& reactions, double dt, double rolling_damping) {
  const ContactTable& c = state.contacts;
  const Index n = state.particles.count();
  const ContactLosses sum = reduce_each_block(
      tile_count(n), ContactLosses{},
      [&](Index tile) {
        const Index begin = tile * tile_size, end = std::min(n, begin + tile_size);
        const auto clear = [&](Index from, Index to) { std::fill(reactions.sum(from), reactions.sum(to), 0.0); };
        clear(begin, end);
        clear(reactions.guests_begin[static_cast<std::size_t>(tile)],
              reactions.guests_begin[static_cast<std::size_t>(tile) + 1]);
        TilePass<Law, friction, with_budget, Mix> pass(mix, {dt, rolling_damping}, state, reactions);
        return pass.evaluate(c.row_begin[static_cast<std::size_t>(begin)],
                             c.row_begin[static_cast<std::size_t>(end)]);
      },
      [](const ContactLosses& a, const ContactLosses& b) { return a + b; });
  state.history_ahead = 0.5 * dt;
  book(sum, state.energy);
}

}  // namespace wedge

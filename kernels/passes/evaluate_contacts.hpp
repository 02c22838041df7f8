// evaluate_contacts.hpp: the contact pass: every row of the contact table computes its force and moves its history
// on; a tile of grains at a time adds the forces up.
#pragma once

#include "core/parallel.hpp"
#include "core/state.hpp"
#include "kernels/laws/contact_law.hpp"
#include "kernels/laws/history.hpp"
#include "kernels/laws/rolling.hpp"
#include "kernels/passes/contact_geometry.hpp"
#include "kernels/passes/pair_mix.hpp"

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

/// The losses of a tile, lane by lane: some hundred terms a lane, so that floats lose a millionth of them at most.
template <class Number>
struct PackLosses {
  PackOf<Number> normal_damping = 0, tangential_damping = 0, sliding = 0, tangential_work = 0, rolling = 0;
  ContactLosses sum() const {
    return {simd::reduce(normal_damping), simd::reduce(tangential_damping), simd::reduce(sliding),
            simd::reduce(tangential_work), simd::reduce(rolling)};
  }
};

/// Rolling couples of a pack of rows. `loss` grows by the work done against them. Pre: grains are not taken as
/// alike (Mix::alike is false).
template <Friction friction, class Pairs, class Number, class Real = PackOf<Number>>
WEDGE_INLINE Vector3<Real> couples(const Pairs& pairs, const ForceStep<Number>& step, const SeenSlab<Number>& of,
                                   const ContactSlab<Number>& contacts, const StoredSlab& stored,
                                   const ColumnOf<Number>& most_contacts, Index row,
                                   const ContactResponseOf<Real>& response, Real& loss) {
  using std::abs;
  const Vector3<Real> n = contacts.normal.load(row);
  const Real overlap = contacts.overlap.load(row), on = select(overlap > 0, Real(1), Real(0));
  RollingInputOf<Real> in{of.spin_difference.load(row),
                          n,
                          abs(response.normal),
                          response.elastic_normal / (overlap + tiny<Real>),
                          Real(pairs.coefficients.rolling),
                          Real(0),
                          step.rolling_damping};
  const Real mass_first = of.mass_first.load(row), mass_second = of.mass_second.load(row);
  Vector3<Real> couple;
  if constexpr (friction == Friction::relative) {
    // by inverses: the product of two inertias of powder is too small for a float
    in.inertia = 1 / ((1 / sphere_inertia(mass_first, pairs.radius_first) +
                       1 / sphere_inertia(mass_second, pairs.radius_second)) *
                      most_contacts.load(row));
    couple = on * relative_couple(in, step.dt);
  } else {
    in.inertia = 1 / (1 / rocking_inertia(mass_first, pairs.radius_first) +
                      1 / rocking_inertia(mass_second, pairs.radius_second));
    const Vector3<Real> followed =
        follow_turning_normal(stored.rolling_moment.load<Real>(row), contacts.back.load(row), n);
    const Vector3<Real> moment = turn_with_spins(followed, n, of.spins.load(row), step.dt);
    const RollingSpringOf<Real> spring = rolling_spring(in, moment, step.dt);
    couple = on * spring.couple;
    stored.rolling_moment.store(row, on * spring.moment);
  }
  stored.couple.store(row, couple);
  loss -= step.dt * dot(couple, in.spin);
  return couple;
}

/// Law, forces and torques of each row.
template <class Law, Friction friction, bool with_budget, class Mix, class Number = typename Mix::Number>
inline void respond(const Mix& mix, const ForceStep<Number>& step, const SeenSlab<Number>& of,
                    const ContactSlab<Number>& contacts, const StoredSlab& stored,
                    const ColumnOf<Number>& most_contacts, Index rows, OutcomeSlab<Number>& out,
                    PackLosses<Number>& total) {
  using std::abs;
  using Real = PackOf<Number>;
  using Vector = Vector3<Real>;
  constexpr Number half = 1 / Number(2);
  PackLosses<Number> losses = total;
  for (Index row = 0; row < rows; row += lanes<Number>) {
    const auto pairs = mix.pairs(of, row);
    ContactInputOf<Real> in{contacts.overlap.load(row),
                            pairs.effective_radius,
                            pairs.effective_mass,
                            contacts.approach.load(row),
                            {},
                            {}};
    const Vector n = contacts.normal.load(row);
    if constexpr (friction != Friction::none) {
      in.tangential_velocity = contacts.tangential_velocity.load(row);
      in.displacement = contacts.displacement.load(row);
    }
    const ContactResponseOf<Real> response = Law::respond(pairs.coefficients, in);
    const Real on = select(in.overlap > 0, Real(1), Real(0));
    Vector force = -(on * response.normal) * n;
    if constexpr (with_budget)
      losses.normal_damping += (on * step.dt) * (response.normal - response.elastic_normal) * in.approach_velocity;
    if constexpr (friction != Friction::none) {
      const Vector tangential = on * response.tangential, turning = cross(n, tangential);
      force += tangential;
      Vector torque = (pairs.radius_first - half * in.overlap) * turning;
      if constexpr (!Mix::alike) {
        Vector second = (pairs.radius_second - half * in.overlap) * turning;
        if constexpr (has_couples(friction)) {
          const Vector couple =
              couples<friction>(pairs, step, of, contacts, stored, most_contacts, row, response, losses.rolling);
          torque += couple;
          second -= couple;
        }
        out.second_torque.store(row, second);
      }
      out.column[3].store(row, torque.x);
      out.column[4].store(row, torque.y);
      out.column[5].store(row, torque.z);
      stored.history.store(row, on * (response.displacement + (half * step.dt) * in.tangential_velocity));
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
    if constexpr (with_couples) fill(couple_, c.couple), fill(rolling_moment_, c.rolling_moment);
  }
  PartSlab(const PartSlab&) = delete;
  PartSlab& operator=(const PartSlab&) = delete;
  ~PartSlab() {
    write_back(history_, c_.history);
    if constexpr (with_couples) write_back(couple_, c_.couple), write_back(rolling_moment_, c_.rolling_moment);
  }
  StoredSlab stored() { return {vectors(history_), vectors(couple_), vectors(rolling_moment_)}; }

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
  VectorColumns history_, couple_, rolling_moment_;
};

/// One tile: its rows, slab by slab. Rows are numbered from `begin` to `end`.
template <class Law, Friction friction, bool with_budget, class Mix>
class TilePass {
public:
  using Number = typename Mix::Number;
  TilePass(const Mix& mix, const ForceStep<Number>& step, State& state, const ReactionMap& map, ForceSums& sums)
      : mix_(mix),
        step_(step),
        grains_(state.particles.seen.template data<Number>()),
        c_(state.contacts),
        map_(map),
        sums_(sums) {}

  ContactLosses evaluate(Index begin, Index end) {
    for (Index from = begin; from < end; from += slab_size) {
      const Index rows = std::min(slab_size, end - from);
      if (rows == slab_size) {
        evaluate_slab(from, rows, {at(c_.history, from), at(c_.couple, from), at(c_.rolling_moment, from)});
      } else {
        PartSlab<has_couples(friction)> part(c_, static_cast<std::size_t>(from), static_cast<std::size_t>(rows));
        evaluate_slab(from, rows, part.stored());
      }
    }
    return losses_.sum();
  }

private:
  static constexpr Index fetched_ahead = 96, histories_ahead = 320;  // rows, as measured (perf/README.md)

  static StoredVectors at(Vec3Array& v, Index row) {
    if (v.size() == 0) return {};
    return {v.x.data() + row, v.y.data() + row, v.z.data() + row};
  }

  void evaluate_slab(Index from, Index rows, const StoredSlab& stored) {
    constexpr bool spinning = friction != Friction::none;
    const Index *first = c_.first.data() + from, *second = c_.second.data() + from;
    if constexpr (spinning) fetch(c_.history, from + histories_ahead);
    const Index soon = std::min(from + fetched_ahead, c_.rows() - rows);
    collect<Mix::alike, spinning>(grains_, {first, second, c_.second.data() + soon, rows}, seen_);
    for (Index row = rows; row < filled<Number>(rows); ++row) part_two_grains(row);
    if constexpr (friction == Friction::relative)
      for (Index row = 0; row < slab_size; ++row)
        most_contacts_.number[row] =
            static_cast<Number>(row < rows ? std::max(contact_count(first[row]), contact_count(second[row])) : 1);
    approach<friction, Mix::alike>(mix_.common_radius(), step_, seen_, stored, rows, contacts_);
    respond<Law, friction, with_budget>(mix_, step_, seen_, contacts_, stored, most_contacts_, rows, outcome_,
                                        losses_);
    add_to_sums<Mix::alike>(outcome_, first, map_.target.data() + from, rows, sums_.template sum<Number>(0));
  }
  /// Asks for the histories of rows that come soon: there are more arrays than the processor follows by itself.
  static void fetch(const Vec3Array& stored, Index from) {
    const auto end = std::min(static_cast<std::size_t>(from + slab_size), stored.size());
    for (auto row = static_cast<std::size_t>(from); row < end; row += cache_line / sizeof(double))
      for (const Array<double>* component : {&stored.x, &stored.y, &stored.z})
        __builtin_prefetch(component->data() + row, 1);
  }
  /// Lanes without a row hold grains that do not touch, so that they add nothing to the losses.
  void part_two_grains(Index row) {
    constexpr Number far_apart = 1e9;  // m
    seen_.apart.x.number[row] = far_apart;
    if constexpr (std::is_same_v<Number, float>) seen_.closeness.number[row] = -1;
  }
  Index contact_count(Index slot) const { return c_.contact_count[static_cast<std::size_t>(slot)]; }

  const Mix& mix_;
  const ForceStep<Number> step_;
  const SeenOf<Number>* const grains_;
  ContactTable& c_;
  const ReactionMap& map_;
  ForceSums& sums_;
  PackLosses<Number> losses_;
  SeenSlab<Number> seen_;
  ContactSlab<Number> contacts_;
  OutcomeSlab<Number> outcome_{};
  ColumnOf<Number> most_contacts_{};
};

/// Pre: images are fresh, what contacts see is predicted to the time of the positions, `map` fits the list;
/// dt [s] is the time since the last force step (0: forces at the start, no history grows). Post: each row's
/// history is that of now; the sums of grains and guests hold what the rows of each tile do to them.
template <class Law, Friction friction, bool with_budget, class Mix>
void evaluate_contacts(const Mix& mix, State& state, const ReactionMap& map, ForceSums& sums, double dt,
                       double rolling_damping) {
  using Number = typename Mix::Number;
  const ContactTable& c = state.contacts;
  const Index n = state.particles.count();
  const ForceStep<Number> step{static_cast<Number>(dt), static_cast<Number>(rolling_damping)};
  sums.fit(map.sums(), state.particles.seen.precision());
  const ContactLosses sum = reduce_each_block(
      tile_count(n), ContactLosses{},
      [&](Index tile) {
        const Index begin = tile * tile_size, end = std::min(n, begin + tile_size);
        const auto clear = [&](Index from, Index to) {
          std::fill(sums.sum<Number>(from), sums.sum<Number>(to), Number(0));
        };
        clear(begin, end);
        clear(map.guests_begin[static_cast<std::size_t>(tile)],
              map.guests_begin[static_cast<std::size_t>(tile) + 1]);
        TilePass<Law, friction, with_budget, Mix> pass(mix, step, state, map, sums);
        return pass.evaluate(c.row_begin[static_cast<std::size_t>(begin)],
                             c.row_begin[static_cast<std::size_t>(end)]);
      },
      [](const ContactLosses& a, const ContactLosses& b) { return a + b; });
  state.history_ahead = 0.5 * dt;
  book(sum, state.energy);
}

}  // namespace wedge

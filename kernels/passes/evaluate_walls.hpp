// evaluate_walls.hpp: the wall pass: each grain near a wall meets the features near it and adds their forces to its
// own.
#pragma once

#include <vector>

#include "core/parallel.hpp"
#include "core/state.hpp"
#include "kernels/laws/contact_law.hpp"
#include "kernels/laws/history.hpp"
#include "kernels/passes/contact_kinematics.hpp"
#include "kernels/passes/evaluate_contacts.hpp"
#include "kernels/passes/meet_walls.hpp"

namespace wedge {

/// Coefficients of each material of grains with each wall.
template <class Law>
class WallMix {
public:
  using Coefficients = typename Law::Coefficients;
  WallMix(const PairTable<Coefficients>& table, const Vessel& vessel) : walls_(vessel.wall_count()) {
    for (int material = 0; material < table.kinds(); ++material) {
      for (int wall = 0; wall < walls_; ++wall) {
        coefficients_.push_back(table(material, vessel.wall(wall).material));
        if (vessel.frictionless(wall)) Law::remove_friction(coefficients_.back());
      }
    }
  }
  Index slot(int material, int wall) const { return material * walls_ + wall; }
  const Coefficients& operator[](Index slot) const { return coefficients_[static_cast<std::size_t>(slot)]; }

private:
  int walls_;
  std::vector<Coefficients> coefficients_;
};

struct WallLosses {
  ContactLosses contact;
  double wall_work = 0;  // J, done by moving walls on the grains
  Index crossed = -1;    // a grain whose centre went through a wall
};
inline WallLosses operator+(const WallLosses& a, const WallLosses& b) {
  return {a.contact + b.contact, a.wall_work + b.wall_work, std::max(a.crossed, b.crossed)};
}

/// Contacts with walls, a slab at a time: what comes from their rows and grains, and what goes back.
struct WallSlab {
  Index count = 0;
  Index row[slab_size], grain[slab_size], coefficients[slab_size];
  Column overlap, radius, mass, wall_spin, wall_speed, contacts;
  VectorColumns place, velocity, spin, normal, before, history, rolling_moment;
  VectorColumns force, torque;
  Column rolling_cap;
};

/// Blocks of the wall contact table. The walls' work is done in doubles, whatever the width of what is seen of
/// grains and of their sums.
template <class Law, Friction friction>
class WallPass {
public:
  WallPass(const WallMix<Law>& mix, State& state, ForceSums& sums, const ForceStep<double>& step)
      : mix_(mix), state_(state), sums_(sums), c_(state.wall_contacts), step_(step) {}

  /// Entries [begin, end) of the table's list of grains.
  WallLosses evaluate(Index begin, Index end) {
    for (Index g = begin; g < end; ++g) {
      const auto s = static_cast<std::size_t>(g);
      const auto first = static_cast<std::size_t>(c_.begin[s]);
      meet_walls(state_, c_.grain[s], c_.begin[s], c_.begin[s + 1], has_couples(friction), met_);
      for (std::size_t m = 0; m < met_.size(); ++m) take_in(c_.grain[s], first + m, met_[m]);
    }
    if (slab_.count > 0) respond();
    return {losses_.sum(), simd::reduce(wall_work_), crossed_};
  }

private:
  using PackCoefficients = typename Law::template CoefficientsOf<Pack>;

  static void put(VectorColumns& to, Index row, const Vec3& v) {
    to.x.number[row] = v.x;
    to.y.number[row] = v.y;
    to.z.number[row] = v.z;
  }
  static Vec3 get(const VectorColumns& from, Index row) {
    return {from.x.number[row], from.y.number[row], from.z.number[row]};
  }

  /// Row k of grain i becomes part of the slab if it touches.
  void take_in(Index i, std::size_t k, const WallMeeting& met) {
    const Vec3 n = met.normal, before = c_.normal.get(k);
    c_.normal.set(k, n);
    const bool touches = met.touch == Touch::held || met.touch == Touch::fresh;
    const WallFeature& feature = state_.vessel.feature(c_.feature[k]);
    if (met.touch == Touch::held && dot(n, before) < 0 && feature.kind != WallFeature::Kind::edge) crossed_ = i;
    c_.touching[k] = touches ? 1 : 0;
    if (!touches) {
      c_.history.set(k, {});
      c_.force.set(k, {});
      c_.torque.set(k, {});
      if constexpr (has_couples(friction)) c_.rolling_moment.set(k, {});
      return;
    }
    const int wall = state_.vessel.carrier(c_.feature[k]);
    const Seen seen = state_.particles.seen.get(static_cast<std::size_t>(i));
    const Index m = slab_.count++;
    slab_.row[m] = static_cast<Index>(k);
    slab_.grain[m] = i;
    slab_.coefficients[m] = mix_.slot(state_.particles.material[static_cast<std::size_t>(i)], wall);
    slab_.overlap.number[m] = c_.overlap[k];
    slab_.radius.number[m] = seen.radius;
    slab_.mass.number[m] = seen.mass;
    slab_.wall_spin.number[m] = state_.vessel.wall(wall).spin;
    slab_.wall_speed.number[m] = state_.vessel.wall(wall).speed;
    put(slab_.place, m, seen.position);
    put(slab_.velocity, m, seen.velocity);
    put(slab_.normal, m, n);
    if constexpr (friction != Friction::none) {
      put(slab_.spin, m, seen.angular_velocity);
      put(slab_.before, m, before);
      put(slab_.history, m, c_.history.get(k));
    }
    if constexpr (friction == Friction::relative)
      slab_.contacts.number[m] = state_.contacts.contact_count[static_cast<std::size_t>(i)];
    if constexpr (friction == Friction::spring) put(slab_.rolling_moment, m, c_.rolling_moment.get(k));
    if (slab_.count == slab_size) respond();
  }

  /// Computes the slab, gives its rows and grains what is theirs, and empties it.
  void respond() {
    for (Index m = slab_.count; m % 8 != 0; ++m) {  // lanes without a row hold a grain that does not touch
      for (Column* column : {&slab_.radius, &slab_.mass, &slab_.contacts}) column->number[m] = column->number[0];
      slab_.overlap.number[m] = 0;
      slab_.coefficients[m] = slab_.coefficients[0];
    }
    for (Index m = 0; m < slab_.count; m += pack_size) respond(m);
    if (sums_.narrow())
      give<float>();
    else
      give<double>();
    slab_.count = 0;
  }

  /// Gives the slab's rows and grains what is theirs. `Number` is the width of the sums.
  template <class Number>
  void give() {
    for (Index m = 0; m < slab_.count; ++m) {
      const auto k = static_cast<std::size_t>(slab_.row[m]);
      const Vec3 force = get(slab_.force, m);
      Number* const sum = sums_.template sum<Number>(slab_.grain[m]);
      const auto add = [&](int c, double felt) { sum[c] += static_cast<Number>(felt); };
      c_.force.set(k, force);
      add(0, force.x);
      add(1, force.y);
      add(2, force.z);
      if constexpr (friction == Friction::none) {
        c_.torque.set(k, {});
      } else {
        const Vec3 torque = get(slab_.torque, m);
        c_.torque.set(k, torque);
        add(3, torque.x);
        add(4, torque.y);
        add(5, torque.z);
        c_.history.set(k, get(slab_.history, m));
      }
      if constexpr (friction == Friction::rolling) add(6, slab_.rolling_cap.number[m]);
      if constexpr (friction == Friction::spring) c_.rolling_moment.set(k, get(slab_.rolling_moment, m));
    }
  }

  /// A pack of the slab. A wall has no inertia and no radius: m* and R* are those of the grain.
  void respond(Index m) {
    using std::abs;
    const auto coefficients = PackCoefficients::from([&](double Law::Coefficients::*member) {
      return Pack([&](auto lane) { return mix_[slab_.coefficients[m + static_cast<Index>(lane)]].*member; });
    });
    const Pack radius = slab_.radius.load(m), overlap = slab_.overlap.load(m), lever = radius - overlap;
    const Pack turning = slab_.wall_spin.load(m), on = select(overlap > 0, Pack(1.0), Pack(0.0));
    const PackVec3 n = slab_.normal.load(m), point = slab_.place.load(m) + lever * n;
    const PackVec3 wall_velocity{-turning * point.y, turning * point.x, slab_.wall_speed.load(m)};
    PackVec3 v = slab_.velocity.load(m) - wall_velocity, spin;
    if constexpr (friction != Friction::none) {
      spin = slab_.spin.load(m);
      v += lever * cross(spin, n);
    }
    const ContactVelocity<Pack> velocity = along_and_across(v, n);
    ContactInputOf<Pack> in{overlap, radius, slab_.mass.load(m), velocity.approach, {}, {}};
    const PackVec3 wall_spin{Pack(0.0), Pack(0.0), turning};
    if constexpr (friction != Friction::none) {
      in.tangential_velocity = velocity.tangential;
      const PackVec3 stored = slab_.history.load(m), followed = follow_normal(stored, slab_.before.load(m), n);
      in.displacement = turn_with_spins(followed, n, spin + wall_spin, step_.dt) +
                        slip_time(stored, overlap, in.approach_velocity, step_.dt) * in.tangential_velocity;
    }
    const ContactResponseOf<Pack> out = Law::respond(coefficients, in);
    PackVec3 force = -out.normal * n;
    const Pack span = on * step_.dt;
    losses_.normal_damping += span * (out.normal - out.elastic_normal) * in.approach_velocity;
    if constexpr (friction != Friction::none) {
      force += out.tangential;
      PackVec3 torque = lever * cross(n, out.tangential);
      slab_.history.store(m, out.displacement + (0.5 * step_.dt) * in.tangential_velocity);
      losses_.tangential_work -= span * dot(out.elastic_tangential, in.tangential_velocity);
      losses_.tangential_damping += span * dot(out.elastic_tangential - out.tangential, in.tangential_velocity);
      losses_.sliding += on * out.sliding_loss;
      if constexpr (friction == Friction::rolling)
        slab_.rolling_cap.store(m, coefficients.rolling * abs(out.normal));
      if constexpr (has_couples(friction)) {
        const PackVec3 felt = couple(m, coefficients.rolling, out, spin, wall_spin);
        torque += felt;
        losses_.rolling -= span * dot(felt, spin - wall_spin);
        wall_work_ += span * dot(felt, wall_spin);
      }
      slab_.torque.store(m, torque);
    }
    wall_work_ += span * dot(force, wall_velocity);
    slab_.force.store(m, force);
  }

  /// Rolling couple on the grains of a pack. The wall has no inertia to share.
  PackVec3 couple(Index m, const Pack& rolling, const ContactResponseOf<Pack>& response, const PackVec3& spin,
                  const PackVec3& wall_spin) {
    using std::abs;
    const PackVec3 n = slab_.normal.load(m);
    const Pack radius = slab_.radius.load(m), mass = slab_.mass.load(m);
    RollingInputOf<Pack> in{spin - wall_spin,
                            n,
                            abs(response.normal),
                            response.elastic_normal / (slab_.overlap.load(m) + tiny<Pack>),
                            rolling,
                            Pack(0.0),
                            step_.rolling_damping};
    if constexpr (friction == Friction::relative) {
      in.inertia = sphere_inertia(mass, radius) / slab_.contacts.load(m);
      return relative_couple(in, step_.dt);
    } else {
      in.inertia = rocking_inertia(mass, radius);
      const PackVec3 followed = follow_normal(slab_.rolling_moment.load(m), slab_.before.load(m), n);
      const PackVec3 moment = turn_with_spins(followed, n, spin + wall_spin, step_.dt);
      const RollingSpringOf<Pack> spring = rolling_spring(in, moment, step_.dt);
      slab_.rolling_moment.store(m, spring.moment);
      return spring.couple;
    }
  }

  const WallMix<Law>& mix_;
  State& state_;
  ForceSums& sums_;
  WallContactTable& c_;
  const ForceStep<double> step_;
  std::vector<WallMeeting> met_;  // the rows of the grain at hand
  WallSlab slab_{};
  PackLosses<double> losses_;
  Pack wall_work_ = 0;
  Index crossed_ = -1;
};

/// Pre: fold_reactions ran; dt as in evaluate_contacts.
/// Post: wall forces are in the table and added to the sums of the grains.
/// Throws PhysicsError when a grain's centre has gone through a wall.
template <class Law, Friction friction>
void evaluate_walls(const WallMix<Law>& mix, State& state, ForceSums& sums, double dt, double rolling_damping) {
  const WallLosses sum = reduce_blocks(
      static_cast<Index>(state.wall_contacts.grain.size()), WallLosses{},
      [&](Index begin, Index end) {
        return WallPass<Law, friction>(mix, state, sums, {dt, rolling_damping}).evaluate(begin, end);
      },
      [](const WallLosses& a, const WallLosses& b) { return a + b; });
  book(sum.contact, state.energy);
  state.energy.wall_work += sum.wall_work;
  if (sum.crossed >= 0) report_crossing(state, sum.crossed);
}

}  // namespace wedge

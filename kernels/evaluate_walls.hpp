// evaluate_walls.hpp: the wall pass: each grain near a wall meets the features near it and adds their forces to its
// own.
#pragma once

#include <sstream>

#include "core/parallel.hpp"
#include "core/require.hpp"
#include "core/state.hpp"
#include "kernels/contact_law.hpp"
#include "kernels/evaluate_contacts.hpp"
#include "kernels/history.hpp"

namespace wedge {

/// Coefficients of each pair of materials, and the material of each wall.
template <class Law>
struct WallMix {
  PairTable<typename Law::Coefficients> table;

  typename Law::Coefficients coefficients(int grain_material, const Vessel& vessel, int wall) const {
    auto c = table(grain_material, vessel.wall(wall).material);
    if (vessel.frictionless(wall)) Law::remove_friction(c);
    return c;
  }
};

struct WallLosses {
  ContactLosses contact;
  double wall_work = 0;  // J, done by moving walls on the grains
  Index crossed = -1;    // a grain whose centre went through a wall
};

/// Rows [begin, end) of the wall contact table as the grain in slot i meets them.
template <class Law, Friction friction>
class WallRows {
public:
  WallRows(const WallMix<Law>& mix, State& state, Reactions& reactions, const ForceStep& step)
      : mix_(mix), state_(state), reactions_(reactions), c_(state.wall_contacts), dt_(step.dt), rolling_damping_(step.rolling_damping) {}

  void evaluate(Index i, Index begin, Index end, WallLosses& losses) const {
    for (Index k = begin; k < end; ++k) meet(i, static_cast<std::size_t>(k));
    for (Index k = begin; k < end; ++k) take_over(static_cast<std::size_t>(k), begin, end);
    for (Index k = begin; k < end; ++k) respond(i, static_cast<std::size_t>(k), losses);
  }

private:
  enum Touch : std::int32_t { apart = 0, held = 1, fresh = 2, left = 3 };

  /// Is the feature touched now? The transported history waits in its row.
  void meet(Index i, std::size_t k) const {
    const Particles& p = state_.particles;
    const auto s = static_cast<std::size_t>(i);
    const WallProximity near = state_.vessel.proximity(c_.feature[k], p.position.get(s));
    const bool was = c_.touching[k] != 0;
    const bool is = near.minimum && near.distance < p.radius[s] && state_.vessel.active(c_.feature[k]);
    c_.touching[k] = was ? (is ? held : left) : (is ? fresh : apart);
    c_.overlap[k] = is ? p.radius[s] - near.distance : 0.0;
    c_.force.set(k, near.normal);  // the new normal, until respond() puts the force there
  }

  /// A contact that is fresh on one feature while the grain leaves the feature next to it is the same contact: it
  /// takes the history along.
  void take_over(std::size_t k, Index begin, Index end) const {
    if (c_.touching[k] != fresh) return;
    const auto& neighbours = state_.vessel.feature(c_.feature[k]).neighbours;
    const auto beside = [&](int a) {
      return std::find(neighbours.begin(), neighbours.end(), a) != neighbours.end();
    };
    for (Index m = begin; m < end; ++m) {
      const auto o = static_cast<std::size_t>(m);
      if (c_.touching[o] != left || !(beside(c_.feature[o]) || shares_edge(c_.feature[o], c_.feature[k]))) continue;
      c_.history.set(k, c_.history.get(o));
      c_.normal.set(k, c_.normal.get(o));
      if constexpr (has_couples(friction)) c_.rolling_moment.set(k, c_.rolling_moment.get(o));
      return;
    }
  }
  bool shares_edge(int a, int b) const {
    const auto& na = state_.vessel.feature(a).neighbours;
    const auto& nb = state_.vessel.feature(b).neighbours;
    return std::any_of(na.begin(), na.end(), [&](int e) { return std::find(nb.begin(), nb.end(), e) != nb.end(); });
  }

  void respond(Index i, std::size_t k, WallLosses& losses) const {
    const Particles& p = state_.particles;
    const auto s = static_cast<std::size_t>(i);
    const Vec3 n = c_.force.get(k), before = c_.normal.get(k);
    c_.normal.set(k, n);
    const bool touches = c_.touching[k] == held || c_.touching[k] == fresh;
    if (c_.touching[k] == held && dot(n, before) < 0 &&
        state_.vessel.feature(c_.feature[k]).kind != WallFeature::Kind::edge)
      losses.crossed = i;
    c_.touching[k] = touches ? 1 : 0;
    if (!touches) {
      c_.history.set(k, {});
      c_.force.set(k, {});
      c_.torque.set(k, {});
      if constexpr (has_couples(friction)) c_.rolling_moment.set(k, {});
      return;
    }
    const int wall = state_.vessel.carrier(c_.feature[k]);
    const auto coefficients = mix_.coefficients(p.material[s], state_.vessel, wall);
    const double lever = p.radius[s] - c_.overlap[k];
    const Vec3 w = friction == Friction::none ? Vec3{} : p.seen[s].angular_velocity;
    const Vec3 wall_velocity = state_.vessel.surface_velocity(wall, p.position.get(s) + lever * n);
    const Vec3 v = p.seen[s].velocity - wall_velocity + lever * cross(w, n);

    ContactInput in{c_.overlap[k], p.radius[s], p.mass[s], dot(v, n), {}, {}};
    if constexpr (friction != Friction::none) {
      in.tangential_velocity = v - in.approach_velocity * n;
      const Vec3 wall_spin{0, 0, state_.vessel.wall(wall).spin}, stored = c_.history.get(k);
      in.displacement = spin_about_normal(follow_normal(stored, before, n), n, 0.25 * dt_ * dot(w + wall_spin, n)) +
                        slip_time(stored, in.overlap, in.approach_velocity, dt_) * in.tangential_velocity;
    }
    const ContactResponse out = Law::respond(coefficients, in);
    const Vec3 tangential = friction == Friction::none ? Vec3{} : out.tangential;
    const Vec3 force = tangential - out.normal * n;
    const Vec3 torque = lever * cross(n, tangential);
    c_.force.set(k, force);
    c_.torque.set(k, torque);
    losses.contact.normal_damping += (out.normal - out.elastic_normal) * in.approach_velocity * dt_;
    losses.wall_work += dt_ * dot(force, wall_velocity);
    if constexpr (friction != Friction::none) {
      c_.history.set(k, out.displacement + (0.5 * dt_) * in.tangential_velocity);
      losses.contact.tangential_work -= dt_ * dot(out.elastic_tangential, in.tangential_velocity);
      losses.contact.tangential_damping +=
          dt_ * dot(out.elastic_tangential - out.tangential, in.tangential_velocity);
      losses.contact.sliding += out.sliding_loss;
    }
    double* const sum = reactions_.sum(i);
    const double felt[] = {force.x, force.y, force.z, torque.x, torque.y, torque.z};
    for (int c = 0; c < 6; ++c) sum[c] += felt[c];
    if constexpr (friction == Friction::rolling) sum[6] += coefficients.rolling * std::fabs(out.normal);
    if constexpr (has_couples(friction)) add_couple(i, k, coefficients.rolling, out, before, losses);
  }

  /// Rolling couple of grain i on the wall of row k, added to the torque. The wall has no inertia to share.
  void add_couple(Index i, std::size_t k, double rolling, const ContactResponse& response, Vec3 before,
                  WallLosses& losses) const {
    const Particles& p = state_.particles;
    const auto s = static_cast<std::size_t>(i);
    const Vec3 n = c_.normal.get(k), w = p.seen[s].angular_velocity;
    const Vec3 wall_spin{0, 0, state_.vessel.wall(state_.vessel.carrier(c_.feature[k])).spin};
    RollingInput in{
        w - wall_spin,   n, std::fabs(response.normal), response.elastic_normal / c_.overlap[k], rolling, 0,
        rolling_damping_};
    Vec3 couple;
    if constexpr (friction == Friction::relative) {
      in.inertia = sphere_inertia(p.mass[s], p.radius[s]) / state_.contacts.contact_count[s];
      couple = relative_couple(in, dt_);
    } else {
      in.inertia = rocking_inertia(p.mass[s], p.radius[s]);
      const Vec3 followed = follow_normal(c_.rolling_moment.get(k), before, n);
      const RollingSpring spring =
          rolling_spring(in, spin_about_normal(followed, n, 0.25 * dt_ * dot(w + wall_spin, n)), dt_);
      couple = spring.couple;
      c_.rolling_moment.set(k, spring.moment);
    }
    c_.torque.set(k, c_.torque.get(k) + couple);
    double* const sum = reactions_.sum(i);
    sum[3] += couple.x;
    sum[4] += couple.y;
    sum[5] += couple.z;
    losses.contact.rolling -= dt_ * dot(couple, in.spin);
    losses.wall_work += dt_ * dot(couple, wall_spin);
  }

  const WallMix<Law>& mix_;
  State& state_;
  Reactions& reactions_;
  WallContactTable& c_;
  double dt_, rolling_damping_;
};

/// Pre: fold_reactions ran; dt as in evaluate_contacts.
/// Post: wall forces are in the table and added to the sums of the grains.
/// Throws PhysicsError when a grain's centre has gone through a wall.
template <class Law, Friction friction>
void evaluate_walls(const WallMix<Law>& mix, State& state, Reactions& reactions, double dt, double rolling_damping) {
  const WallContactTable& c = state.wall_contacts;
  const auto grains = static_cast<Index>(c.grain.size());
  const WallLosses sum = reduce_blocks(
      grains, WallLosses{},
      [&](Index begin, Index end) {
        WallLosses losses;
        const WallRows<Law, friction> rows(mix, state, reactions, {dt, rolling_damping});
        for (Index g = begin; g < end; ++g) {
          const auto s = static_cast<std::size_t>(g);
          rows.evaluate(c.grain[s], c.begin[s], c.begin[s + 1], losses);
        }
        return losses;
      },
      [](WallLosses a, const WallLosses& b) {
        a.contact = a.contact + b.contact;
        a.wall_work += b.wall_work;
        a.crossed = std::max(a.crossed, b.crossed);
        return a;
      });
  book(sum.contact, state.energy);
  state.energy.wall_work += sum.wall_work;
  if (sum.crossed >= 0) {
    const auto s = static_cast<std::size_t>(sum.crossed);
    const Vec3 x = state.particles.position.get(s);
    std::ostringstream text;
    text << "grain " << state.particles.id[s] << " went through a wall at (" << x.x << ", " << x.y << ", " << x.z
         << ") m in step " << state.step
         << ". Likely cause: the wall is too soft for the load, or the time step too long.";
    throw PhysicsError(text.str());
  }
}

}  // namespace wedge

// evaluate_contacts.hpp: the contact pass: every row of the contact table computes its force and writes its own
// slot.
#pragma once

#include "core/parallel.hpp"
#include "core/state.hpp"
#include "kernels/contact_law.hpp"
#include "kernels/history.hpp"
#include "kernels/rolling.hpp"

namespace wedge {

/// What of the physics a scene needs; chosen once, before the loops.
enum class Friction {
  none,
  sliding,
  rolling,   // and rolling friction against a grain's own spin, by the limiter in integrate.hpp
  relative,  // and a couple in each contact against the spin of the pair
  spring     // and a couple in each contact from a rolling spring
};
constexpr bool has_couples(Friction friction) {
  return friction == Friction::relative || friction == Friction::spring;
}

/// Energies lost in one force step [J]; see EnergyLedger.
struct ContactLosses {
  double normal_damping = 0, tangential_damping = 0, sliding = 0, tangential_work = 0;
  double rolling = 0;  // of the couples in contacts; the limiter books its own
};

/// All grains alike: one radius, one material. Everything about a pair is a constant of the loop.
template <class Law>
struct UniformMix {
  using Coefficients = typename Law::Coefficients;
  double radius, mass;
  Coefficients coefficients;

  struct Pair {
    double radius_first, radius_second, effective_radius, effective_mass;
    const Coefficients& coefficients;
  };
  Pair pair(Index, Index) const { return {radius, radius, 0.5 * radius, 0.5 * mass, coefficients}; }
};

/// Any radii and materials: looked up for each pair.
template <class Law>
struct GeneralMix {
  using Coefficients = typename Law::Coefficients;
  const double* radius;
  const double* mass;
  const std::int32_t* material;
  const Coefficients* table;  // by PairTable slot

  struct Pair {
    double radius_first, radius_second, effective_radius, effective_mass;
    Coefficients coefficients;
    double mass_first, mass_second;
  };
  Pair pair(Index i, Index j) const {
    const double ri = radius[i], rj = radius[j], mi = mass[i], mj = mass[j];
    const int a = std::max(material[i], material[j]), b = std::min(material[i], material[j]);
    return {ri, rj, ri * rj / (ri + rj), mi * mj / (mi + mj), table[a * (a + 1) / 2 + b], mi, mj};
  }
};

/// Bare pointers to what the pass reads and writes, so that the compiler sees plain arrays.
struct ContactPassArrays {
  const double *x, *y, *z, *vx, *vy, *vz, *wx, *wy, *wz;
  const Index *first, *second;
  double *hx, *hy, *hz, *nx, *ny, *nz;
  double* outcome;
  Vec3Array *couple, *rolling_moment;
  const Index* contact_count;
  double rolling_damping;
};

/// Rows are computed a slab at a time: outcomes wait in columns, for the vector loop, and go to memory as one
/// record a row.
inline constexpr Index slab_size = 64;
struct OutcomeSlab {
  alignas(cache_line) double column[ContactTable::outcome_size][slab_size];
};

inline ContactPassArrays contact_pass_arrays(State& s, double rolling_damping) {
  const Particles& p = s.particles;
  ContactTable& c = s.contacts;
  return {p.position.x.data(),
          p.position.y.data(),
          p.position.z.data(),
          p.velocity_seen.x.data(),
          p.velocity_seen.y.data(),
          p.velocity_seen.z.data(),
          p.angular_velocity_seen.x.data(),
          p.angular_velocity_seen.y.data(),
          p.angular_velocity_seen.z.data(),
          c.first.data(),
          c.second.data(),
          c.history.x.data(),
          c.history.y.data(),
          c.history.z.data(),
          c.normal.x.data(),
          c.normal.y.data(),
          c.normal.z.data(),
          c.outcome.data(),
          &c.couple,
          &c.rolling_moment,
          c.contact_count.data(),
          rolling_damping};
}

/// Rolling couple of row k, whose normal is still that of the last step. Returns the work done against it [J].
template <Friction friction, class Pair>
double row_couple(const Pair& pair, const ContactPassArrays& a, Index k, Vec3 n, const ContactResponse& response,
                  double overlap, double dt) {
  const Index i = a.first[k], j = a.second[k];
  const auto row = static_cast<std::size_t>(k);
  if (!(overlap > 0)) {
    a.couple->set(row, {});
    a.rolling_moment->set(row, {});
    return 0;
  }
  const Vec3 wi{a.wx[i], a.wy[i], a.wz[i]}, wj{a.wx[j], a.wy[j], a.wz[j]};
  RollingInput in{wi - wj,
                  n,
                  std::fabs(response.normal),
                  response.elastic_normal / overlap,
                  pair.coefficients.rolling,
                  0,
                  a.rolling_damping};
  if constexpr (friction == Friction::relative) {
    const double inertia_i = sphere_inertia(pair.mass_first, pair.radius_first),
                 inertia_j = sphere_inertia(pair.mass_second, pair.radius_second);
    in.inertia = inertia_i * inertia_j / (inertia_i + inertia_j) / std::max(a.contact_count[i], a.contact_count[j]);
    a.couple->set(row, relative_couple(in, dt));
  } else {
    in.inertia = 1 / (1 / rocking_inertia(pair.mass_first, pair.radius_first) +
                      1 / rocking_inertia(pair.mass_second, pair.radius_second));
    const Vec3 followed = follow_normal(a.rolling_moment->get(row), {a.nx[k], a.ny[k], a.nz[k]}, n);
    const RollingSpring spring =
        rolling_spring(in, spin_about_normal(followed, n, 0.25 * dt * dot(wi + wj, n)), dt);
    a.couple->set(row, spring.couple);
    a.rolling_moment->set(row, spring.moment);
  }
  return -dt * dot(a.couple->get(row), in.spin);
}

/// One row: geometry, transport of the history, law, forces. Returns the losses of the step.
/// The displacement grows by the trapezoidal rule from first touch on: what is stored between steps is
/// delta + (dt/2) v_t, so that the next half step needs no old velocity (kernels/README.md, "Stored displacement").
template <class Law, Friction friction, class Mix>
__attribute__((always_inline)) inline ContactLosses evaluate_row(const Mix& mix, const ContactPassArrays& a,
                                                                 Index k, double dt, OutcomeSlab& slab, Index row) {
  const Index i = a.first[k], j = a.second[k];
  const auto pair = mix.pair(i, j);
  const Vec3 d{a.x[j] - a.x[i], a.y[j] - a.y[i], a.z[j] - a.z[i]};
  const double distance = std::sqrt(dot(d, d));
  const Vec3 n = (1 / distance) * d;
  const double gap = distance - (pair.radius_first + pair.radius_second);
  const bool touching = gap < 0;
  const double overlap = touching ? -gap : 0.0;
  Vec3 v{a.vx[i] - a.vx[j], a.vy[i] - a.vy[j], a.vz[i] - a.vz[j]};

  ContactInput in{overlap, pair.effective_radius, pair.effective_mass, 0, {}, {}};
  if constexpr (friction == Friction::none) {
    in.approach_velocity = dot(v, n);
  } else {
    const Vec3 wi{a.wx[i], a.wy[i], a.wz[i]}, wj{a.wx[j], a.wy[j], a.wz[j]};
    const double lever_i = pair.radius_first - 0.5 * overlap, lever_j = pair.radius_second - 0.5 * overlap;
    v += cross(lever_i * wi + lever_j * wj, n);
    in.approach_velocity = dot(v, n);
    in.tangential_velocity = v - in.approach_velocity * n;
    const Vec3 stored{a.hx[k], a.hy[k], a.hz[k]};
    const Vec3 followed = follow_normal(stored, {a.nx[k], a.ny[k], a.nz[k]}, n);
    in.displacement = spin_about_normal(followed, n, 0.25 * dt * dot(wi + wj, n)) +
                      slip_time(stored, overlap, in.approach_velocity, dt) * in.tangential_velocity;
  }

  const ContactResponse out = Law::respond(pair.coefficients, in);
  const double on = touching ? 1.0 : 0.0;
  const Vec3 force = on * (out.tangential - out.normal * n);
  slab.column[0][row] = force.x;
  slab.column[1][row] = force.y;
  slab.column[2][row] = force.z;
  slab.column[6][row] = 0.5 * overlap;
  ContactLosses losses;
  losses.normal_damping = on * (out.normal - out.elastic_normal) * in.approach_velocity * dt;
  if constexpr (friction != Friction::none) {
    const Vec3 q = on * cross(n, out.tangential);
    slab.column[3][row] = q.x;
    slab.column[4][row] = q.y;
    slab.column[5][row] = q.z;
    const Vec3 keep = on * (out.displacement + (0.5 * dt) * in.tangential_velocity);
    a.hx[k] = keep.x;
    a.hy[k] = keep.y;
    a.hz[k] = keep.z;
    if constexpr (has_couples(friction))
      losses.rolling = on * row_couple<friction>(pair, a, k, n, out, overlap, dt);
    a.nx[k] = n.x;
    a.ny[k] = n.y;
    a.nz[k] = n.z;
    losses.tangential_work = -on * dt * dot(out.elastic_tangential, in.tangential_velocity);
    losses.tangential_damping = on * dt * dot(out.elastic_tangential - out.tangential, in.tangential_velocity);
    losses.sliding = on * out.sliding_loss;
  }
  if constexpr (friction == Friction::rolling)
    slab.column[7][row] = on * pair.coefficients.rolling * std::fabs(out.normal);
  return losses;
}

/// Writes the columns of a slab as one record for each of its rows.
inline void store(const OutcomeSlab& slab, Index rows, double* outcome) {
  for (Index row = 0; row < rows; ++row)
    for (std::size_t c = 0; c < ContactTable::outcome_size; ++c)
      outcome[ContactTable::outcome_size * static_cast<std::size_t>(row) + c] = slab.column[c][row];
}

/// Pre: images are fresh, velocity_seen is predicted to the time of the positions; dt [s] is the time since the
/// last force step (0: forces at the start, no history grows). Post: each row's force, lever torque, half overlap,
/// rolling cap, history and normal are those of now.
template <class Law, Friction friction, bool with_budget, class Mix>
void evaluate_contacts(const Mix& mix, State& state, double dt, double rolling_damping) {
  const ContactPassArrays arrays = contact_pass_arrays(state, rolling_damping);
  const ContactLosses sum = reduce_blocks(
      state.contacts.rows(), ContactLosses{},
      [&](Index begin, Index end) {
        const ContactPassArrays a = arrays;
        const Mix m = mix;
        double normal_damping = 0, tangential_damping = 0, sliding = 0, tangential_work = 0, rolling = 0;
        OutcomeSlab slab{};
        for (Index from = begin; from < end; from += slab_size) {
          const Index rows = std::min(slab_size, end - from);
          WEDGE_SIMD_SUM(normal_damping, tangential_damping, sliding, tangential_work, rolling)
          for (Index row = 0; row < rows; ++row) {
            const ContactLosses l = evaluate_row<Law, friction>(m, a, from + row, dt, slab, row);
            if constexpr (with_budget) {
              normal_damping += l.normal_damping;
              tangential_damping += l.tangential_damping;
              sliding += l.sliding;
              tangential_work += l.tangential_work;
              if constexpr (has_couples(friction)) rolling += l.rolling;
            }
          }
          store(slab, rows, a.outcome + ContactTable::outcome_size * static_cast<std::size_t>(from));
        }
        return ContactLosses{normal_damping, tangential_damping, sliding, tangential_work, rolling};
      },
      [](ContactLosses p, const ContactLosses& q) {
        return ContactLosses{p.normal_damping + q.normal_damping, p.tangential_damping + q.tangential_damping,
                             p.sliding + q.sliding, p.tangential_work + q.tangential_work, p.rolling + q.rolling};
      });
  state.energy.normal_damping += sum.normal_damping;
  state.energy.tangential_damping += sum.tangential_damping;
  state.energy.sliding += sum.sliding;
  state.energy.tangential_work += sum.tangential_work;
  state.energy.rolling += sum.rolling;
}

}  // namespace wedge

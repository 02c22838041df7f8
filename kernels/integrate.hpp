// integrate.hpp: the half kicks and the drift of the velocity-Verlet step, with the rolling-friction limiter and
// the axis rule `clamp`.
#pragma once

#include "core/parallel.hpp"
#include "core/state.hpp"
#include "kernels/contact_law.hpp"
#include "kernels/friction.hpp"
#include "kernels/reactions.hpp"
#include "kernels/slab.hpp"

namespace wedge {

/// Does the axis act on the velocities?
enum class AxisAction { none, clamp, pin };

struct KickLosses {
  double rolling = 0, axis = 0;  // J
};

/// A grain closer to the axis than this part of its diameter has no radial direction; the axis rule leaves it
/// alone.
inline constexpr double axis_resolution = 1e-9;

/// Velocity after a kick of length h [s] by the force f [N] and gravity g [m/s2].
inline Vec3 kicked(Vec3 v, Vec3 f, Vec3 g, double mass, double h) { return v + h * ((1 / mass) * f + g); }

/// Energy [J] that a constraint takes from a grain of this mass (or inertia) in a kick from velocity v, which alone
/// would end at `free` and ends at `now`: the work of the impulse m (now - free) at the mean velocity of the kick.
/// Where the constraint holds a grain at rest against a force this is zero, while the kinetic energy of `free` is
/// not.
inline double taken(double mass, Vec3 v, Vec3 free, Vec3 now) { return 0.5 * mass * dot(free - now, v + now); }

/// The axis rule `clamp` (Yang et al. 2014, eqs 12-17): a grain whose surface reaches the axis and that moves
/// towards it loses its radial velocity.
inline Vec3 clamped_at_axis(Vec3 v, Vec3 position, double radius) {
  const double r2 = position.x * position.x + position.y * position.y;
  const double outward = position.x * v.x + position.y * v.y;  // r v_r
  const double nearest = 2 * radius * axis_resolution;
  const double take = (r2 < radius * radius && r2 >= nearest * nearest && outward < 0) ? outward / r2 : 0.0;
  return {v.x - take * position.x, v.y - take * position.y, v.z};
}

/// Whether a grain is on the axis as the axis rule `pin` sees it: closer than 0.05 of its radius (Cui et al. 2007).
/// Such a grain no longer moves sideways, so it stays on the axis.
inline bool on_axis(double x, double y, double radius) { return x * x + y * y < 0.0025 * radius * radius; }

/// The axis rule `pin`: a grain on the axis has no velocity but along it.
inline Vec3 pinned_at_axis(Vec3 v, Vec3 position, double radius) {
  const double keep = on_axis(position.x, position.y, radius) ? 0.0 : 1.0;
  return {keep * v.x, keep * v.y, v.z};
}

/// Angular velocity after a kick of length h by the torque t [N m] while rolling friction resists up to `cap` [N
/// m]: an exact limiter (PHYSICS: a grain whose spin the cap can stop within the kick stops and stays). `loss`
/// grows by the energy that rolling friction takes [J].
inline Vec3 spun(Vec3 w, Vec3 t, double cap, double inertia, double h, double& loss) {
  const double rate = h / inertia;
  const Vec3 free = w + rate * t;
  const double square = dot(free, free);
  const double left = std::max(0.0, 1 - rate * cap / std::sqrt(square + tiny));
  loss += 0.5 * inertia * (1 - left) * (dot(free, w) + left * square);  // taken() for now = left free
  return left * free;
}
inline Vec3 spun_freely(Vec3 w, Vec3 t, double inertia, double h) { return w + (h / inertia) * t; }

/// Radius, mass and material of grain i; constants when all grains are alike.
struct UniformBodies {
  double radius_, mass_;
  std::int32_t material_;
  double radius(Index) const { return radius_; }
  double mass(Index) const { return mass_; }
  double material(Index) const { return material_; }
};
struct GeneralBodies {
  const double *radius_, *mass_;
  const std::int32_t* material_;
  double radius(Index i) const { return radius_[i]; }
  double mass(Index i) const { return mass_[i]; }
  double material(Index i) const { return material_[i]; }
};

struct KickArrays {
  double *x, *y, *z, *vx, *vy, *vz, *wx, *wy, *wz;
  double *fx, *fy, *fz, *tx, *ty, *tz, *cap;
  const double *rx, *ry, *rz, *margin;
};

inline KickArrays kick_arrays(Particles& p) {
  return {p.position.x.data(),
          p.position.y.data(),
          p.position.z.data(),
          p.velocity.x.data(),
          p.velocity.y.data(),
          p.velocity.z.data(),
          p.angular_velocity.x.data(),
          p.angular_velocity.y.data(),
          p.angular_velocity.z.data(),
          p.force.x.data(),
          p.force.y.data(),
          p.force.z.data(),
          p.torque.x.data(),
          p.torque.y.data(),
          p.torque.z.data(),
          p.rolling_cap.data(),
          p.reference.x.data(),
          p.reference.y.data(),
          p.reference.z.data(),
          p.list_margin.data()};
}

/// The half kick of grain i at place x with the forces in memory; v and w become the new velocities.
template <Friction friction, AxisAction axis, class Bodies>
WEDGE_INLINE void half_kick(const Bodies& b, const KickArrays& a, Index i, Vec3 g, double h, Vec3 x, Vec3& v, Vec3& w,
                            double& rolling, double& axis_loss) {
  const double mass = b.mass(i), radius = b.radius(i);
  const Vec3 free = kicked(v, {a.fx[i], a.fy[i], a.fz[i]}, g, mass, h);
  if constexpr (axis == AxisAction::none) {
    v = free;
  } else {
    const Vec3 now = axis == AxisAction::clamp ? clamped_at_axis(free, x, radius) : pinned_at_axis(free, x, radius);
    axis_loss += taken(mass, v, free, now);
    v = now;
  }
  if constexpr (friction == Friction::rolling) {
    w = spun(w, {a.tx[i], a.ty[i], a.tz[i]}, a.cap[i], sphere_inertia(mass, radius), h, rolling);
  } else if constexpr (friction != Friction::none) {
    w = spun_freely(w, {a.tx[i], a.ty[i], a.tz[i]}, sphere_inertia(mass, radius), h);
  }
}

/// What contacts will see of a slab of grains, in columns.
struct SeenColumns {
  Column number[seen_size];

  /// Writes the first `count` of them as records.
  void write(Seen* to, Index count) const {
    for (Index row = 0; row < count; row += 8) {
      Eight columns[8], motion[8], spin[8];
      for (std::size_t c = 0; c < 8; ++c) columns[c] = *reinterpret_cast<const Eight*>(number[c].number + row);
      transpose(columns, motion);
      for (std::size_t c = 0; c < 4; ++c) columns[c] = *reinterpret_cast<const Eight*>(number[8 + c].number + row);
      transpose(columns, spin);
      for (Index r = 0; r < std::min<Index>(8, count - row); ++r) {
        *reinterpret_cast<UnalignedEight*>(&to[row + r]) = motion[r];
        *reinterpret_cast<Four*>(&to[row + r].angular_velocity) =
            __builtin_shufflevector(spin[r], spin[r], 0, 1, 2, 3);
      }
    }
  }
};

/// First half of a step: kick by dt/2, drift by dt, predict the velocities that contacts will see at the new time.
/// Returns whether the neighbour list went stale: a grain left the margin it had when the list was made (or is not
/// a number).
template <Friction friction, AxisAction axis, class Bodies>
bool kick_and_drift(const Bodies& bodies, State& state, Vec3 gravity, double dt) {
  const KickArrays arrays = kick_arrays(state.particles);
  Seen* const seen = state.particles.seen.data();
  struct Result {
    double rolling = 0, at_axis = 0, left = 0;
  };
  const Result result = reduce_blocks(
      state.particles.count(), Result{},
      [&](Index begin, Index end) {
        const KickArrays a = arrays;
        const Bodies b = bodies;
        const double h = 0.5 * dt;
        double rolling = 0, axis_loss = 0, left = 0;
        SeenColumns s;
        for (Index from = begin; from < end; from += slab_size) {
          const Index count = std::min(slab_size, end - from);
          WEDGE_SIMD_SUM(rolling, axis_loss, left)
          for (Index row = 0; row < count; ++row) {
            const Index i = from + row;
            Vec3 x{a.x[i], a.y[i], a.z[i]}, v{a.vx[i], a.vy[i], a.vz[i]}, w{};
            if constexpr (friction != Friction::none) w = {a.wx[i], a.wy[i], a.wz[i]};
            double r = 0, l = 0;
            half_kick<friction, axis>(b, a, i, gravity, h, x, v, w, r, l);
            rolling += r;
            axis_loss += l;
            a.vx[i] = v.x;
            a.vy[i] = v.y;
            a.vz[i] = v.z;
            x += dt * v;
            a.x[i] = x.x;
            a.y[i] = x.y;
            a.z[i] = x.z;
            if constexpr (friction != Friction::none) {
              a.wx[i] = w.x;
              a.wy[i] = w.y;
              a.wz[i] = w.z;
            }
            double unbooked = 0;
            half_kick<friction, axis>(b, a, i, gravity, h, x, v, w, unbooked, unbooked);
            const double shown[seen_size] = {x.x, x.y, x.z, v.x, v.y, v.z, b.radius(i), b.mass(i),
                                             w.x, w.y, w.z, b.material(i)};
            for (std::size_t c = 0; c < seen_size; ++c) s.number[c].number[row] = shown[c];
            const Vec3 way{x.x - a.rx[i], x.y - a.ry[i], x.z - a.rz[i]};
            left += dot(way, way) <= a.margin[i] * a.margin[i] ? 0.0 : 1.0;
            if constexpr (axis == AxisAction::pin) {  // who is newly on the axis meets others than before
              const double radius = b.radius(i);
              left += on_axis(x.x, x.y, radius) && !on_axis(a.rx[i], a.ry[i], radius) ? 1.0 : 0.0;
            }
          }
          s.write(seen + from, count);
        }
        return Result{rolling, axis_loss, left};
      },
      [](Result p, const Result& q) {
        return Result{p.rolling + q.rolling, p.at_axis + q.at_axis, p.left + q.left};
      });
  state.energy.rolling += result.rolling;
  state.energy.axis += result.at_axis;
  return result.left > 0;
}

/// Puts the sums of grains [from, from + count) into force, torque and rolling_cap.
template <Friction friction>
void take_sums(const Reactions& reactions, const KickArrays& a, Index from, Index count) {
  const auto* sums = reinterpret_cast<const Eight*>(reactions.sum(from));
  double* const to[] = {a.fx, a.fy, a.fz, a.tx, a.ty, a.tz, a.cap};
  constexpr std::size_t numbers = friction == Friction::none ? 3 : friction == Friction::rolling ? 7 : 6;
  Index row = 0;
  for (; row + 8 <= count; row += 8) {
    Eight records[8], columns[8];
    for (Index r = 0; r < 8; ++r) records[r] = sums[row + r];
    transpose(records, columns);
    for (std::size_t c = 0; c < numbers; ++c) *reinterpret_cast<UnalignedEight*>(to[c] + from + row) = columns[c];
  }
  for (; row < count; ++row)
    for (std::size_t c = 0; c < numbers; ++c) to[c][from + row] = sums[row][c];
}

/// Second half of a step: takes the new forces from the sums, and kicks by dt/2.
template <Friction friction, AxisAction axis, class Bodies>
void kick(const Bodies& bodies, State& state, const Reactions& reactions, Vec3 gravity, double dt) {
  const KickArrays arrays = kick_arrays(state.particles);
  const KickLosses losses = reduce_blocks(
      state.particles.count(), KickLosses{},
      [&](Index begin, Index end) {
        const KickArrays a = arrays;
        const Bodies b = bodies;
        double rolling = 0, axis_loss = 0;
        take_sums<friction>(reactions, a, begin, end - begin);
        WEDGE_SIMD_SUM(rolling, axis_loss)
        for (Index i = begin; i < end; ++i) {
          Vec3 v{a.vx[i], a.vy[i], a.vz[i]}, w{};
          if constexpr (friction != Friction::none) w = {a.wx[i], a.wy[i], a.wz[i]};
          double r = 0, l = 0;
          half_kick<friction, axis>(b, a, i, gravity, 0.5 * dt, {a.x[i], a.y[i], a.z[i]}, v, w, r, l);
          rolling += r;
          axis_loss += l;
          a.vx[i] = v.x;
          a.vy[i] = v.y;
          a.vz[i] = v.z;
          if constexpr (friction != Friction::none) {
            a.wx[i] = w.x;
            a.wy[i] = w.y;
            a.wz[i] = w.z;
          }
        }
        return KickLosses{rolling, axis_loss};
      },
      [](KickLosses p, const KickLosses& q) {
        return KickLosses{p.rolling + q.rolling, p.axis + q.axis};
      });
  state.energy.rolling += losses.rolling;
  state.energy.axis += losses.axis;
}

}  // namespace wedge

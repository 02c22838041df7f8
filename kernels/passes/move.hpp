// move.hpp: the pass over grains: second half of a step, first half of the next, or both at once.
#pragma once

#include "core/parallel.hpp"
#include "core/state.hpp"
#include "kernels/passes/grain_columns.hpp"
#include "kernels/passes/integrate.hpp"

namespace wedge {

/// Which halves of a step the pass does. Both at once read and write each grain once; forces then never leave the
/// registers.
enum class Halves { first, second, second_and_first };

/// Radius, mass and material of grain i, or of the pack that begins with it; constants when all grains are alike.
struct UniformBodies {
  double radius_, mass_;
  std::int32_t material_;
  template <class Real>
  Real radius(Index) const {
    return Real(radius_);
  }
  template <class Real>
  Real mass(Index) const {
    return Real(mass_);
  }
  template <class Real>
  Real material(Index) const {
    return Real(static_cast<double>(material_));
  }
};
struct GeneralBodies {
  const double *radius_, *mass_;
  const std::int32_t* material_;
  template <class Real>
  Real radius(Index i) const {
    return load<Real>(radius_ + i);
  }
  template <class Real>
  Real mass(Index i) const {
    return load<Real>(mass_ + i);
  }
  template <class Real>
  Real material(Index i) const {
    if constexpr (std::is_same_v<Real, double>)
      return material_[i];
    else
      return Real([&](auto lane) { return static_cast<double>(material_[i + static_cast<Index>(lane)]); });
  }
};

/// Three arrays, bare, so that the compiler sees that none of them moves.
struct Components {
  double *x, *y, *z;
  explicit Components(Vec3Array& v) : x(v.x.data()), y(v.y.data()), z(v.z.data()) {}
  template <class Real>
  WEDGE_INLINE Vector3<Real> get(Index i) const {
    return {load<Real>(x + i), load<Real>(y + i), load<Real>(z + i)};
  }
  template <class Real>
  WEDGE_INLINE void set(Index i, const Vector3<Real>& v) const {
    store(x + i, v.x);
    store(y + i, v.y);
    store(z + i, v.z);
  }
};

/// What the pass did to a block of grains.
struct MoveResult {
  KickLossesOf<double> second, first;  // J, lost in the second half of a step and in the first of the next
  bool stale = false;                  // a grain left the margin it had when the list was made, or is not a number
};
inline MoveResult operator+(const MoveResult& a, const MoveResult& b) {
  return {{a.second.rolling + b.second.rolling, a.second.axis + b.second.axis},
          {a.first.rolling + b.first.rolling, a.first.axis + b.first.axis},
          a.stale || b.stale};
}

template <Halves halves, Friction friction, AxisAction axis, class Bodies>
class MovePass {
public:
  MovePass(const Bodies& bodies, Particles& p, const ForceSums& sums, Vec3 gravity, double dt)
      : bodies_(bodies),
        sums_(sums),
        gravity_(gravity),
        dt_(dt),
        x_(p.position),
        v_(p.velocity),
        w_(p.angular_velocity),
        force_(p.force),
        torque_(p.torque),
        reference_(p.reference),
        cap_(p.rolling_cap.data()),
        margin_(p.list_margin.data()),
        seen_(p.seen) {}

  /// Grains [begin, end).
  MoveResult move(Index begin, Index end) {
    Losses<Pack> packs;
    Losses<double> singles;
    for (Index from = begin; from < end; from += slab_size) {
      const Index count = std::min(slab_size, end - from);
      if constexpr (halves != Halves::first) columns_.read(sums_, from, count);
      Index row = 0;
      for (; row + pack_size <= count; row += pack_size) move(from, row, packs);
      for (; row < count; ++row) move(from, row, singles);
      if constexpr (halves != Halves::second) shown_.write(seen_, from, count);
    }
    const auto total = [](const KickLossesOf<Pack>& p, const KickLossesOf<double>& s) {
      return KickLossesOf<double>{simd::reduce(p.rolling) + s.rolling, simd::reduce(p.axis) + s.axis};
    };
    return {total(packs.second, singles.second), total(packs.first, singles.first),
            simd::reduce(packs.outside) + singles.outside > 0};
  }

private:
  template <class Real>
  struct Losses {
    KickLossesOf<Real> second, first;
    Real outside{};  // grains that left their margins
  };

  template <class Real>
  WEDGE_INLINE ForcesOf<Real> forces(Index i, Index row) const {
    ForcesOf<Real> f;
    if constexpr (halves == Halves::first) {
      f.force = force_.get<Real>(i);
      if constexpr (friction != Friction::none) f.torque = torque_.get<Real>(i);
      if constexpr (friction == Friction::rolling) f.cap = load<Real>(cap_ + i);
    } else {
      const auto sum = [&](std::size_t c) { return load<Real>(columns_.number[c].number + row); };
      f.force = {sum(0), sum(1), sum(2)};
      if constexpr (friction != Friction::none) f.torque = {sum(3), sum(4), sum(5)};
      if constexpr (friction == Friction::rolling) f.cap = sum(6);
    }
    return f;
  }

  /// The grain, or the pack of grains, in this row of the slab that begins with grain `from`.
  template <class Real>
  WEDGE_INLINE void move(Index from, Index row, Losses<Real>& losses) {
    const Index i = from + row;
    const double h = 0.5 * dt_;
    const Real radius = bodies_.template radius<Real>(i), mass = bodies_.template mass<Real>(i);
    const ForcesOf<Real> f = forces<Real>(i, row);
    Vector3<Real> x = x_.get<Real>(i), v = v_.get<Real>(i), w;
    if constexpr (friction != Friction::none) w = w_.get<Real>(i);
    const auto kick = [&](KickLossesOf<Real> & l) __attribute__((always_inline)) {
      half_kick<friction, axis>(radius, mass, f, gravity_, h, x, v, w, l);
    };
    if constexpr (halves != Halves::first) kick(losses.second);
    if constexpr (halves == Halves::second) {
      force_.set(i, f.force);
      if constexpr (friction != Friction::none) torque_.set(i, f.torque);
      if constexpr (friction == Friction::rolling) store(cap_ + i, f.cap);
    } else {
      kick(losses.first);
    }
    v_.set(i, v);
    if constexpr (friction != Friction::none) w_.set(i, w);
    if constexpr (halves != Halves::second) {
      x += dt_ * v;
      x_.set(i, x);
      KickLossesOf<Real> not_booked;
      kick(not_booked);
      show(i, row, x, v, w, radius, mass);
      const Vector3<Real> reference = reference_.get<Real>(i), way = x - reference;
      const Real margin = load<Real>(margin_ + i);
      losses.outside += select(dot(way, way) <= margin * margin, Real(0.0), Real(1.0));
      if constexpr (holds_on_axis(axis))  // who is newly on the axis meets others than before
        losses.outside +=
            select(on_axis(x.x, x.y, radius) && !on_axis(reference.x, reference.y, radius), Real(1.0), Real(0.0));
    }
  }

  template <class Real>
  WEDGE_INLINE void show(Index i, Index row, const Vector3<Real>& x, const Vector3<Real>& v, const Vector3<Real>& w,
                         const Real& radius, const Real& mass) {
    const Real shown[] = {x.x, x.y,  x.z, radius, v.x, v.y,
                          v.z, mass, w.x, w.y,    w.z, bodies_.template material<Real>(i)};
    for (std::size_t c = 0; c < std::size(shown); ++c) store(shown_.number[c].number + row, shown[c]);
  }

  const Bodies bodies_;
  const ForceSums& sums_;
  const Vec3 gravity_;
  const double dt_;
  const Components x_, v_, w_, force_, torque_, reference_;
  double* const cap_;
  const double* const margin_;
  SeenTable& seen_;
  GrainColumns columns_, shown_;  // of the sums, and of what contacts will see
};

/// Second half of a step: takes the forces of the grains from the sums, and kicks by dt/2. First half: kicks by
/// dt/2, drifts by dt, and predicts the velocities that contacts will see at the new time. Returns whether the
/// neighbour list went stale. Post: after `second` alone, force, torque and rolling_cap hold the forces of the
/// step, which `first` alone starts from.
template <Halves halves, Friction friction, AxisAction axis, class Bodies>
bool move_grains(const Bodies& bodies, State& state, const ForceSums& sums, Vec3 gravity, double dt) {
  const MoveResult result = reduce_blocks(
      state.particles.count(), MoveResult{},
      [&](Index begin, Index end) {
        return MovePass<halves, friction, axis, Bodies>(bodies, state.particles, sums, gravity, dt)
            .move(begin, end);
      },
      [](const MoveResult& a, const MoveResult& b) { return a + b; });
  state.energy.rolling += result.second.rolling;
  state.energy.axis += result.second.axis;
  state.energy.rolling += result.first.rolling;
  state.energy.axis += result.first.axis;
  return result.stale;
}

}  // namespace wedge

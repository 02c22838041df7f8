// impact.hpp: one impact of two spheres, or of a sphere on a plate, from first touch to parting.
#pragma once

#include <algorithm>

#include "kernels/laws/contact_law.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/experiment.hpp"

namespace wedge::test {

struct Impact {
  double force_max = 0, overlap_max = 0, duration = 0;  // N, m, s
  Vec3 v, w;                                            // m/s, rad/s: of grain 0 when it parted
  std::vector<double> time, force;                      // s since the first touch, N
};

/// A Hertz contact of effective modulus E*, radius R*, mass m* that is hit at `speed`.
struct HertzImpact {
  double young, radius, mass, speed;

  /// Energy of approach = (8/15) E* sqrt(R*) dn^(5/2).
  double overlap() const { return std::pow(15 * mass * speed * speed / (16 * young * std::sqrt(radius)), 0.4); }
  double force() const { return (4.0 / 3.0) * young * std::sqrt(radius) * std::pow(overlap(), 1.5); }
  /// 2 (dn / v) int_0^1 dx / sqrt(1 - x^(5/2)) = 2 sqrt(pi) Gamma(7/5) / Gamma(9/10) dn / v.
  double duration() const { return 2 * std::sqrt(pi) * std::tgamma(1.4) / std::tgamma(0.9) * overlap() / speed; }
};

/// Runs from just before the first touch until contact 0 has parted.
template <class Touching, class Overlap, class Force>
Impact impact(Experiment& e, double dt, Touching touching, Overlap overlap, Force force) {
  Impact r;
  bool touched = false;
  const bool parted = e.run_until(
      [&] {
        const bool now = touching() > 0;
        touched = touched || now;
        if (now) {
          r.duration += dt;
          r.overlap_max = std::max(r.overlap_max, overlap());
          r.force_max = std::max(r.force_max, force());
          r.time.push_back(e.state.time);
          r.force.push_back(force());
        }
        return touched && !now;
      },
      2000000);
  REQUIRE(parted);
  r.v = e.v(0);
  r.w = e.w(0);
  return r;
}

/// Two equal spheres head on, each at `speed`.
inline Impact head_on(const Scene& scene, double radius, double speed, double dt) {
  Experiment e(scene,
               {{radius, {-radius, 0.3 * radius, 0}, {speed, 0, 0}, {}},
                {radius, {radius + 1e-9 * radius, 0.3 * radius, 0}, {-speed, 0, 0}, {}}},
               dt);
  return impact(
      e, dt, [&] { return e.touching(); }, [&] { return e.deepest_overlap(); },
      [&] { return norm(e.contact_force(0)); });
}

/// A sphere thrown at the plate z = 0 (the first wall of the scene) without gravity.
inline Impact on_plate(const Scene& scene, double radius, Vec3 v, Vec3 w, double dt) {
  Experiment e(scene, {{radius, {0.3, 0.2, radius * (1 + 1e-9)}, v, w}}, dt);
  return impact(
      e, dt, [&] { return e.touching_walls(); },
      [&] {
        double deepest = 0;
        for (const double o : e.state.wall_contacts.overlap) deepest = std::max(deepest, o);
        return deepest;
      },
      [&] { return norm(e.state.particles.force.get(0)); });
}

/// Adds the plate z = 0 of a material so stiff that only the sphere gives way; friction and restitution as among
/// the grains.
inline Scene with_rigid_plate(Scene s) {
  const Interaction contact = s.interactions(0, 0);
  s.materials.push_back(rigid_material());
  s.interactions = PairTable<Interaction>(2);
  for (int b = 0; b < 2; ++b)
    for (int a = 0; a <= b; ++a) s.interactions(b, a) = contact;
  add_wall(s, "plate", {{0, 0}, {2, 0}}, 1);
  return s;
}

}  // namespace wedge::test

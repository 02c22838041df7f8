// fill.cpp: random sequential addition of grains in a vessel, a sector or a slot.
#include "kernels/fill.hpp"

#include <cmath>
#include <sstream>

#include "core/cell_grid.hpp"
#include "core/random.hpp"
#include "core/require.hpp"

namespace wedge {
namespace {

constexpr double pi = 3.14159265358979323846;
constexpr std::int64_t tries_per_grain = 20000;
enum Stream : std::uint32_t { sizes_stream = 1, places_stream = 2, velocities_stream = 3 };

struct Body {
  double radius;
  int material;
};

/// A lognormal number by inversion of its distribution between the cuts (bisection: needs no inverse error
/// function).
double lognormal_diameter(const LognormalSizes& s, double u) {
  const auto below = [&](double d) {
    return 0.5 * std::erfc(-std::log(d / s.median) / (s.sigma * std::sqrt(2.0)));
  };
  const double target = below(s.smallest) + u * (below(s.largest) - below(s.smallest));
  double low = s.smallest, high = s.largest;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (below(middle) < target ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

std::vector<Body> draw_bodies(const RandomFill& fill, std::int64_t count, std::uint64_t seed) {
  RandomStream random(seed, sizes_stream);
  std::vector<Body> bodies;
  for (std::int64_t i = 0; i < count; ++i) {
    const double u = random.uniform();
    if (const auto* classes = std::get_if<std::vector<SizeClass>>(&fill.sizes)) {
      double total = 0, sum = 0;
      for (const SizeClass& c : *classes) total += c.fraction;
      std::size_t k = 0;
      while (k + 1 < classes->size() && (sum += (*classes)[k].fraction) <= u * total) ++k;
      bodies.push_back({0.5 * (*classes)[k].diameter, (*classes)[k].material});
    } else if (const auto* range = std::get_if<UniformSizes>(&fill.sizes)) {
      bodies.push_back({0.5 * (range->smallest + u * (range->largest - range->smallest)), range->material});
    } else {
      const auto& log = std::get<LognormalSizes>(fill.sizes);
      bodies.push_back({0.5 * lognormal_diameter(log, u), log.material});
    }
  }
  std::stable_sort(bodies.begin(), bodies.end(), [](const Body& a, const Body& b) { return a.radius > b.radius; });
  return bodies;
}

/// The grains placed so far, in cells, and the question whether one more has room.
class Packing {
public:
  Packing(const State& state, const Scene& scene, const RandomFill& fill, double largest_radius)
      : state_(state), scene_(scene), widest_(largest_radius) {
    const double r = fill.r_high, w = scene.domain.slot_width;
    const bool slot = scene.domain.kind == DomainKind::slot;
    grid_ = CellGrid(slot ? Vec3{fill.r_low, 0, fill.z_low} : Vec3{-r, -r, fill.z_low},
                     slot ? Vec3{fill.r_high, w, fill.z_high} : Vec3{r, r, fill.z_high}, 2 * widest_, 40000000);
    cells_.resize(static_cast<std::size_t>(grid_.cells()));
  }

  bool has_room(Vec3 x, const Body& body) const {
    for (int f = 0; f < state_.vessel.feature_count(); ++f)
      if (state_.vessel.active(f) && state_.vessel.proximity(f, x).distance < body.radius) return false;
    if (!free_at(x, body.radius)) return false;
    const Symmetry& symmetry = state_.symmetry;
    if (!symmetry.periodic()) return true;
    const int last = symmetry.kind() == Symmetry::Kind::translation ? 1 : symmetry.order() - 1;
    for (int k = symmetry.kind() == Symmetry::Kind::translation ? -1 : 1; k <= last; ++k) {
      if (k == 0 || symmetry.distance_to_domain(x, k) > body.radius + widest_) continue;
      const Vec3 copy = symmetry.turn_point(x, k);
      if (!free_at(copy, body.radius)) return false;
      if (meets_itself(scene_.domain.axis) && norm(copy - x) < 2 * body.radius) return false;
    }
    return true;
  }

  void add(Vec3 x, const Body& body) {
    cells_[static_cast<std::size_t>(grid_.cell(x))].push_back(static_cast<Index>(places_.size()));
    places_.push_back(x);
    bodies_.push_back(body);
  }
  const std::vector<Vec3>& places() const { return places_; }

private:
  bool free_at(Vec3 x, double radius) const {
    bool free = true;
    grid_.for_each_run_around(x, [&](Index first, Index last) {
      for (Index cell = first; free && cell <= last; ++cell)
        for (const Index other : cells_[static_cast<std::size_t>(cell)]) {
          const double reach = radius + bodies_[static_cast<std::size_t>(other)].radius;
          const Vec3 apart = places_[static_cast<std::size_t>(other)] - x;
          free = free && !(dot(apart, apart) < reach * reach);
        }
    });
    return free;
  }

  const State& state_;
  const Scene& scene_;
  double widest_;
  CellGrid grid_;
  std::vector<std::vector<Index>> cells_;
  std::vector<Vec3> places_;
  std::vector<Body> bodies_;
};

/// A place for a grain of this radius, uniform in the region's volume.
Vec3 draw_place(const Scene& scene, const RandomFill& fill, double radius, RandomStream& random) {
  const double a = random.uniform(), b = random.uniform(),
               z = random.uniform(fill.z_low + radius, fill.z_high - radius);
  const double high = fill.r_high - radius;
  if (scene.domain.kind == DomainKind::slot) {
    const double left = fill.r_low + radius;
    return {left + a * (high - left), b * scene.domain.slot_width, z};
  }
  const double inner = std::max(fill.r_low, cut_out_radius(scene.domain));
  const double low = inner + (inner > 0 ? radius : 0);
  const double r = std::sqrt(low * low + a * (high * high - low * low)), phi = b * 2 * pi / scene.domain.order;
  return {r * std::cos(phi), r * std::sin(phi), z};
}

}  // namespace

void describe_grains(State& state) {
  const Particles& p = state.particles;
  double sum = 0;
  state.alike = p.count() > 0;
  for (Index i = 0; i < p.count(); ++i)
    state.next_id = std::max(state.next_id, std::int64_t{p.id[static_cast<std::size_t>(i)]} + 1);
  for (std::size_t i = 0; i < static_cast<std::size_t>(p.count()); ++i) {
    sum += 2 * p.radius[i];
    state.alike = state.alike && p.radius[i] == p.radius[0] && p.material[i] == p.material[0];
  }
  state.mean_diameter = p.count() > 0 ? sum / p.count() : 0;
}

void complete_grains(Particles& p, const std::vector<Material>& materials, double layer_height) {
  for (Vec3Array* field : {&p.force, &p.torque, &p.reference})
    for (Index i = 0; i < p.count(); ++i) field->set(static_cast<std::size_t>(i), {});
  double lowest = 0;
  for (Index i = 0; i < p.count(); ++i)
    lowest = i == 0 ? p.position.z[0] : std::min(lowest, p.position.z[static_cast<std::size_t>(i)]);
  for (Index i = 0; i < p.count(); ++i) {
    const auto s = static_cast<std::size_t>(i);
    p.mass[s] = sphere_mass(p.radius[s], materials[static_cast<std::size_t>(p.material[s])].density);
    p.rolling_cap[s] = 0;
    p.list_margin[s] = 0;
    p.turns[s] = 0;
    p.layer[s] = static_cast<std::int32_t>((p.position.z[s] - lowest) / layer_height);
  }
}

void fill_at_random(State& state, const Scene& scene, const RandomFill& fill) {
  const std::int64_t count = (fill.count + scene.domain.order / 2) / scene.domain.order;
  const std::vector<Body> bodies = draw_bodies(fill, count, scene.particles.seed);
  Packing packing(state, scene, fill, bodies.empty() ? 1 : bodies.front().radius);
  RandomStream places(scene.particles.seed, places_stream), velocities(scene.particles.seed, velocities_stream);
  double mean_diameter = 0;
  for (const Body& body : bodies) {
    mean_diameter += 2 * body.radius / static_cast<double>(count);
    bool placed = false;
    for (std::int64_t t = 0; t < tries_per_grain && !placed; ++t) {
      const Vec3 x = draw_place(scene, fill, body.radius, places);
      placed = packing.has_room(x, body);
      if (placed) packing.add(x, body);
    }
    if (!placed) {
      std::ostringstream text;
      text << "only " << packing.places().size() << " of " << count
           << " grains found room in the fill region after " << tries_per_grain
           << " tries for the next. Make particles.region taller, or particles.count smaller.";
      throw SceneError(text.str());
    }
  }
  Particles& p = state.particles;
  p.resize(static_cast<Index>(count));
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
    p.position.set(i, packing.places()[i]);
    const auto any = [&] { return velocities.uniform(-fill.speed, fill.speed); };
    const double vx = any(), vy = any(), vz = any();
    p.velocity.set(i, {vx, vy, vz});
    p.angular_velocity.set(i, {});
    p.radius[i] = bodies[i].radius;
    p.material[i] = bodies[i].material;
    p.id[i] = static_cast<std::int32_t>(i);
  }
  complete_grains(p, scene.materials, mean_diameter > 0 ? mean_diameter : 1);
  state.put_in = count;
}

}  // namespace wedge

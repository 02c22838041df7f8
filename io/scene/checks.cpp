// checks.cpp: whether a scene makes physical sense.
#include "io/scene/checks.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <set>
#include <string>

#include "core/restitution.hpp"
#include "core/time_scales.hpp"

namespace wedge {

namespace {

constexpr double densest_fill = 0.30;  // packing fraction a random fill without overlap reaches in acceptable time
constexpr double least_width =
    1.1;  // of a sector's chord or of a slot, in largest diameters: no grain meets itself

bool materials_sound(const Scene& scene) {
  for (const Material& m : scene.materials)
    if (!(m.density > 0 && m.young > 0)) return false;
  return !scene.materials.empty();
}

std::set<int> wall_materials(const Scene& scene) {
  std::set<int> used;
  for (const WallDescription& wall : scene.walls) used.insert(wall.material);
  const bool side_planes = scene.domain.kind != DomainKind::full && scene.domain.sides == Sides::rigid;
  if (side_planes && scene.walls.empty()) used.insert(0);  // what Vessel gives them
  if (wall_around_axis(scene.domain) != AxisWall::none) used.insert(scene.domain.axis_material);
  return used;
}

void check_pairs(SceneReading& reading, const Scene& scene) {
  if (scene.materials.empty()) return;
  const std::set<int> grains = grain_materials(scene.particles);
  std::set<int> others = wall_materials(scene);
  others.insert(grains.begin(), grains.end());
  std::set<int> told;
  for (const int a : grains) {
    for (const int b : others) {
      if (scene.interactions(a, b).given || !told.insert(PairTable<Interaction>::slot(a, b)).second) continue;
      const std::string name = scene.materials[static_cast<std::size_t>(a)].name + "-" +
                               scene.materials[static_cast<std::size_t>(b)].name;
      reading.diagnostics.error(reading.place("contact"), "the pair '" + name + "' can meet but is not described",
                                "add [contact." + name + "] with sliding, rolling and damping or restitution");
    }
  }
}

void check_rolling(SceneReading& reading, const Scene& scene) {
  const double radius = smallest_diameter(scene.particles) / 2;
  if (!(radius > 0)) return;
  for (std::size_t a = 0; a < scene.materials.size(); ++a) {
    for (std::size_t b = 0; b < scene.materials.size(); ++b) {
      const double rolling = scene.interactions(static_cast<int>(a), static_cast<int>(b)).rolling;
      const std::string path = "contact." + scene.materials[a].name + "-" + scene.materials[b].name + ".rolling";
      if (rolling > radius && reading.places.count(path) > 0)
        reading.diagnostics.error(reading.place(path),
                                  "a rolling friction of " + plain_number(rolling) +
                                      " m exceeds the smallest radius, " + plain_number(radius) + " m",
                                  "rolling friction is a LENGTH, usually \"0.01 d\" to \"0.05 d\"");
    }
  }
}

/// A contact time is half a period of the damped spring: from critical damping on there is none.
void check_contact_time(SceneReading& reading, const Scene& scene) {
  if (!stiffness_is_given(scene.contact.law) || !(scene.contact.contact_time > 0)) return;
  for (const Interaction& pair : scene.interactions.entries()) {
    const double damping = pair.restitution && *pair.restitution > 0
                               ? damping_for(scene.contact.law, scene.contact.tension, *pair.restitution)
                               : pair.damping_normal;
    if (damping < 1) continue;
    reading.diagnostics.error(reading.place("contact.contact_time"),
                              "a contact with critical or stronger damping has no 'contact_time'",
                              "give a damping below 1 (a restitution above 0.14 without tension), or 'stiffness'");
    return;
  }
}

void check_fill(SceneReading& reading, const Scene& scene) {
  const auto* fill = std::get_if<RandomFill>(&scene.particles.grains);
  const double largest = largest_diameter(scene.particles);
  if (!fill || !(largest > 0) || !(fill->r_high > fill->r_low) || !(fill->z_high > fill->z_low)) return;
  if (scene.domain.kind == DomainKind::slot && !(scene.domain.slot_width > 0)) return;
  const bool around_axis = scene.domain.kind != DomainKind::slot && fill->r_low <= 0;
  if ((around_axis ? 2 * fill->r_high : fill->r_high - fill->r_low) < largest)
    reading.diagnostics.error(reading.place("particles.region"), "the fill region is narrower than a grain",
                              "the largest diameter is " + plain_number(largest) + " m");
  if (fill->z_high - fill->z_low < largest)
    reading.diagnostics.error(reading.place("particles.region.z"), "the fill region is shallower than a grain",
                              "the largest diameter is " + plain_number(largest) + " m");
  const double grain = numbers::pi / 6 * mean_power_of_diameter(scene.particles, 3);
  const double volume = fill_volume(scene.domain, *fill), height = fill->z_high - fill->z_low;
  const double packing = static_cast<double>(fill->count) * grain / volume;
  if (packing > densest_fill * (1 + 1e-12)) {
    const auto fits = static_cast<std::int64_t>(densest_fill * volume / grain * (1 + 1e-12));
    const double needed = std::ceil(height * packing / densest_fill * 1e4) / 1e4;  // rounded up to 0.1 mm
    reading.diagnostics.error(
        reading.place("particles.count"),
        std::to_string(fill->count) + " grains fill " + short_number(100 * packing) +
            " % of the fill region; a random fill reaches " + short_number(100 * densest_fill) + " %",
        "use at most count = " + std::to_string(fits) + ", or a region " + short_number(needed) + " m high");
  }
  if (scene.domain.outlet_height && *scene.domain.outlet_height > fill->z_low)
    reading.diagnostics.error(reading.place("domain.outlet.z"),
                              "the outlet lies above the bottom of the fill region",
                              "put it below z = " + plain_number(fill->z_low) + ", or no grain would stay");
}

void check_thickness(SceneReading& reading, const Scene& scene) {
  const double largest = largest_diameter(scene.particles);
  if (!(largest > 0)) return;
  const Domain& domain = scene.domain;
  if (domain.kind == DomainKind::slot && domain.slot_width > 0 && domain.slot_width < least_width * largest)
    reading.diagnostics.error(reading.place("domain.width"), "the slot is too narrow: a grain would meet itself",
                              "make it at least " + plain_number(least_width * largest) + " m wide");
  if (domain.kind != DomainKind::sector || domain.order < 2) return;
  const double radius = widest_radius(scene);
  const double chord = 2 * radius * std::sin(numbers::pi / domain.order);
  if (radius > 0 && chord < least_width * largest) {
    const double most = numbers::pi / std::asin(std::min(1.0, least_width * largest / (2 * radius)));
    reading.diagnostics.error(
        reading.place("domain.angle"),
        "the sector is too thin: at the largest radius, " + short_number(radius) + " m, it is only " +
            short_number(chord / largest) + " diameters wide",
        "use an angle of at least " + plain_number(360 / std::max(1.0, std::floor(most))) + " degrees");
  }
}

void check_step(SceneReading& reading, const Scene& scene, double step, const std::string& path) {
  if (!(step > 0) || !materials_sound(scene)) return;
  const StepScale scale = step_scale(scene);
  if (scale.time > 0 && step > scale.refused)
    reading.diagnostics.error(reading.place(path),
                              "a time step of " + plain_number(step) + " s is " +
                                  short_number(100 * step / scale.time) + " % of the " + scale.name + " time, " +
                                  short_number(scale.time) + " s",
                              "use at most " + short_number(scale.refused) + " s, or better \"auto\", which is " +
                                  short_number(scale.automatic) + " s");
}

/// How stages end must be something that can happen.
void check_stage_ends(SceneReading& reading, const Scene& scene) {
  const auto* fill = std::get_if<RandomFill>(&scene.particles.grains);
  for (std::size_t i = 0; i < scene.stages.size(); ++i) {
    const Stage& stage = scene.stages[i];
    const std::string path = "stage." + std::to_string(i);
    const auto* discharged = std::get_if<UntilDischarged>(&stage.until);
    if ((discharged || std::holds_alternative<UntilEmpty>(stage.until)) && !scene.domain.outlet_height)
      reading.diagnostics.error(reading.place(path + ".until"), "no grain can leave: the domain has no outlet",
                                "add outlet = { z = ... } to [domain]");
    if (discharged && fill && fill->count > 0 && discharged->count > fill->count / scene.domain.order)
      reading.diagnostics.error(
          reading.place(path + ".until.discharged"),
          "only " + std::to_string(fill->count / scene.domain.order) + " grains are in this domain",
          "a sector holds its share of 'count'");
    const bool chosen_by_gravity = !(scene.rest.speed > 0) || !(scene.rest.duration > 0);
    if (std::holds_alternative<UntilAtRest>(stage.until) && chosen_by_gravity && scene.domain.gravity.norm() == 0)
      reading.diagnostics.error(reading.place(path + ".until"), "without gravity, rest has no natural scale",
                                "give speed and duration in [rest]");
    if (stage.time_step) check_step(reading, scene, *stage.time_step, path + ".time_step");
  }
}

}  // namespace

double widest_radius(const Scene& scene) {
  double radius = 0;
  for (const WallDescription& wall : scene.walls)
    for (const Eigen::Vector2d& point : wall.profile) radius = std::max(radius, point.x());
  if (const auto* fill = std::get_if<RandomFill>(&scene.particles.grains); fill && radius <= 0)
    radius = fill->r_high;
  return radius;
}

double fill_volume(const Domain& domain, const RandomFill& fill) {
  const double height = fill.z_high - fill.z_low;
  if (domain.kind == DomainKind::slot) return (fill.r_high - fill.r_low) * domain.slot_width * height;
  const double inner = is_cylinder(domain.axis) ? std::max(fill.r_low, cut_out_radius(domain)) : fill.r_low;
  return numbers::pi * (fill.r_high * fill.r_high - inner * inner) * height;
}

void check_scene(SceneReading& reading, const Scene& scene) {
  check_pairs(reading, scene);
  check_rolling(reading, scene);
  check_contact_time(reading, scene);
  check_fill(reading, scene);
  check_thickness(reading, scene);
  check_step(reading, scene, scene.time_step, "time.step");
  check_stage_ends(reading, scene);
}

}  // namespace wedge

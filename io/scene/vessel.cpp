// vessel.cpp: [domain] and [[wall]].
#include <cmath>
#include <set>

#include "core/grain_sizes.hpp"
#include "io/scene/sections.hpp"

namespace wedge {

namespace {

/// Sectors that make the whole circle; complains when the angle does not divide 360 degrees.
int order_of(TableReader& t, double angle) {
  const double order = std::round(360 / angle);
  if (std::abs(360 / angle - order) <= 1e-9 * order) return static_cast<int>(order);
  const double below = std::floor(360 / angle), above = below + 1;
  t.error("angle", "an angle of " + plain_number(angle) + " degrees does not divide 360",
          "the nearest that do are " + plain_number(360 / above) + " (" + short_number(above) + " sectors) and " +
              plain_number(360 / below) + " (" + short_number(below) + " sectors)");
  return 1;
}

void read_domain_kind(TableReader& t, Domain& domain) {
  const auto kind = t.choice("kind", domain_kind_names);
  const auto angle = t.number("angle", {"an angle in degrees that divides 360, such as 90", 0.1, 360, true, true});
  const bool slot = kind == DomainKind::slot;
  if (slot && t.has("angle")) t.error("angle", "a slot has no angle", "give its width along y: width = 0.02");
  if (!slot && t.has("width")) t.error("width", "only a slot has a width", "remove it, or write kind = \"slot\"");
  if (angle && !slot) domain.order = order_of(t, *angle);
  domain.kind = kind.value_or(domain.order > 1 ? DomainKind::sector : DomainKind::full);
  if (kind == DomainKind::full && domain.order > 1)
    t.error("kind", "a full vessel has an angle of 360 degrees, not " + plain_number(*angle), "remove 'kind'");
  if (kind == DomainKind::sector && !t.has("angle")) t.missing("angle", "write angle = 90");
  if (kind == DomainKind::sector && angle == 360.0)
    t.error("kind", "an angle of 360 degrees is not a sector",
            "give a smaller angle, such as 90, or remove 'kind'");
  const Quantity width = Quantity::positive("a width along y, such as 0.02 or \"4 d\"");
  if (slot && !t.has("width")) t.missing("width", width.meaning);
  const auto slot_width = t.length("width", width);
  if (slot) domain.slot_width = slot_width.value_or(0);
}

void read_gravity(TableReader& t, Domain& domain) {
  const Quantity quantity = Quantity::any("a vector in m/s2: gravity = [0, 0, -9.81]");
  const auto gravity = t.numbers("gravity", quantity);
  if (!gravity) return;
  if (gravity->size() != 3) {
    t.error("gravity", "'gravity' must have three components, not " + std::to_string(gravity->size()),
            quantity.meaning);
    return;
  }
  domain.gravity = Eigen::Vector3d((*gravity)[0], (*gravity)[1], (*gravity)[2]);
  if (domain.kind == DomainKind::sector && (domain.gravity.x() != 0 || domain.gravity.y() != 0))
    t.error("gravity", "in a sector gravity must lie along the axis",
            "write gravity = [0, 0, " + plain_number(domain.gravity.z()) + "], or use angle = 360");
}

/// The only material grains are made of; nothing when there are several.
std::optional<int> only_grain_material(const Scene& scene) {
  const std::set<int> grains = grain_materials(scene.particles);
  if (grains.size() != 1 || scene.materials.empty()) return std::nullopt;
  return *grains.begin();
}

/// axis, and what a line or an inner cylinder is made of.
void read_axis(TableReader& t, const Scene& scene, Domain& domain) {
  domain.axis = t.choice("axis", axis_names).value_or(domain.axis);
  const Quantity radius = Quantity::positive("the radius of the inner cylinder, such as 0.02 or \"10 d\"");
  const bool hollow = is_cylinder(domain.axis), solid = is_solid(domain.axis);
  if (hollow && domain.kind == DomainKind::slot) t.error("axis", "a slot has no axis to cut out", "remove 'axis'");
  if (hollow && !t.has("inner_radius")) t.missing("inner_radius", radius.meaning);
  if (!hollow && t.has("inner_radius"))
    t.error("inner_radius", "the axis '" + axis_names.of(domain.axis) + "' has no inner radius",
            "write axis = " + axis_names.choice_of(is_cylinder) + ", or remove it");
  domain.inner_radius = t.length("inner_radius", radius).value_or(0);
  if (solid)
    domain.axis_material = read_wall_material(t, scene, "axis_material", only_grain_material(scene)).value_or(0);
  if (!solid && t.has("axis_material"))
    t.error("axis_material", "the axis '" + axis_names.of(domain.axis) + "' is made of nothing",
            "write axis = " + axis_names.choice_of(is_solid) + ", or remove it");
}

std::vector<Eigen::Vector2d> read_profile(TableReader& t, bool slot) {
  const std::string example =
      slot ? "write profile = [[x, z], [x, z], ...]" : "write profile = [[r, z], [r, z], ...]";
  std::vector<Eigen::Vector2d> points;
  const toml::node* node = t.node("profile");
  if (!node) {
    t.missing("profile", example);
    return points;
  }
  const toml::array* list = node->as_array();
  if (!list || list->size() < 2) {
    t.error("profile", "'profile' must be a list of at least two points", example);
    return points;
  }
  bool sound = true;
  for (const toml::node& entry : *list) {
    const toml::array* point = entry.as_array();
    if (!point || point->size() != 2) {
      t.reading().diagnostics.error(place_of(entry.source()), "a point of 'profile' must be two lengths", example);
      sound = false;
      continue;
    }
    const auto u = t.length_in(*point->get(0), slot ? "x" : "r",
                               slot ? Quantity::any(example) : Quantity::not_negative("a distance from the axis"));
    const auto z = t.length_in(*point->get(1), "z", Quantity::any(example));
    sound = sound && u && z;
    if (!u || !z) continue;
    const Eigen::Vector2d here(*u, *z);
    if (!points.empty() && (points.back() - here).norm() < 1e-9)
      t.reading().diagnostics.error(place_of(entry.source()), "two neighbouring points of 'profile' are the same",
                                    "remove one of them");
    points.push_back(here);
  }
  return sound ? points : std::vector<Eigen::Vector2d>{};
}

}  // namespace

void read_domain(SceneReading& reading, const toml::table& root, Scene& scene) {
  TableReader t = open_table(reading, root, "domain");
  Domain& domain = scene.domain;
  read_domain_kind(t, domain);
  domain.sides = t.choice("sides", sides_names).value_or(domain.sides);
  read_axis(t, scene, domain);
  read_gravity(t, domain);
  if (const toml::table* table = t.table("outlet")) {
    TableReader outlet(reading, table, "domain.outlet", "'outlet'");
    const std::string example = "write outlet = { z = -0.05 }: the height below which a grain counts as discharged";
    if (!outlet.has("z")) outlet.missing("z", example);
    domain.outlet_height = outlet.length("z", Quantity::any(example)).value_or(0);  // a wrong one was told
    outlet.finish();
  }
  t.finish();
}

void read_walls(SceneReading& reading, const toml::table& root, Scene& scene) {
  const toml::array* list = open_tables(reading, root, "wall");
  if (!list) return;
  const bool slot = scene.domain.kind == DomainKind::slot;
  const std::optional<int> grain_material = only_grain_material(scene);
  std::set<std::string> names;
  for (const toml::node& entry : *list) {
    const std::string number = std::to_string(scene.walls.size());
    TableReader t(reading, entry.as_table(), "wall." + number, "[[wall]]");
    WallDescription wall;
    if (!t.has("name")) t.missing("name", "write name = \"shell\"");
    wall.name = t.text("name", "write name = \"shell\"").value_or("");
    if (t.has("name") && wall.name.empty()) t.error("name", "a wall needs a name", "write name = \"shell\"");
    if (!wall.name.empty() && !names.insert(wall.name).second)
      t.error("name", "another wall is named '" + wall.name + "'", "give every wall a name of its own");
    wall.profile = read_profile(t, slot);
    wall.material = read_wall_material(t, scene, "material", grain_material).value_or(0);
    wall.spin = t.number("spin", Quantity::any("a spin about the axis in rad/s")).value_or(0);
    if (slot && wall.spin != 0) t.error("spin", "a wall of a slot cannot spin", "only a wall of revolution can");
    wall.speed = t.number("speed", Quantity::any("a speed upwards in m/s")).value_or(0);
    wall.present = t.boolean("present").value_or(true);
    t.finish();
    scene.walls.push_back(wall);
  }
}

}  // namespace wedge

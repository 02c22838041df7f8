// particles.cpp: [material.NAME] and [particles].
#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "core/grain_sizes.hpp"
#include "core/require.hpp"
#include "io/scene/sections.hpp"
#include "io/tables/state_csv.hpp"

namespace wedge {

namespace {

const Quantity diameter_quantity = Quantity::positive("a diameter in metres, such as 0.005");

std::optional<int> only_material(const Scene& scene) {
  return grain_material_names(scene.materials).size() == 1 ? std::optional<int>(0) : std::nullopt;
}

/// sizes = [{ diameter, fraction, material }, ...]
std::vector<SizeClass> read_size_classes(TableReader& particles, const Scene& scene, std::optional<int> material) {
  std::vector<SizeClass> classes;
  const toml::node* node = particles.node("sizes");
  const toml::array* list = node->as_array();
  if (!list || list->empty() || !list->is_homogeneous(toml::node_type::table)) {
    particles.error("sizes", "'sizes' must be a list of tables",
                    "write sizes = [{ diameter = 0.004, fraction = 0.3 }, { diameter = 0.005, fraction = 0.7 }]");
    return classes;
  }
  double sum = 0;
  bool complete = true;
  for (const toml::node& entry : *list) {
    const std::string number = std::to_string(classes.size());
    TableReader t(particles.reading(), entry.as_table(), particles.path("sizes") + "." + number,
                  "entry " + std::to_string(classes.size() + 1) + " of 'sizes'");
    SizeClass c;
    if (!t.has("diameter")) t.missing("diameter", diameter_quantity.meaning);
    if (const auto d = t.number("diameter", diameter_quantity)) c.diameter = *d;
    if (list->size() > 1 && !t.has("fraction"))
      t.missing("fraction", "the fraction of grains of this size, by number");
    const auto fraction =
        t.number("fraction", {"a fraction by number; all fractions add up to 1", 0, 1, false, true});
    if (fraction) c.fraction = *fraction;
    complete = complete && (fraction || list->size() == 1);
    if (const auto m = read_grain_material(t, scene, "material", material)) c.material = *m;
    t.finish();
    sum += c.fraction;
    classes.push_back(c);
  }
  if (complete && std::abs(sum - 1) > 1e-6)
    particles.error("sizes", "the fractions add up to " + short_number(sum) + ", not 1",
                    "they are fractions by number");
  return classes;
}

std::optional<LognormalSizes> read_lognormal(TableReader& diameter, int material) {
  const toml::table* table = diameter.table("lognormal");
  if (!table) return {};
  TableReader t(diameter.reading(), table, diameter.path("lognormal"), "'lognormal'");
  for (const char* key : {"median", "sigma", "smallest", "largest"})
    if (!t.has(key))
      t.missing(key, "write lognormal = { median = 0.005, sigma = 0.2, smallest = 0.003, largest = 0.008 }");
  const auto median = t.number("median", diameter_quantity), smallest = t.number("smallest", diameter_quantity),
             largest = t.number("largest", diameter_quantity);
  const auto sigma = t.number("sigma", Quantity::positive("the standard deviation of ln(diameter), such as 0.2"));
  t.finish();
  if (!median || !sigma || !smallest || !largest) return {};
  if (*smallest < *largest) return LognormalSizes{*median, *sigma, *smallest, *largest, material};
  t.error("smallest", "'smallest' is not below 'largest'", "they cut the distribution at both ends");
  return {};
}

/// diameter = number | { uniform = [a, b] } | { lognormal = { ... } }
void read_diameter(TableReader& particles, RandomFill& fill, int material) {
  const toml::node* node = particles.node("diameter");
  if (!node->is_table()) {
    if (const auto d = particles.number("diameter", diameter_quantity))
      fill.sizes = std::vector<SizeClass>{{*d, 1, material}};
    return;
  }
  TableReader t(particles.reading(), node->as_table(), particles.path("diameter"), "'diameter'");
  if (t.has("uniform") == t.has("lognormal"))
    particles.error("diameter", "a size distribution is either 'uniform' or 'lognormal'",
                    "write diameter = { uniform = [0.004, 0.006] }");
  if (t.has("uniform")) {
    const auto ends = t.numbers("uniform", diameter_quantity);
    if (ends && (ends->size() != 2 || !((*ends)[0] < (*ends)[1])))
      t.error("uniform", "'uniform' must be [smallest, largest]", "write uniform = [0.004, 0.006]");
    else if (ends)
      fill.sizes = UniformSizes{(*ends)[0], (*ends)[1], material};
  }
  if (t.has("lognormal"))
    if (const auto sizes = read_lognormal(t, material)) fill.sizes = *sizes;
  t.finish();
}

void read_region(TableReader& particles, const Scene& scene, RandomFill& fill) {
  const bool slot = scene.domain.kind == DomainKind::slot;
  const std::string across = slot ? "x" : "r";
  const std::string example = "write region = { " + across + " = [0, 0.1], z = [0, 0.5] }";
  if (!particles.has("region")) particles.missing("region", example);
  const toml::table* table = particles.table("region");
  if (!table) return;
  TableReader t(particles.reading(), table, particles.path("region"), "'region'");
  if (slot && t.has("r")) t.error("r", "a slot has no radius 'r'", "use x, the first coordinate");
  if (!slot && t.has("x"))
    t.error("x", "the region of a vessel of revolution has no 'x'", "use r, the distance from the axis");
  for (const std::string& key : {across, std::string("z")})
    if (!t.has(key)) t.missing(key, example);
  const Quantity radius = slot ? Quantity::any(example) : Quantity::not_negative(example);
  if (const auto r = t.interval(across, radius)) std::tie(fill.r_low, fill.r_high) = *r;
  if (const auto z = t.interval("z", Quantity::any(example))) std::tie(fill.z_low, fill.z_high) = *z;
  t.finish();
}

enum class GrainSource { fill, file };

bool overridden(TableReader& particles, const char* key) {
  return particles.has(key) && particles.place(key).origin > 0;
}

/// Where both a file and keys of a fill stand, a source given on the command line replaces the one of the scene.
GrainSource source_of(TableReader& particles) {
  if (!particles.has("file")) return GrainSource::fill;
  if (overridden(particles, "file")) return GrainSource::file;
  const bool fill =
      overridden(particles, "count") || overridden(particles, "region") || overridden(particles, "sizes");
  return fill ? GrainSource::fill : GrainSource::file;
}

/// Whether a key of the scene's fill steps aside for a file given on the command line.
bool replaced_by_file(TableReader& particles, const char* key) {
  return overridden(particles, "file") && !overridden(particles, key);
}

/// The file of grains as an absolute path; complains when it is no path.
std::string read_path(TableReader& particles) {
  const std::string meaning = "the path of a table of grains, such as \"state.csv\"";
  const auto path = particles.text("file", meaning);
  if (path && path->empty()) particles.error("file", "'file' is empty", meaning);
  return path && !path->empty() ? absolute_path(particles.reading(), *path, particles.place("file")) : "";
}

/// Mean diameter [m] of the grains in a file; 0 when it cannot be read.
double mean_diameter_in(const std::string& path, const Scene& scene, int material) {
  try {
    const Particles grains = read_state_csv(path, {0, material}, grain_material_names(scene.materials));
    double above = 0;  // the first radius: so the mean of equal grains is exact
    for (const double radius : grains.radius) above += radius - grains.radius[0];
    return grains.count() > 0 ? 2 * (grains.radius[0] + above / grains.count()) : 0;
  } catch (const FileError&) {
    return 0;  // whoever needs the grains says what is wrong with their file
  }
}

/// Sizes of grains that come from a file. `diameter` is for files without radii. "d" is, if it is there, the mean
/// diameter of the fill that the file replaces: the vessel keeps its size; else the mean of the file.
void read_file_sizes(TableReader& particles, Scene& scene, std::optional<int> material) {
  StateFile file;
  file.material = material.value_or(0);
  SceneReading& reading = particles.reading();
  RandomFill replaced;
  const bool distribution = particles.has("diameter") && particles.node("diameter")->is_table();
  if (particles.has("sizes") && replaced_by_file(particles, "sizes"))
    replaced.sizes = read_size_classes(particles, scene, material);
  else if (distribution && replaced_by_file(particles, "diameter"))
    read_diameter(particles, replaced, file.material);
  else
    file.diameter = particles.number("diameter", diameter_quantity).value_or(0);
  scene.particles.grains = replaced;
  reading.mean_diameter = file.diameter > 0 ? file.diameter : mean_diameter(scene.particles);
  const auto path = particles.node("file")->value<std::string>();
  if (!(reading.mean_diameter > 0) && path && !particles.has("sizes") && !particles.has("diameter"))
    reading.mean_diameter =
        mean_diameter_in(absolute_path(reading, *path, particles.place("file")), scene, file.material);
  scene.particles.grains = file;
}

std::optional<int> read_material(TableReader& table, const Scene& scene, const std::vector<std::string>& names,
                                 const std::string& key, std::optional<int> otherwise) {
  if (scene.materials.empty()) {
    (void)table.has(key);  // that there is no material is told once
    return otherwise;
  }
  const std::string remedy = "use " + one_of(names);
  if (!table.has(key)) {
    if (!otherwise) table.missing(key, remedy);
    return otherwise;
  }
  const auto name = table.text(key, remedy);
  if (!name) return {};
  const auto found = std::find(names.begin(), names.end(), *name);
  if (found != names.end()) return static_cast<int>(found - names.begin());
  if (*name == rigid_material().name)
    table.error(key, "only walls can be rigid", remedy);
  else
    table.error(key, "unknown material '" + *name + "'", suggestion(*name, names));
  return {};
}

/// Does any wall say that it is rigid?
bool has_rigid_walls(const toml::table& root) {
  const auto names_it = [](const toml::node* node) {
    const auto text = node ? node->value<std::string>() : std::nullopt;
    return text == rigid_material().name;
  };
  if (names_it(root["domain"]["axis_material"].node())) return true;
  const toml::array* walls = root["wall"].as_array();
  return walls && std::any_of(walls->begin(), walls->end(), [&](const toml::node& wall) {
           return wall.is_table() && names_it(wall.as_table()->get("material"));
         });
}

}  // namespace

std::optional<int> read_grain_material(TableReader& table, const Scene& scene, const std::string& key,
                                       std::optional<int> otherwise) {
  return read_material(table, scene, grain_material_names(scene.materials), key, otherwise);
}

std::optional<int> read_wall_material(TableReader& table, const Scene& scene, const std::string& key,
                                      std::optional<int> otherwise) {
  std::vector<std::string> names = grain_material_names(scene.materials);
  names.push_back(rigid_material().name);
  return read_material(table, scene, names, key, otherwise);
}

void read_materials(SceneReading& reading, const toml::table& root, Scene& scene) {
  TableReader all = open_table(reading, root, "material");
  std::vector<std::pair<Place, Material>> found;
  if (const toml::table* table = root["material"].as_table()) {
    for (auto&& [key, node] : *table) {
      const std::string name(key.str());
      const toml::table* description = all.table(name);
      if (!description) continue;
      if (name == rigid_material().name) {
        all.error(name, "'" + name + "' is the name of a wall without any compliance and cannot be described",
                  "name this material otherwise");
        continue;
      }
      TableReader t(reading, description, "material." + name, "[material." + name + "]");
      Material m;
      m.name = name;
      const Quantity density = Quantity::positive("a density in kg/m3, such as 2500");
      const Quantity young = Quantity::positive("a Young's modulus in Pa, such as 1e7");
      const Quantity poisson{"a Poisson ratio above -1 and up to 0.5, such as 0.3", -1, 0.5, false, true};
      if (!t.has("density")) t.missing("density", density.meaning);
      if (!t.has("young")) t.missing("young", young.meaning);
      if (!t.has("poisson")) t.missing("poisson", poisson.meaning);
      m.density = t.number("density", density).value_or(0);
      m.young = t.number("young", young).value_or(0);
      m.poisson = t.number("poisson", poisson).value_or(0);
      t.finish();
      found.emplace_back(t.here(), m);
    }
  }
  std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  for (auto& entry : found) scene.materials.push_back(std::move(entry.second));
  if (scene.materials.empty())
    reading.diagnostics.error(all.here(), "no material", "describe one: [material.grain] density, young, poisson");
  if (!scene.materials.empty() && has_rigid_walls(root)) scene.materials.push_back(rigid_material());
  scene.interactions = PairTable<Interaction>(static_cast<int>(scene.materials.size()));
}

void read_grain_sizes(TableReader& particles, Scene& scene) {
  const bool classes_with_materials = particles.has("sizes") && !particles.has("material");
  const std::optional<int> material = classes_with_materials
                                          ? only_material(scene)
                                          : read_grain_material(particles, scene, "material", only_material(scene));
  if (source_of(particles) == GrainSource::file) {
    read_file_sizes(particles, scene, material);
    return;
  }
  RandomFill fill;
  if (particles.has("sizes") && particles.has("diameter"))
    particles.error("sizes", "both 'diameter' and 'sizes' are given", "keep one of them");
  if (particles.has("sizes"))
    fill.sizes = read_size_classes(particles, scene, material);
  else if (particles.has("diameter"))
    read_diameter(particles, fill, material.value_or(0));
  else
    particles.missing("diameter", "write diameter = 0.005, sizes = [...] or file = \"state.csv\"");
  scene.particles.grains = fill;
  particles.reading().mean_diameter = mean_diameter(scene.particles);
}

void read_grain_source(TableReader& particles, Scene& scene) {
  const std::int64_t seed = particles.integer("seed", "a whole number", 0).value_or(1);
  scene.particles.seed = static_cast<std::uint64_t>(seed);
  if (auto* file = std::get_if<StateFile>(&scene.particles.grains)) {
    for (const char* key : {"sizes", "count", "region", "speed"})
      if (particles.has(key) && !replaced_by_file(particles, key))
        particles.error(key, "'" + std::string(key) + "' has no meaning when the grains come from a file",
                        "remove either it or 'file'");
    file->path = read_path(particles);
    return;
  }
  RandomFill& fill = std::get<RandomFill>(scene.particles.grains);
  const std::string meaning = "the number of grains of the FULL vessel, such as 120000";
  if (!particles.has("count")) particles.missing("count", meaning);
  fill.count = particles.integer("count", meaning, 1).value_or(0);
  fill.speed = particles.number("speed", Quantity::not_negative("a speed in m/s, such as 0.1")).value_or(0);
  read_region(particles, scene, fill);
}

}  // namespace wedge

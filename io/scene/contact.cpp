// contact.cpp: [contact] and [contact.A-B].
#include <map>
#include <optional>
#include <utility>

#include "io/scene/sections.hpp"

namespace wedge {

namespace {

struct Pair {
  int a = 0, b = 0;
};

/// The two materials a key such as "grain-wall" names; names may hold dashes themselves.
std::optional<Pair> materials_of(const Scene& scene, const std::string& key) {
  const auto index = [&](const std::string& name) {
    for (std::size_t m = 0; m < scene.materials.size(); ++m)
      if (scene.materials[m].name == name) return static_cast<int>(m);
    return -1;
  };
  for (std::size_t dash = key.find('-'); dash != std::string::npos; dash = key.find('-', dash + 1)) {
    const Pair pair{index(key.substr(0, dash)), index(key.substr(dash + 1))};
    if (pair.a >= 0 && pair.b >= 0) return pair;
  }
  return {};
}

std::vector<std::string> pair_names(const Scene& scene) {
  std::vector<std::string> names;
  for (std::size_t a = 0; a < scene.materials.size(); ++a)
    for (std::size_t b = a; b < scene.materials.size(); ++b)
      names.push_back(scene.materials[a].name + "-" + scene.materials[b].name);
  return names;
}

/// Suggests the nearest pair, in either order of its names.
std::string pair_suggestion(const Scene& scene, const std::string& key) {
  std::vector<std::string> names = pair_names(scene), both = names;
  for (std::size_t a = 0; a < scene.materials.size(); ++a)
    for (std::size_t b = a + 1; b < scene.materials.size(); ++b)
      both.push_back(scene.materials[b].name + "-" + scene.materials[a].name);
  const std::string near = suggestion(key, both);
  return near.rfind("did", 0) == 0 ? near : suggestion(key, names);
}

/// damping = c | [c_n, c_t], or restitution; exactly one, default damping = 0.3.
void read_damping(TableReader& t, Interaction& pair) {
  const Quantity ratio = Quantity::not_negative("a damping ratio, such as 0.3, or [normal, tangential]");
  pair.damping_normal = pair.damping_tangential = 0.3;
  const toml::node* node = t.node("damping");
  if (node && node->is_array()) {
    const auto both = t.numbers("damping", ratio);
    if (both && both->size() != 2)
      t.error("damping", "'damping' must be one number or [normal, tangential]", ratio.meaning);
    else if (both)
      pair.damping_normal = (*both)[0], pair.damping_tangential = (*both)[1];
  } else if (const auto one = t.number("damping", ratio)) {
    pair.damping_normal = pair.damping_tangential = *one;
  }
  const auto restitution =
      t.number("restitution", {"a coefficient of restitution above 0 and up to 1", 0, 1, false, true});
  if (!t.has("restitution")) return;
  pair.damping_normal = pair.damping_tangential = 0;
  pair.restitution = restitution;
  if (node) t.error("restitution", "both 'damping' and 'restitution' are given", "keep one of them");
}

Interaction read_pair(TableReader& t) {
  Interaction pair;
  pair.given = true;
  const Quantity sliding = Quantity::not_negative("a friction coefficient, such as 0.5");
  if (!t.has("sliding")) t.missing("sliding", sliding.meaning);
  pair.sliding = t.number("sliding", sliding).value_or(0);
  pair.rolling =
      t.length("rolling", Quantity::not_negative("a LENGTH in metres, such as 1e-4, or \"0.02 d\"")).value_or(0);
  read_damping(t, pair);
  t.finish();
  return pair;
}

void read_model(TableReader& t, ContactModel& model) {
  model.law = t.choice("law", law_names).value_or(model.law);
  model.rolling = t.choice("rolling", rolling_names).value_or(model.rolling);
  model.tension = t.choice("tension", tension_names).value_or(model.tension);
  model.rolling_velocity = t.choice("rolling_velocity", rolling_velocity_names).value_or(model.rolling_velocity);
  if (model.rolling_velocity == RollingVelocity::relative && model.rolling != RollingModel::constant_torque)
    t.error("rolling_velocity", "'rolling_velocity' only applies to rolling = \"constant_torque\"", "remove it");
  model.rolling_damping = t.number("rolling_damping", Quantity::not_negative("a damping ratio, such as 0.3"))
                              .value_or(model.rolling_damping);
  if (t.has("rolling_damping") && model.rolling != RollingModel::elastic_plastic_spring)
    t.error("rolling_damping", "'rolling_damping' only applies to rolling = \"elastic_plastic_spring\"",
            "remove it");
  model.coulomb = t.choice("coulomb", coulomb_names).value_or(model.coulomb);
  model.normal_stiffness =
      t.number("stiffness", Quantity::positive("a normal stiffness in N/m, such as 1e4")).value_or(0);
  model.contact_time =
      t.number("contact_time", Quantity::positive("the time a contact lasts in s, such as 1e-4")).value_or(0);
  model.tangential_ratio =
      t.number("tangential_ratio", Quantity::positive("tangential over normal stiffness, such as 0.2857"))
          .value_or(model.tangential_ratio);
  if (stiffness_is_given(model.law)) {
    if (t.has("stiffness") && t.has("contact_time"))
      t.error("contact_time", "both 'stiffness' and 'contact_time' are given", "keep one of them");
    if (!t.has("stiffness") && !t.has("contact_time"))
      t.missing("stiffness", "the law '" + law_names.of(model.law) + "' needs stiffness = N/m or contact_time = s");
    return;
  }
  for (const char* key : {"stiffness", "contact_time", "tangential_ratio"})
    if (t.has(key))
      t.error(key, "'" + std::string(key) + "' does not apply to the law '" + law_names.of(model.law) + "'",
              "remove it, or write law = " + law_names.choice_of(stiffness_is_given));
}

}  // namespace

void read_contact(SceneReading& reading, const toml::table& root, Scene& scene) {
  TableReader t = open_table(reading, root, "contact");
  read_model(t, scene.contact);
  const toml::table* table = root["contact"].as_table();
  if (!table) return;
  std::map<Place, std::string> pairs;  // in the order of the file
  for (auto&& [key, node] : *table)
    if (node.is_table()) pairs[place_of(key.source())] = std::string(key.str());
  std::map<int, std::string> seen;
  for (const auto& [place, key] : pairs) {
    TableReader p(reading, t.table(key), "contact." + key, "[contact." + key + "]");
    const Interaction values = read_pair(p);
    const std::optional<Pair> pair = materials_of(scene, key);
    if (!pair) {
      reading.diagnostics.error(place, "'" + key + "' is not a pair of materials", pair_suggestion(scene, key));
      continue;
    }
    const auto [first, fresh] = seen.emplace(PairTable<Interaction>::slot(pair->a, pair->b), key);
    if (!fresh)
      reading.diagnostics.error(place, "the pair '" + key + "' is already given as '" + first->second + "'",
                                "keep one of them: the order of the names does not matter");
    scene.interactions(pair->a, pair->b) = values;
    reading.places["contact." + scene.materials[static_cast<std::size_t>(pair->a)].name + "-" +
                   scene.materials[static_cast<std::size_t>(pair->b)].name + ".rolling"] = p.place("rolling");
  }
  t.finish();
}

}  // namespace wedge

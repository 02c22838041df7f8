// stages.cpp: [[stage]] and the settings: [rest], [time], [output], [start], [run].
#include <algorithm>
#include <filesystem>
#include <set>

#include "io/scene/sections.hpp"

namespace wedge {

namespace {

using Until = std::variant<UntilTime, UntilAtRest, UntilEmpty, UntilDischarged>;
const char* const until_example = "write until = 0.7 (s), \"at rest\", \"empty\" or { discharged = 1000 }";

Until read_until(TableReader& t) {
  const toml::node* node = t.node("until");
  if (!node) {
    t.missing("until", until_example);
  } else if (node->is_string()) {
    const std::string word = *node->value<std::string>();
    if (word == "at rest") return UntilAtRest{};
    if (word == "empty") return UntilEmpty{};
    const std::string near = suggestion(word, {"at rest", "empty"});
    t.error("until", "unknown end of a stage \"" + word + "\"",
            near.rfind("did you mean", 0) == 0 ? near + " Or " + until_example : until_example);
  } else if (node->is_table()) {
    TableReader inner(t.reading(), node->as_table(), t.path("until"), "'until'");
    if (!inner.has("discharged")) inner.missing("discharged", until_example);
    const auto count = inner.integer("discharged", "a number of grains of this domain", 1);
    inner.finish();
    return UntilDischarged{count.value_or(0)};
  } else if (const auto duration = t.number("until", Quantity::positive(until_example))) {
    return UntilTime{*duration};
  }
  return UntilTime{0};
}

/// Names of walls in remove or add; each must be there (or not) when the stage begins.
std::vector<std::string> read_wall_names(TableReader& t, const std::string& key, const Scene& scene,
                                         std::set<std::string>& present) {
  const bool remove = key == "remove";
  std::vector<std::string> all;
  for (const WallDescription& wall : scene.walls) all.push_back(wall.name);
  const std::vector<std::string> names =
      t.texts(key, "a list of walls: " + key + " = [\"plug\"]").value_or(std::vector<std::string>{});
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (names[i].empty()) continue;
    const Place place = t.reading().place(t.path(key) + "." + std::to_string(i));
    if (std::find(all.begin(), all.end(), names[i]) == all.end())
      t.reading().diagnostics.error(place, "unknown wall '" + names[i] + "'",
                                    all.empty() ? "the scene has no wall" : suggestion(names[i], all));
    else if (remove && present.erase(names[i]) == 0)
      t.reading().diagnostics.error(place, "the wall '" + names[i] + "' is not there to be removed",
                                    "an earlier stage removed it, or it has present = false");
    else if (!remove && !present.insert(names[i]).second)
      t.reading().diagnostics.error(place, "the wall '" + names[i] + "' is already present",
                                    "give it present = false, or remove it in an earlier stage");
  }
  return names;
}

}  // namespace

void read_stages(SceneReading& reading, const toml::table& root, Scene& scene) {
  const toml::array* list = open_tables(reading, root, "stage");
  if (!list || list->empty()) {
    if (!root.contains("stage"))
      reading.diagnostics.error({}, "the scene has no [[stage]]",
                                "add one: [[stage]] name = \"settle\" until = \"at rest\"");
    return;
  }
  std::set<std::string> names, present;
  for (const WallDescription& wall : scene.walls)
    if (wall.present) present.insert(wall.name);
  for (const toml::node& entry : *list) {
    TableReader t(reading, entry.as_table(), "stage." + std::to_string(scene.stages.size()), "[[stage]]");
    Stage stage;
    if (!t.has("name")) t.missing("name", "write name = \"settle\"");
    stage.name = t.text("name", "write name = \"settle\"").value_or("");
    if (t.has("name") && stage.name.empty()) t.error("name", "a stage needs a name", "write name = \"settle\"");
    if (!stage.name.empty() && !names.insert(stage.name).second)
      t.error("name", "another stage is named '" + stage.name + "'", "give every stage a name of its own");
    stage.remove = read_wall_names(t, "remove", scene, present);
    stage.add = read_wall_names(t, "add", scene, present);
    stage.until = read_until(t);
    stage.at_most =
        t.number("at_most", Quantity::not_negative("the longest time in s, or 0 for no bound")).value_or(0);
    stage.time_step = t.number("time_step", Quantity::positive("a time step in s, such as 2e-5"));
    t.finish();
    scene.stages.push_back(stage);
  }
}

void read_settings(SceneReading& reading, const toml::table& root, Scene& scene) {
  TableReader rest = open_table(reading, root, "rest");
  scene.rest.speed = rest.number_or_auto("speed", Quantity::positive("a speed in m/s")).value_or(0);
  scene.rest.duration = rest.number_or_auto("duration", Quantity::positive("a time in s")).value_or(0);
  rest.finish();

  TableReader time = open_table(reading, root, "time");
  scene.time_step = time.number_or_auto("step", Quantity::positive("a time step in s, such as 2e-5")).value_or(0);
  time.finish();

  TableReader out = open_table(reading, root, "output");
  Output& output = scene.output;
  output.frames_every =
      out.number("frames", Quantity::not_negative("simulated seconds between frames, 0: at stage ends"))
          .value_or(0);
  output.contacts = out.boolean("contacts").value_or(output.contacts);
  output.frames_at =
      out.numbers("at", Quantity::not_negative("a list of simulated times in s")).value_or(std::vector<double>{});
  if (const auto precision = out.choice("precision", frame_precision_names)) output.precision = *precision;
  output.series_every =
      out.number_or_auto("series", Quantity::not_negative("simulated seconds between rows")).value_or(0);
  output.checkpoint_every = out.number("checkpoints", Quantity::positive("seconds of wall time, such as 600"))
                                .value_or(output.checkpoint_every);
  output.energy_budget = out.boolean("energy_budget").value_or(output.energy_budget);
  out.finish();

  TableReader start = open_table(reading, root, "start");
  const auto from = start.text("from", "the path of a run folder or of a checkpoint");
  if (from && !from->empty()) scene.start_from = absolute_path(reading, *from, start.place("from"));
  start.finish();

  TableReader run = open_table(reading, root, "run");
  scene.run.skin =
      run.number_or_auto("skin", Quantity::not_negative("a length in m, such as \"0.1 d\""), true).value_or(0);
  scene.run.threads =
      static_cast<int>(run.integer("threads", "a number of threads, or 0 for all available", 0).value_or(0));
  if (const auto precision = run.choice("precision", precision_names)) scene.run.precision = *precision;
  run.finish();
}

std::string absolute_path(const SceneReading& reading, const std::string& path, Place place) {
  const std::filesystem::path base = place.origin == 0 ? reading.base_folder : std::string();
  return std::filesystem::absolute(base / path).lexically_normal().string();
}

}  // namespace wedge

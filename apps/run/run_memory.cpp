// run_memory.cpp: the driver's memory as text and back.
#include "apps/run/run_memory.hpp"

#include <cmath>
#include <sstream>
#include <type_traits>

#include "core/require.hpp"
#include "io/tables/csv.hpp"

namespace wedge {
namespace {

/// Calls visit(name, member) for every number of the memory: one list for both directions.
template <class Memory, class Visit>
void for_each_number(Memory& m, Visit&& visit) {
  visit("stage", m.stage);
  visit("stage_begun", m.stage_begun);
  visit("stage_start", m.stage_start);
  visit("time_step", m.time_step);
  visit("stage_start_out", m.stage_start_out);
  visit("quiet_since", m.quiet_since);
  visit("quiet_out", m.quiet_out);
  visit("series_rows", m.series_rows);
  visit("last_row", m.last_row);
  visit("regular_frames", m.regular_frames);
  visit("listed_frames", m.listed_frames);
  visit("begin_kinetic", m.begin.kinetic);
  visit("begin_rotational", m.begin.rotational);
  visit("begin_elastic_normal", m.begin.elastic_normal);
  visit("begin_elastic_tangential", m.begin.elastic_tangential);
  visit("begin_potential", m.begin.potential);
  visit("wall_seconds", m.wall_seconds);
  visit("stage_wall_seconds", m.stage_wall_seconds);
}

double number(const std::string& text, const std::string& key, const std::string& path) {
  double value = 0;
  if (parse_number(text, value) != NumberError::none)
    throw FileError(path + ": the run's memory has no number under '" + key + "'");
  return value;
}

}  // namespace

std::vector<std::pair<std::string, std::string>> RunMemory::to_text() const {
  std::vector<std::pair<std::string, std::string>> text;
  for_each_number(*this, [&](const char* name, const auto& member) {
    text.emplace_back(name, number_text(static_cast<double>(member)));
  });
  std::string times;
  for (const double t : frame_times) times += number_text(t) + " ";
  text.emplace_back("frame_times", times);
  text.emplace_back("budget_doubted", budget_doubted ? "1" : "0");
  text.emplace_back("scene_name", scene_name);
  return text;
}

RunMemory RunMemory::from_text(const std::vector<std::pair<std::string, std::string>>& text,
                               const std::string& path) {
  const auto find = [&](const std::string& key) -> const std::string& {
    for (const auto& [name, value] : text)
      if (name == key) return value;
    throw FileError(path + ": the run's memory lacks '" + key + "'");
  };
  RunMemory m;
  for_each_number(m, [&](const char* name, auto& member) {
    const double value = number(find(name), name, path);
    if (!std::is_same_v<decltype(member), double&> && !(std::fabs(value) <= 9007199254740992.0))  // 2^53
      throw FileError(path + ": the run's memory has no whole number under '" + name + "'");
    member = static_cast<std::decay_t<decltype(member)>>(value);
  });
  std::istringstream times(find("frame_times"));
  for (std::string t; times >> t;) m.frame_times.push_back(number(t, "frame_times", path));
  for (const auto& [name, value] : text) {  // these two may be missing
    if (name == "scene_name") m.scene_name = value;
    if (name == "budget_doubted") m.budget_doubted = value == "1";
  }
  return m;
}

}  // namespace wedge

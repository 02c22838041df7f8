// stages.cpp: the table of stages as text and back, and the walls at a moment.
#include "apps/results/stages.hpp"

#include <algorithm>
#include <array>
#include <filesystem>

#include "core/require.hpp"
#include "io/files/atomic_file.hpp"
#include "io/tables/csv.hpp"

namespace wedge {
namespace {

const char* const head = "stage,begin [s],end [s],ended,walls\n";
constexpr std::array<const char*, 6> end_names = {"running", "at_rest", "time", "empty", "discharged", "at_most"};

/// Names of walls, parted by semicolons; a semicolon of a name, and its escape, are doubled by a backslash.
std::string joined(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t k = 0; k < names.size(); ++k) {
    if (k > 0) text += ';';
    for (const char c : names[k]) text += (c == ';' || c == '\\' ? "\\" : "") + std::string(1, c);
  }
  return text;
}

std::vector<std::string> parted(const std::string& text) {
  std::vector<std::string> names;
  if (text.empty()) return names;
  names.emplace_back();
  for (std::size_t k = 0; k < text.size(); ++k) {
    if (text[k] == ';') {
      names.emplace_back();
      continue;
    }
    if (text[k] == '\\' && k + 1 < text.size()) ++k;
    names.back() += text[k];
  }
  return names;
}

[[noreturn]] void refuse(const std::string& path, std::size_t line, const std::string& what) {
  throw FileError(path + ":" + std::to_string(line) + ": error: " + what);
}

StageRecord record_of(const std::vector<CsvField>& fields, const std::string& path, std::size_t line) {
  if (fields.size() != 5) refuse(path, line, "expected 5 fields");
  StageRecord record;
  record.name = fields[0].text;
  for (const auto& [field, number] : {std::pair{1, &record.begin}, std::pair{2, &record.end}})
    if (parse_number(fields[static_cast<std::size_t>(field)].text, *number) != NumberError::none)
      refuse(path, line, "'" + fields[static_cast<std::size_t>(field)].text + "' is not a number");
  const auto how = std::find(end_names.begin(), end_names.end(), fields[3].text);
  if (how == end_names.end()) refuse(path, line, "'" + fields[3].text + "' is not a way to end");
  record.how = static_cast<StageEnd>(how - end_names.begin());
  record.walls = parted(fields[4].text);
  return record;
}

}  // namespace

const char* name_of(StageEnd end) { return end_names.at(static_cast<std::size_t>(end)); }

void write_stages(const std::string& path, const std::vector<StageRecord>& stages) {
  std::string text = head;
  for (const StageRecord& stage : stages) {
    text += csv_quoted(stage.name) + ',';
    append_number(text, stage.begin);
    text += ',';
    append_number(text, stage.end);
    text += std::string(",") + name_of(stage.how) + ',' + csv_quoted(joined(stage.walls)) + '\n';
  }
  write_text_file_atomically(path, text);
}

std::vector<StageRecord> read_stages(const RunFolder& folder) {
  const std::string path = folder.stages();
  if (!std::filesystem::exists(path))
    throw FileError(path + ": is missing: no stage of the run has begun, or an older wedge ran it; run it again: " +
                    "wedge run " + folder.scene() + " -o FOLDER");
  const std::string text = read_text_file(path);
  std::vector<StageRecord> stages;
  std::size_t begin = 0;
  for (std::size_t line = 1; begin < text.size(); ++line) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string row = text.substr(begin, end - begin);
    begin = end + 1;
    if (line > 1)
      stages.push_back(record_of(split_csv_line(row), path, line));
    else if (row + '\n' != head)
      refuse(path, line, "this is not a table of stages");
  }
  return stages;
}

std::vector<std::string> walls_present(const Vessel& vessel) {
  std::vector<std::string> names;
  for (int w = 0; w < vessel.wall_count(); ++w)
    if (vessel.present(w)) names.push_back(vessel.wall(w).name);
  return names;
}

Vessel vessel_at(const Scene& scene, const std::vector<StageRecord>& stages, double time) {
  Vessel vessel(scene);
  const StageRecord* last = nullptr;
  for (const StageRecord& stage : stages)
    if (last == nullptr || stage.begin < time) last = &stage;
  for (int w = 0; w < vessel.wall_count(); ++w) {
    if (last != nullptr)
      vessel.set_present(
          w, std::find(last->walls.begin(), last->walls.end(), vessel.wall(w).name) != last->walls.end());
    vessel.set_travel(w, vessel.wall(w).speed * time);
  }
  return vessel;
}

std::optional<double> opening_time(const Scene& scene, const std::vector<StageRecord>& stages) {
  for (std::size_t s = 0; s < std::min(stages.size(), scene.stages.size()); ++s)
    if (!scene.stages[s].remove.empty()) return stages[s].begin;
  return std::nullopt;
}

}  // namespace wedge

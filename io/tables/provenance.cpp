// provenance.cpp: provenance.json and progress.json.
#include "io/tables/provenance.hpp"

#include <sched.h>

#include <ctime>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "io/files/atomic_file.hpp"
#include "io/files/hdf5_file.hpp"
#include "io/tables/json.hpp"

#ifndef WEDGE_VERSION
#define WEDGE_VERSION "unknown"
#endif
#ifndef WEDGE_GIT_DESCRIBE
#define WEDGE_GIT_DESCRIBE ""
#endif
#ifndef WEDGE_COMPILER_FLAGS
#define WEDGE_COMPILER_FLAGS ""
#endif

namespace wedge {
namespace {

std::string compiler() {
#if defined(__clang__)
  return "clang " __clang_version__;
#elif defined(__GNUC__)
  return "gcc " __VERSION__;
#else
  return "unknown";
#endif
}

/// Model name of the first processor as Linux tells it, "unknown" elsewhere.
std::string processor_model() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    if (line.compare(0, 10, "model name") != 0) continue;
    const std::size_t start = line.find_first_not_of(" \t", line.find(':') + 1);
    if (start != std::string::npos) return line.substr(start);
  }
  return "unknown";
}

/// Processors this process may use.
int usable_cores() {
  cpu_set_t set;
  return sched_getaffinity(0, sizeof set, &set) == 0 ? CPU_COUNT(&set) : 0;
}

std::string utc_now() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  gmtime_r(&now, &parts);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text;
}

/// The fields of progress.json: visit(key, field). One list for writing and reading.
template <class Self, class Visit>
void for_each_field(Self& p, Visit&& visit) {
  visit("state", p.state);
  visit("stage", p.stage);
  visit("stage_number", p.stage_number);
  visit("stage_count", p.stage_count);
  visit("time", p.time);
  visit("step", p.step);
  visit("time_step", p.time_step);
  visit("grains", p.grains);
  visit("discharged", p.discharged);
  visit("wall_seconds", p.wall_seconds);
  visit("eta_seconds", p.eta_seconds);
  visit("message", p.message);
}

/// Each takes a value of its kind and returns whether it was one; `kind` says what it is.
bool take(const Json& json, std::string& value, std::string& kind) {
  kind = "a text";
  if (json.is_string()) value = json.get<std::string>();
  return json.is_string();
}
bool take(const Json& json, double& value, std::string& kind) {
  kind = "a number";
  if (json.is_number()) value = json.get<double>();
  return json.is_number() || json.is_null();  // null stands for a number that was not finite: the value stays
}
template <class Whole>
bool take(const Json& json, Whole& value, std::string& kind) {
  using Limits = std::numeric_limits<Whole>;
  kind = "a whole number from " + std::to_string(Limits::min()) + " to " + std::to_string(Limits::max());
  if (!json.is_number_integer()) return false;
  if (json.is_number_unsigned() && json.get<std::uint64_t>() > static_cast<std::uint64_t>(Limits::max()))
    return false;
  const auto number = json.get<std::int64_t>();
  if (number < Limits::min() || number > Limits::max()) return false;
  value = static_cast<Whole>(number);
  return true;
}

}  // namespace

std::string version_text() {
  const std::string description = WEDGE_GIT_DESCRIBE;
  return description.empty() ? WEDGE_VERSION : WEDGE_VERSION " (" + description + ")";
}

void write_provenance(const std::string& path, const std::vector<std::string>& command_line, int threads,
                      const std::string& precision) {
  std::vector<std::string> command = command_line;
  if (!command.empty()) command[0] = command[0].substr(command[0].find_last_of('/') + 1);
  write_text_file_atomically(path, json_text({{"program", "wedge"},
                                              {"version", WEDGE_VERSION},
                                              {"git_describe", WEDGE_GIT_DESCRIBE},
                                              {"compiler", compiler()},
                                              {"compiler_flags", WEDGE_COMPILER_FLAGS},
                                              {"hdf5", hdf5_version()},
                                              {"processor", processor_model()},
                                              {"cores", usable_cores()},
                                              {"threads", threads},
                                              {"precision", precision},
                                              {"started", utc_now()},
                                              {"command_line", command}}));
}

void write_progress(const std::string& path, const Progress& progress) {
  Json json;
  for_each_field(progress, [&](const char* key, const auto& value) { json[key] = value; });
  write_text_file_atomically(path, json_text(json));
}

Progress read_progress(const std::string& path) {
  const Json json = parse_json(read_text_file(path), path);
  if (!json.is_object()) throw_file_error(path, "is no progress file: expected a JSON object");
  Progress progress;
  for_each_field(progress, [&](const char* key, auto& value) {
    std::string kind;
    if (const auto found = json.find(key); found != json.end() && !take(*found, value, kind))
      throw_file_error(path, std::string("'") + key + "': expected " + kind);
  });
  return progress;
}

}  // namespace wedge

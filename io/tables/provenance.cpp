// provenance.cpp: provenance.json and progress.json.
#include "io/tables/provenance.hpp"

#include <sched.h>

#include <charconv>
#include <ctime>
#include <fstream>

#include "io/files/atomic_file.hpp"
#include "io/files/hdf5_file.hpp"
#include "io/tables/csv.hpp"
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

bool parse_value(const std::string& text, std::string& value) {
  value = text;
  return true;
}
bool parse_value(const std::string& text, double& value) {
  return text == "null" || parse_number(text, value) == NumberError::none;
}
template <class Whole>
bool parse_value(const std::string& text, Whole& value) {
  const char* end = text.data() + text.size();
  const auto result = std::from_chars(text.data(), end, value);
  return result.ec == std::errc{} && result.ptr == end;
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
  JsonObject object;
  object.add("program", "wedge");
  object.add("version", WEDGE_VERSION);
  object.add("git_describe", WEDGE_GIT_DESCRIBE);
  object.add("compiler", compiler());
  object.add("compiler_flags", WEDGE_COMPILER_FLAGS);
  object.add("hdf5", hdf5_version());
  object.add("processor", processor_model());
  object.add("cores", usable_cores());
  object.add("threads", threads);
  object.add("precision", precision);
  object.add("started", utc_now());
  object.add("command_line", command);
  write_text_file_atomically(path, object.text());
}

void write_progress(const std::string& path, const Progress& progress) {
  JsonObject object;
  for_each_field(progress, [&](const char* key, const auto& value) { object.add(key, value); });
  write_text_file_atomically(path, object.text());
}

Progress read_progress(const std::string& path) {
  Progress progress;
  const auto entries = parse_flat_json(read_text_file(path), path);
  for_each_field(progress, [&](const char* key, auto& value) {
    for (const auto& [name, text] : entries) {
      if (name == key && !parse_value(text, value))
        throw_file_error(path, "'" + name + "' is not a number: " + text);
    }
  });
  return progress;
}

}  // namespace wedge

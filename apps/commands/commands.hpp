// commands.hpp: the commands of the program. Each takes what the command line said and returns the exit code.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace wedge {

/// Exit codes of the program.
namespace exit_code {
inline constexpr int ok = 0, internal = 1, usage = 2, scene = 3, file = 4, physics = 5, tolerance = 6,
                     wall_time = 75, interrupted = 130;
}

struct RunArguments {
  std::string scene, folder;
  std::vector<std::string> overrides;
  int threads = 0;              // 0: what the container may use
  bool timings = false;         // print the time of each pass at the end
  double wall_time = 0;         // s; 0: no limit
  std::optional<double> until;  // s, resume only: stop (with a checkpoint) at this simulated time
  std::vector<std::string> command_line;
};
int command_run(const RunArguments&);
int command_resume(const RunArguments&);  // scene and overrides unused

int command_check(const std::string& scene, const std::vector<std::string>& overrides, int threads);
int command_status(const std::string& folder);

struct ExportArguments {
  std::string folder;
  std::optional<long> frame;  // number; default: the last
  std::string format;         // csv | vtp
  std::string output;         // file; empty: standard output for csv, a name beside the frame for vtp
  bool unfold = false;        // the n rotated copies of a sector
  bool vessel = false;        // the walls, as .vtp
};
int command_export(const ExportArguments&);

struct AnalyseArguments {
  std::string folder;
  std::optional<double> from, to;  // s
  std::vector<int> orders;    // sectors in a vessel, whose axis zones and wedges are wanted; empty: 4, 6, 8, 12
  int wedges = 0;             // cut from a full vessel for each of them
  std::optional<double> cut;  // m
  int threads = 0;            // 0: what the container may use
};
int command_analyse(const AnalyseArguments&);
/// Prints what every quantity means.
int command_definitions();

struct ReportArguments {
  std::vector<std::string> folders;      // of runs, or with runs below them
  std::vector<std::string> comparisons;  // files of `wedge compare --csv`
  std::string output;                    // empty: report/index.html in the one folder, or report.html here
  std::string title;
};
int command_report(const ReportArguments&);
int command_new(const std::string& name);

struct CompareOptions {
  std::string csv;        // file for all rows
  std::string tolerance;  // TOML file: exit code 6 where a row is outside
  std::string moment;     // only this one
};
int command_compare(const std::vector<std::string>& reference, const std::vector<std::string>& with,
                    const CompareOptions& options = {});

}  // namespace wedge

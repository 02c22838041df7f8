// status.cpp: wedge status: how far a run has got, in one line.
#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <filesystem>
#include <iostream>
#include <string>

#include "apps/commands/commands.hpp"
#include "apps/results/run_folder.hpp"
#include "apps/run/progress_line.hpp"
#include "io/scene/diagnostics.hpp"
#include "io/tables/provenance.hpp"

namespace wedge {

/// Whether a program holds the lock of the run's log.
static bool somebody_runs(const RunFolder& folder) {
  const int log = ::open(folder.log().c_str(), O_RDONLY | O_CLOEXEC);
  if (log < 0) return false;
  const bool locked = ::flock(log, LOCK_SH | LOCK_NB) != 0;
  ::close(log);
  return locked;
}

int command_status(const std::string& folder) {
  RunFolder(folder).require_run();
  if (!std::filesystem::exists(RunFolder(folder).progress())) {
    std::cout << folder << (somebody_runs(RunFolder(folder)) ? ": starting" : ": never got to its first step")
              << '\n';
    return exit_code::ok;
  }
  const Progress p = read_progress(RunFolder(folder).progress());
  std::string line = folder + ": " + p.state;
  if (p.stage_number > 0)
    line +=
        ", stage " + std::to_string(p.stage_number) + " of " + std::to_string(p.stage_count) + " (" + p.stage + ")";
  line += ", " + short_number(p.time) + " s simulated in " + std::to_string(p.step) + " steps of " +
          short_number(p.time_step) + " s, " + std::to_string(p.grains) + " grains, " +
          std::to_string(p.discharged) + " discharged, " + duration_text(p.wall_seconds) + " spent";
  if (p.state == "running" && !somebody_runs(RunFolder(folder)))
    line += ", but no process is running it; continue with: wedge resume " + folder;
  else if (p.state == "running" && p.eta_seconds >= 0)
    line += ", about " + duration_text(p.eta_seconds) + " to go";
  if (!p.message.empty()) line += ": " + p.message;
  std::cout << line << '\n';
  return exit_code::ok;
}

}  // namespace wedge

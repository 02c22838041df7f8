// run.cpp: `wedge run` and `wedge resume`.
#include <fcntl.h>
#include <sys/file.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>

#include "apps/commands/commands.hpp"
#include "apps/run/interrupt.hpp"
#include "apps/run/simulation.hpp"
#include "apps/run/threads.hpp"
#include "apps/setup/setup.hpp"
#include "core/parallel.hpp"
#include "core/require.hpp"
#include "io/files/atomic_file.hpp"
#include "io/files/checkpoint.hpp"
#include "io/scene/names.hpp"
#include "io/scene/scene_file.hpp"
#include "io/tables/provenance.hpp"
#include "kernels/passes/measure.hpp"

namespace wedge {
namespace {

namespace fs = std::filesystem;

/// Holds the run's log open and locked, so that no second program writes into the same folder.
class FolderLock {
public:
  explicit FolderLock(const RunFolder& folder) : path_(folder.log()) {
    do {
      if (descriptor_ >= 0) ::close(descriptor_);
      descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644);
      if (descriptor_ < 0) throw_file_error(path_, "cannot open", errno);
      if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0) {
        ::close(descriptor_);
        throw FileError(folder.path() + ": another wedge is running in this folder");
      }
    } while (!still_named());
  }
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;
  ~FolderLock() { ::close(descriptor_); }
  /// Empties the log.
  void empty_log() const {
    if (::ftruncate(descriptor_, 0) != 0) throw_file_error(path_, "cannot empty", errno);
  }

private:
  /// Whether the file that is locked is still the one of this name: its last owner may have removed it meanwhile.
  bool still_named() const {
    struct stat ours {};
    struct stat named {};
    return ::fstat(descriptor_, &ours) == 0 && ::stat(path_.c_str(), &named) == 0 && ours.st_ino == named.st_ino &&
           ours.st_dev == named.st_dev;
  }
  std::string path_;
  int descriptor_ = -1;
};

bool newest_valid_checkpoint_or_none(const RunFolder& folder) {
  return fs::is_directory(folder.checkpoints()) && newest_valid_checkpoint(folder.checkpoints()).has_value();
}

/// Takes back what a run that never began has put into its folder.
void clear_folder(const RunFolder& folder) {
  std::error_code ignored;
  for (const std::string& file : {folder.scene(), folder.resolved_scene(), folder.provenance(), folder.progress()})
    fs::remove(file, ignored);
  for (const std::string& sub :
       {folder.path() + "/series", folder.frames(), folder.checkpoints(), folder.results()})
    fs::remove_all(sub, ignored);
}

/// The same and the log, so that the folder can be used again.
void leave_folder(const RunFolder& folder) {
  if (newest_valid_checkpoint_or_none(folder)) return;
  clear_folder(folder);
  std::error_code ignored;
  fs::remove(folder.log(), ignored);
}

/// Makes the folder of a new run and locks it; refuses one that holds another run, unless that broke down or was
/// killed before its first step.
std::unique_ptr<FolderLock> claim_folder(const RunFolder& folder) {
  std::error_code error;
  fs::create_directories(folder.path(), error);
  if (error) throw FileError(folder.path() + ": cannot make the folder: " + error.message());
  const bool logged = fs::exists(folder.log());
  std::string mark;
  for (const std::string& file : {folder.scene(), folder.resolved_scene(), folder.log()})
    if (mark.empty() && fs::exists(file)) mark = fs::path(file).filename().string();
  if (mark.empty() || logged) {
    auto lock = std::make_unique<FolderLock>(folder);
    if (folder.failed_at_start()) {
      clear_folder(folder);
      lock->empty_log();
      return lock;
    }
    if (mark.empty() || folder.never_began()) return lock;
  }
  throw FileError(folder.path() + ": holds another run (" + mark +
                  "). Choose another folder with -o, or go on with it: wedge resume " + folder.path());
}

void print_timings(Simulation& run) {
  double total = 0;
  for (const auto& [pass, t] : run.stopwatch().times()) total += t.seconds;
  std::printf("%-20s %10s %7s %12s\n", "pass", "seconds", "share", "calls");
  for (const auto& [pass, t] : run.stopwatch().times())
    std::printf("%-20s %10.3f %6.1f%% %12lld\n", pass.c_str(), t.seconds, 100 * t.seconds / total,
                static_cast<long long>(t.calls));
}

int finish(Simulation& run, RunEnd end, const RunFolder& folder, const RunArguments& arguments) {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const State& state = run.state();
  if (arguments.timings) print_timings(run);
  std::printf(
      "%s: %lld steps, %.6g s simulated, %d grains inside, %lld out, %s precision, peak memory %.0f MB, state "
      "%016llx\n",
      folder.path().c_str(), static_cast<long long>(state.step), state.time, state.particles.count(),
      static_cast<long long>(state.taken_out), precision_names.of(state.particles.seen.precision()).c_str(),
      static_cast<double>(usage.ru_maxrss) / 1024, static_cast<unsigned long long>(state_hash(state)));
  switch (end) {
    case RunEnd::interrupted:
      std::printf("interrupted, with a checkpoint; go on with: wedge resume %s\n", folder.path().c_str());
      return exit_code::interrupted;
    case RunEnd::wall_time:
      std::printf("stopped at the wall-time limit, with a checkpoint; go on with: wedge resume %s\n",
                  folder.path().c_str());
      return exit_code::wall_time;
    case RunEnd::until:
      std::printf("stopped at %g s, with a checkpoint; go on with: wedge resume %s\n", state.time,
                  folder.path().c_str());
      break;
    case RunEnd::finished:
      break;
  }
  return exit_code::ok;
}

int choose_threads(int asked, const Scene& scene) {
  const int threads = asked > 0 ? asked : (scene.run.threads > 0 ? scene.run.threads : usable_threads());
  set_thread_count(threads);
  return threads;
}

}  // namespace

int command_run(const RunArguments& arguments) {
  Scene scene = read_scene(arguments.scene, arguments.overrides);
  require_sources(scene);
  for (const std::string& warning : scene_warnings(scene))
    std::fprintf(stderr, "%s: warning: %s\n", arguments.scene.c_str(), warning.c_str());
  const RunFolder folder(arguments.folder);
  const std::unique_ptr<FolderLock> lock = claim_folder(folder);
  const int threads = choose_threads(arguments.threads, scene);
  catch_interrupts();
  write_text_file_atomically(folder.scene(), scene.text);
  write_text_file_atomically(folder.resolved_scene(), resolved_scene(scene));
  write_provenance(folder.provenance(), arguments.command_line, threads, precision_names.of(scene.run.precision));
  const std::string no_grains = no_grains_text(scene);
  Simulation run = [&] {
    try {
      return Simulation::begin(std::move(scene), folder);
    } catch (const PhysicsError&) {
      throw;  // its crash frame and its report stay
    } catch (...) {
      leave_folder(folder);
      throw;
    }
  }();
  if (run.state().put_in == 0)
    std::fprintf(stderr, "%s: warning: %s\n", arguments.scene.c_str(), no_grains.c_str());
  const RunEnd end = run.run({arguments.wall_time, arguments.until});
  return finish(run, end, folder, arguments);
}

int command_resume(const RunArguments& arguments) {
  const RunFolder folder(arguments.folder);
  folder.require_run();
  if (folder.failed_at_start())
    throw FileError(folder.path() + ": the run broke down before its first step (" +
                    fs::path(folder.log()).filename().string() +
                    " says why); correct its start and run it again, into the same folder if you like");
  const FolderLock lock(folder);
  if (folder.never_began())
    throw FileError(folder.path() +
                    ": the run was stopped before its first step; begin it again: wedge run SCENE.toml -o " +
                    folder.path());
  Scene scene = read_scene(folder.resolved_scene(), {});
  scene.text = read_text_file(folder.scene());
  choose_threads(arguments.threads, scene);
  catch_interrupts();
  Simulation run = Simulation::resume(std::move(scene), folder);
  if (run.finished()) std::printf("already finished: nothing is left to do\n");
  const RunEnd end = run.run({arguments.wall_time, arguments.until});
  return finish(run, end, folder, arguments);
}

}  // namespace wedge

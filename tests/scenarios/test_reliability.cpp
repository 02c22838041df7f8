// test_reliability.cpp: what a full disk, a read-only disk, signals, limits, damage and a second program do to the
// real program: each ends as it should, with one clear line, and loses nothing.
#include <sys/mount.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "apps/commands/commands.hpp"
#include "io/files/atomic_file.hpp"
#include "io/files/checkpoint.hpp"
#include "io/files/hdf5_file.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/real_program.hpp"
#include "tests/support/same_run.hpp"
#include "tests/support/scratch_folder.hpp"

using namespace wedge;
using namespace wedge::test;
using Catch::Matchers::Contains;

namespace {

namespace fs = std::filesystem;

/// An undisturbed run of the little hopper, made once.
const std::string& undisturbed() {
  static const ScratchFolder scratch;
  static const std::string folder = [] {
    write_text_file_atomically(scratch / "hopper.toml", short_hopper());
    const Ended run = wedge_program({"run", scratch / "hopper.toml", "-o", scratch / "run", "-j", "1"}).wait();
    INFO(run.output);
    REQUIRE(run.code == exit_code::ok);
    return scratch / "run";
  }();
  return folder;
}

/// Whether every frame of a run opens and holds its grains.
void check_frames_readable(const std::string& run) {
  std::size_t frames = 0;
  for (const auto& entry : fs::directory_iterator(run + "/frames")) {
    if (entry.path().extension() != ".hdf") continue;
    INFO(entry.path());
    CHECK_NOTHROW(Hdf5Reader(entry.path().string()));
    ++frames;
  }
  CHECK(frames > 0);
}

/// Lines of a text.
std::size_t lines_of(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

/// Lines of what a run says on standard error but those that tell how far it is.
std::size_t complaints_of(const std::string& text) {
  std::size_t complaints = 0;  // beside the progress, and the two lines that say how to go on
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const auto begins = [&](const char* word) { return line.rfind(word, 0) == 0; };
    complaints += !begins("stage ") && !begins("settle (") && !begins("discharge (") &&
                  !begins("Last good checkpoint: ") && !begins("When the cause is gone, go on with: wedge resume ");
  }
  return complaints;
}

/// A run that was stopped in its second stage, with two checkpoints.
std::string stopped_run(const ScratchFolder& scratch) {
  const std::string folder = scratch / "run";
  write_text_file_atomically(scratch / "hopper.toml", short_hopper());
  CHECK(wedge_program({"run", scratch / "hopper.toml", "-o", folder, "-j", "1", "--wall-time", "0.000001"})
            .wait()
            .code == exit_code::wall_time);
  for (const char* until : {"0.05", "0.11"})
    CHECK(wedge_program({"resume", folder, "-j", "1", "--until", until}).wait().code == exit_code::ok);
  return folder;
}

}  // namespace

TEST_CASE("SIGTERM, SIGINT and SIGHUP end with 130 and a checkpoint, and going on is as if never stopped",
          "[reliability]") {
  const ScratchFolder scratch;
  write_text_file_atomically(scratch / "hopper.toml", short_hopper());
  for (const int signal : {SIGTERM, SIGINT, SIGHUP}) {
    const std::string folder = scratch / ("run" + std::to_string(signal));
    const Ended first = [&] {
      for (;;) {  // on a busy machine the run may be over before the signal is sent
        Program run = wedge_program({"run", scratch / "hopper.toml", "-o", folder, "-j", "1"});
        REQUIRE(run.wait_until([&] { return fs::exists(folder + "/frames/particles_000000.hdf"); }));
        run.send(signal);
        Ended ended = run.wait();
        if (ended.code != exit_code::ok) return ended;
        fs::remove_all(folder);
      }
    }();
    CHECK(first.code == exit_code::interrupted);
    CHECK_THAT(first.output, Contains("interrupted, with a checkpoint") && Contains("wedge resume " + folder));
    const Ended second = wedge_program({"resume", folder, "-j", "2"}).wait();
    CHECK(second.code == exit_code::ok);
    CHECK_THAT(second.output, Contains("state " + hash_of(undisturbed())));
    check_same_run(folder, undisturbed());
  }
}

TEST_CASE("the wall-time limit ends with 75 and a checkpoint, as often as it is met", "[reliability]") {
  const ScratchFolder scratch;
  write_text_file_atomically(scratch / "hopper.toml", short_hopper());
  const std::string folder = scratch / "run";
  Ended run =
      wedge_program({"run", scratch / "hopper.toml", "-o", folder, "-j", "1", "--wall-time", "0.02"}).wait();
  int sessions = 1;
  while (run.code == exit_code::wall_time && sessions < 1000) {
    CHECK_THAT(run.output, Contains("stopped at the wall-time limit, with a checkpoint"));
    run = wedge_program({"resume", folder, "-j", "1", "--wall-time", "0.02"}).wait();
    ++sessions;
  }
  CHECK(run.code == exit_code::ok);
  CHECK(sessions > 2);
  check_same_run(folder, undisturbed());
}

TEST_CASE("a full disk ends with 4 and one line, earlier frames are whole, and with room the run goes on",
          "[reliability]") {
  for (const char* size : {"size=150k", "size=300k", "size=450k", "size=600k", "size=800k"}) {
    const ScratchFolder scratch;
    fs::create_directory(scratch / "disk");
    const SmallDisk disk(scratch / "disk", size);
    if (!disk.mounted()) {
      WARN("skipped: this system lets nobody mount a small disk");
      return;
    }
    INFO(size);
    write_text_file_atomically(scratch / "hopper.toml", short_hopper());
    const std::string folder = scratch / "disk/run";
    const Ended run = wedge_program({"run", scratch / "hopper.toml", "-o", folder, "-j", "1"}).wait();
    INFO(run.output);
    INFO(run.errors);
    CHECK(run.code == exit_code::file);
    CHECK_THAT(run.errors, Contains("No space left on device") && Contains(folder));
    CHECK(complaints_of(run.errors) == 1);
    if (!fs::exists(folder + "/scene.toml")) continue;  // no room for a beginning: nothing is left behind
    if (fs::exists(folder + "/frames/particles_000000.hdf")) check_frames_readable(folder);
    REQUIRE(mount("tmpfs", (scratch / "disk").c_str(), "tmpfs", MS_REMOUNT, "size=50m") == 0);
    const Ended rest = wedge_program({"resume", folder, "-j", "1"}).wait();
    INFO(rest.errors);
    CHECK(rest.code == exit_code::ok);
    check_same_run(folder, undisturbed());
  }
}

TEST_CASE("a read-only disk ends with 4 and one line, for a new run and for an old one", "[reliability]") {
  const ScratchFolder scratch;
  fs::create_directory(scratch / "disk");
  const SmallDisk disk(scratch / "disk", "size=10m");
  if (!disk.mounted()) {
    WARN("skipped: this system lets nobody mount a small disk");
    return;
  }
  write_text_file_atomically(scratch / "hopper.toml", short_hopper());
  const std::string folder = scratch / "disk/run", other = scratch / "disk/other";
  REQUIRE(wedge_program({"run", scratch / "hopper.toml", "-o", folder, "-j", "1", "--wall-time", "0.000001"})
              .wait()
              .code == exit_code::wall_time);
  fs::create_directory(scratch / "disk/empty");
  REQUIRE(mount("tmpfs", (scratch / "disk").c_str(), "tmpfs", MS_REMOUNT | MS_RDONLY, "") == 0);
  const std::vector<std::vector<std::string>> commands = {
      {"run", scratch / "hopper.toml", "-o", other},
      {"run", scratch / "hopper.toml", "-o", scratch / "disk/empty"},
      {"run", scratch / "hopper.toml", "-o", folder},
      {"resume", folder},
      {"export", folder, "--to", "vtp"}};
  for (const auto& words : commands) {
    const Ended run = wedge_program(words).wait();
    INFO(words[0] << " " << words.back() << ": " << run.errors);
    CHECK(run.code == exit_code::file);
    CHECK(lines_of(run.errors) == 1);
    CHECK_THAT(run.errors, Contains("Read-only file system"));
  }
  CHECK(wedge_program({"status", folder}).wait().code == exit_code::ok);  // looking needs no right to write
  REQUIRE(mount("tmpfs", (scratch / "disk").c_str(), "tmpfs", MS_REMOUNT, "") == 0);
  CHECK(wedge_program({"resume", folder, "-j", "1"}).wait().code == exit_code::ok);
  check_same_run(folder, undisturbed());
}

TEST_CASE("a damaged checkpoint is refused and set aside, and the one before is used", "[reliability]") {
  for (const bool cut : {true, false}) {
    const ScratchFolder scratch;
    const std::string folder = stopped_run(scratch);
    const std::string newest = *newest_valid_checkpoint(folder + "/checkpoints");
    std::string bytes = read_text_file(newest);
    if (cut) {
      bytes.resize(bytes.size() / 2);
    } else {
      bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 4);
    }
    std::ofstream(newest, std::ios::binary) << bytes;
    const std::string before = *newest_valid_checkpoint(folder + "/checkpoints");
    CHECK(before != newest);
    const Ended run = wedge_program({"resume", folder, "-j", "1"}).wait();
    CHECK(run.code == exit_code::ok);
    CHECK_THAT(run.errors, Contains(newest + ": damaged, set aside; going back to " + before));
    CHECK(fs::exists(newest + ".damaged"));
    check_same_run(folder, undisturbed());
  }
  const ScratchFolder scratch;
  const std::string folder = stopped_run(scratch);
  for (const auto& entry : fs::directory_iterator(folder + "/checkpoints")) fs::resize_file(entry.path(), 700);
  const Ended run = wedge_program({"resume", folder, "-j", "1"}).wait();
  CHECK(run.code == exit_code::file);
  CHECK_THAT(run.errors, Contains("no valid checkpoint to resume from"));
}

TEST_CASE("what a program killed in writing leaves behind harms nobody and goes", "[reliability]") {
  const ScratchFolder scratch;
  const std::string folder = stopped_run(scratch);
  // The next frame half written under its own and under its final name (a disk that lies about what it has synced).
  std::size_t next = 0;
  while (fs::exists(RunFolder(folder).frame("particles", static_cast<std::int64_t>(next)))) ++next;
  const std::string frame = RunFolder(folder).frame("particles", static_cast<std::int64_t>(next));
  std::ofstream(frame + ".part") << "half a fra";
  std::ofstream(frame) << "half a fra";
  std::ofstream(folder + "/checkpoints/checkpoint_000000009999.hdf.part") << "half a check";
  std::ofstream(folder + "/progress.json.part") << "{\"sta";
  std::ofstream(folder + "/frames/particles.hdf.series.part") << "{";
  CHECK(wedge_program({"status", folder}).wait().code == exit_code::ok);
  CHECK(wedge_program({"resume", folder, "-j", "1"}).wait().code == exit_code::ok);
  check_same_run(folder, undisturbed());
  for (const auto& entry : fs::recursive_directory_iterator(folder)) CHECK(entry.path().extension() != ".part");
}

TEST_CASE("two programs in one folder: the second is refused with 4, the first knows nothing of it",
          "[reliability]") {
  const ScratchFolder scratch;
  write_text_file_atomically(scratch / "hopper.toml", short_hopper());
  const std::string folder = scratch / "run";
  Program first = wedge_program({"run", scratch / "hopper.toml", "-o", folder, "-j", "1"});
  REQUIRE(first.wait_until([&] { return fs::exists(folder + "/scene.resolved.toml"); }));
  first.send(SIGSTOP);  // so that it is still there when the others come
  const Ended second = wedge_program({"run", scratch / "hopper.toml", "-o", folder, "-j", "1"}).wait();
  const Ended third = wedge_program({"resume", folder, "-j", "1"}).wait();
  first.send(SIGCONT);
  for (const Ended& refused : {second, third}) {
    CHECK(refused.code == exit_code::file);
    CHECK_THAT(refused.errors, Contains(folder + ": another wedge is running in this folder"));
    CHECK(lines_of(refused.errors) == 1);
  }
  CHECK(first.wait().code == exit_code::ok);
  check_same_run(folder, undisturbed());
  const Ended late = wedge_program({"run", scratch / "hopper.toml", "-o", folder, "-j", "1"}).wait();
  CHECK(late.code == exit_code::file);
  CHECK_THAT(late.errors, Contains("holds another run"));
  check_same_run(folder, undisturbed());
}

TEST_CASE("a run killed before its first checkpoint may begin again in its folder", "[reliability]") {
  const ScratchFolder scratch;
  write_text_file_atomically(scratch / "hopper.toml", short_hopper());
  const std::string folder = scratch / "run";
  for (const char* sub : {"", "/series", "/frames", "/checkpoints", "/results"}) fs::create_directory(folder + sub);
  for (const char* file : {"/run.log", "/scene.toml", "/scene.resolved.toml", "/series/energies.csv"})
    std::ofstream(folder + file) << "";
  std::ofstream(folder + "/checkpoints/checkpoint_000000000000.hdf.part") << "half a check";
  CHECK_THAT(wedge_program({"status", folder}).wait().output, Contains("never got to its first step"));
  const Ended refused = wedge_program({"resume", folder}).wait();
  CHECK(refused.code == exit_code::file);
  CHECK_THAT(refused.errors, Contains("stopped before its first step") && Contains("wedge run"));
  CHECK(wedge_program({"run", scratch / "hopper.toml", "-o", folder, "-j", "1"}).wait().code == exit_code::ok);
  check_same_run(folder, undisturbed());
}

TEST_CASE("a folder with a scene but no run is left alone", "[reliability]") {
  const ScratchFolder scratch;
  fs::create_directory(scratch / "mine");
  write_text_file_atomically(scratch / "mine/scene.toml", short_hopper());
  const Ended refused =
      wedge_program({"run", scratch / "mine/scene.toml", "-o", scratch / "mine", "-j", "1"}).wait();
  CHECK(refused.code == exit_code::file);
  CHECK_THAT(refused.errors, Contains("holds another run (scene.toml)"));
  CHECK(fs::directory_iterator(scratch / "mine") != fs::directory_iterator());
  CHECK(read_text_file(scratch / "mine/scene.toml") == short_hopper());
  CHECK_FALSE(fs::exists(scratch / "mine/run.log"));
}

TEST_CASE("a start deep in a wall or in another grain ends with 5 and one line that names it", "[reliability]") {
  const auto row = [](const char* id, const char* place) {
    return std::string(id) + "," + place + ",0,0,0,0,0,0\n";
  };
  struct Start {
    const char *place, *axis, *says;
  };
  for (const Start& start : {Start{"0.0185,0.001,0.05", "clamp", "overlaps the wall 'shell' by"},
                             Start{"0.01,0.001,0.0015", "clamp", "overlaps the wall 'floor' by"},
                             Start{"0.0001,0.0001,0.05", "line", "overlaps the wall 'axis line' by"},
                             Start{"0,0,0.05", "line", "overlaps the wall 'axis line' by 0.0025 m"},
                             Start{"0.0055,0.001,0.05", "hollow", "overlaps the wall 'inner cylinder' by"},
                             Start{"0.01,0.003,0.103", "clamp", "overlap by"}}) {
    INFO(start.says);
    const ScratchFolder scratch;
    write_text_file_atomically(scratch / "start.csv",
                               "id,x,y,z,vx,vy,vz,wx,wy,wz\n" + row("0", "0.01,0.003,0.1") + row("1", start.place));
    std::vector<std::string> words{"run",   WEDGE_SOURCE_DIR "/tests/scenarios/hard_cases/pot.toml",
                                   "-o",    scratch / "run",
                                   "-j",    "1",
                                   "--set", "domain.angle=60",
                                   "--set", "particles.file=" + (scratch / "start.csv"),
                                   "--set", "domain.axis=" + std::string(start.axis)};
    if (words.back() == "domain.axis=hollow") words.insert(words.end(), {"--set", "domain.inner_radius=0.004"});
    const Ended run = wedge_program(words).wait();
    INFO(run.errors);
    CHECK(run.code == exit_code::physics);
    CHECK_THAT(run.errors, Contains("grain") && Contains(start.says) && Contains("Likely cause"));
  }
}

TEST_CASE("missing files and a full standard output end with 4 and one line", "[reliability]") {
  const ScratchFolder scratch;
  write_text_file_atomically(scratch / "hopper.toml", short_hopper());
  for (const auto& words : std::vector<std::vector<std::string>>{{"run", scratch / "no.toml", "-o", scratch / "r"},
                                                                 {"check", scratch / "no.toml"},
                                                                 {"resume", scratch / "no"},
                                                                 {"run", scratch.path(), "-o", scratch / "r"}}) {
    const Ended run = wedge_program(words).wait();
    INFO(run.errors);
    CHECK(run.code == exit_code::file);
    CHECK(lines_of(run.errors) == 1);
  }
  if (!fs::exists("/dev/full")) return;
  const Ended full = wedge_program({"new", "hopper"}, "/dev/full").wait();
  CHECK(full.code == exit_code::file);
  CHECK_THAT(full.errors, Contains("standard output: cannot write"));
}

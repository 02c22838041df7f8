// same_run.hpp: whether two folders hold the same run to the byte, and a short run to compare.
#pragma once

#include <cstdio>
#include <filesystem>
#include <set>
#include <string>

#include "apps/results/run_folder.hpp"
#include "apps/setup/setup.hpp"
#include "io/files/atomic_file.hpp"
#include "io/files/checkpoint.hpp"
#include "io/scene/scene_file.hpp"
#include "kernels/passes/measure.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/little_hopper.hpp"

namespace wedge::test {

/// The little hopper with a shorter life, many frames and many checkpoints: a third of a second.
inline std::string short_hopper() {
  std::string text = little_hopper;
  const auto replace = [&](const std::string& what, const std::string& by) {
    const std::size_t at = text.find(what);
    REQUIRE(at != std::string::npos);
    text.replace(at, what.size(), by);
  };
  replace("z = [0, 0.26]", "z = [0, 0.1]");
  replace("until = 0.15", "until = 0.08");
  replace("until = 0.4", "until = 0.12");
  replace("frames = 0.05\nseries = 0.01", "frames = 0.02\nseries = 0.002\ncheckpoints = 0.01");
  return text;
}

/// Hash of the state in the last checkpoint of a run.
inline std::string hash_of(const std::string& run) {
  const RunFolder folder(run);
  State state = make_domain(read_scene(folder.resolved_scene(), {}));
  const auto newest = newest_valid_checkpoint(folder.checkpoints());
  REQUIRE(newest.has_value());
  read_checkpoint(*newest, state);
  char text[32];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(state_hash(state)));
  return text;
}

/// Files of a folder of a run that must not depend on when and how often it was stopped.
inline std::set<std::string> lasting_files(const std::string& run) {
  std::set<std::string> names;
  for (const char* sub : {"series", "frames", "results"}) {
    for (const auto& entry : std::filesystem::directory_iterator(run + "/" + sub))
      names.insert(std::string(sub) + "/" + entry.path().filename().string());
  }
  names.erase("results/beds.csv");  // tells the wall time
  return names;
}

/// CHECKs that two folders hold the same run: state, series, frames and pictures, byte for byte.
inline void check_same_run(const std::string& a, const std::string& b) {
  CHECK(hash_of(a) == hash_of(b));
  const std::set<std::string> names = lasting_files(a);
  CHECK(names == lasting_files(b));
  for (const std::string& name : names) {
    INFO(name);
    const bool same =
        std::filesystem::exists(b + "/" + name) && read_text_file(a + "/" + name) == read_text_file(b + "/" + name);
    CHECK(same);
  }
}

}  // namespace wedge::test

// walls_at.cpp: replays what the stages of a run did to its walls.
#include "apps/run/walls_at.hpp"

#include <filesystem>

#include "apps/run/bed_table.hpp"
#include "apps/setup/setup.hpp"

namespace wedge {

Vessel walls_at(const Scene& scene, const RunFolder& folder, double time) {
  Vessel vessel = make_domain(scene).vessel;
  std::vector<StageResult> finished;
  if (std::filesystem::exists(folder.beds())) finished = read_bed_table(folder.beds());
  for (std::size_t s = 0; s < scene.stages.size(); ++s) {
    if (s > 0) {  // begun when the one before was finished, before `time`
      if (finished.size() < s || finished[s - 1].quantities.empty()) break;
      if (!(finished[s - 1].quantities.front().value < time)) break;
    }
    for (const std::string& name : scene.stages[s].remove) vessel.set_present(vessel.wall_index(name), false);
    for (const std::string& name : scene.stages[s].add) vessel.set_present(vessel.wall_index(name), true);
  }
  for (int w = 0; w < vessel.wall_count(); ++w) vessel.set_travel(w, vessel.wall(w).speed * time);
  return vessel;
}

}  // namespace wedge

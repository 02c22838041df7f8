// analysed_run.cpp: opens a run for analysis and reads its beds, frame by frame.
#include "apps/analysis/analysed_run.hpp"

#include <cmath>
#include <filesystem>

#include "core/require.hpp"
#include "core/state.hpp"
#include "io/files/frame.hpp"
#include "io/scene/scene_file.hpp"

namespace wedge {

AnalysedRun describe_run(const RunFolder& folder, Scene scene, double diameter) {
  const Symmetry symmetry = make_domain(scene).symmetry;
  AnalysedRun run(describe_domain(std::move(scene), symmetry, diameter), folder);
  if (!std::isfinite(run.radius))
    throw FileError(folder.path() + ": the scene has no walls; a vessel is needed to analyse a run");
  return run;
}

AnalysedRun open_run(const std::string& folder) {
  const RunFolder files(folder);
  files.require_run();
  const std::string start = files.frame("particles", 0);
  if (!std::filesystem::exists(start)) throw FileError(files.frames() + ": holds no frames of grains to analyse");
  const Particles first = read_particle_frame(start).particles;
  double sum = 0;
  for (Index i = 0; i < first.count(); ++i) sum += 2 * first.radius[static_cast<std::size_t>(i)];
  if (first.count() == 0) throw FileError(files.path() + ": the run has no grains at its start");
  AnalysedRun run = describe_run(files, read_scene(files.resolved_scene(), {}), sum / first.count());
  run.stages = read_stages(files);
  return run;
}

Bed read_bed(const AnalysedRun& run, std::int64_t number) {
  ParticleFrame frame = read_particle_frame(run.folder.frame("particles", number));
  State state = make_domain(run.scene);
  state.vessel = vessel_at(run.scene, run.stages, frame.header.time);
  state.particles = std::move(frame.particles);
  const std::string contact_file = run.folder.frame("contacts", number);
  if (!std::filesystem::exists(contact_file)) return bed_of_frame(run, state, nullptr);
  const ContactFrame contacts = read_contact_frame(contact_file);
  return bed_of_frame(run, state, &contacts);
}

}  // namespace wedge

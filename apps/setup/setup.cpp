// setup.cpp: fills, reads or takes over the grains a run starts with.
#include "apps/setup/setup.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>

#include "apps/results/run_folder.hpp"
#include "core/require.hpp"
#include "core/time_scales.hpp"
#include "io/files/checkpoint.hpp"
#include "io/scene/names.hpp"
#include "io/scene/scene_file.hpp"
#include "io/tables/state_csv.hpp"
#include "kernels/fill.hpp"
#include "kernels/law_passes.hpp"
#include "kernels/neighbours/neighbour_list.hpp"

namespace wedge {
namespace {

/// A state file holds the grains of the whole vessel or of one sector; those outside the domain are an error.
void read_grains(State& state, const Scene& scene, const StateFile& file) {
  const StateCsvDefaults defaults{0.5 * file.diameter, file.material};
  state.particles = read_state_csv(file.path, defaults, grain_material_names(scene.materials));
  Particles& p = state.particles;
  for (Index i = 0; i < p.count(); ++i) {
    const auto s = static_cast<std::size_t>(i);
    const Vec3 x = p.position.get(s);
    std::ostringstream text;
    if (state.symmetry.turns_home(x) != 0) {
      text << file.path << ": grain " << p.id[s] << " at (" << x.x << ", " << x.y << ", " << x.z
           << ") m lies outside the sector or slot. Cut the state to the domain, or run the full vessel.";
      throw SceneError(text.str());
    }
    const bool at_axis = std::hypot(x.x, x.y) < 2 * p.radius[s] * axis_resolution;
    if (at_axis && scene.domain.kind == DomainKind::sector && needs_way_to_axis(scene.domain.axis)) {
      text << file.path << ": grain " << p.id[s] << " lies on the axis, where axis = \""
           << axis_names.of(scene.domain.axis)
           << "\" gives it copies of itself at its own place. Move it, or use axis = \""
           << axis_names.of(Domain().axis) << "\".";
      throw SceneError(text.str());
    }
  }
  complete_grains(p, scene.materials, p.count() > 0 ? 2 * p.radius[0] : 1);
  state.put_in = p.count();
}

/// Gives grains that were counted by the materials of the run in `from` their places among those of `scene`.
void rename_materials(Particles& p, const CheckpointExtra& from, const Scene& scene, const std::string& path) {
  const std::vector<std::string> there =
      grain_material_names(parse_scene(from.resolved_scene, path, {}, "").materials);
  const std::vector<std::string> here = grain_material_names(scene.materials);
  for (auto& material : p.material) {
    if (material < 0 || static_cast<std::size_t>(material) >= there.size())
      throw FileError(path + ": a grain has a material that its own scene has not");
    const std::string& name = there[static_cast<std::size_t>(material)];
    const auto place = std::find(here.begin(), here.end(), name);
    if (place == here.end())
      throw SceneError("start.from: '" + path + "' holds grains of the material '" + name +
                       "', which the scene lacks. Add [material." + name + "] and its contacts.");
    material = static_cast<std::int32_t>(place - here.begin());
  }
}

/// Another run's grains with their contacts; clock, ledgers and walls are this run's own.
void take_over(State& state, const Scene& scene) {
  std::string file = scene.start_from;
  if (std::filesystem::is_directory(file)) {
    const std::string folder =
        std::filesystem::is_directory(RunFolder(file).checkpoints()) ? RunFolder(file).checkpoints() : file;
    const auto newest = newest_valid_checkpoint(folder);
    if (!newest) throw FileError(folder + ": holds no valid checkpoint to start from");
    file = *newest;
  }
  rename_materials(state.particles, read_checkpoint(file, state), scene, file);
  const State fresh = make_domain(scene);
  for (int w = 0; w < state.vessel.wall_count(); ++w) {
    state.vessel.set_present(w, fresh.vessel.present(w));
    state.vessel.set_travel(w, 0);
  }
  state.energy = EnergyLedger{};
  state.time = 0;
  state.step = 0;
  state.list_builds = 0;
  state.put_in = state.particles.count();
  state.taken_out = 0;
  state.next_id = 0;
  NeighbourList::expire(state);
}

}  // namespace

void require_fit(const State& state, const Scene& scene, const std::string& path) {
  const Particles& p = state.particles;
  const auto unknown = [&](std::int32_t m) {
    return m < 0 || static_cast<std::size_t>(m) >= scene.materials.size();
  };
  if (std::any_of(p.material.begin(), p.material.end(), unknown))
    throw FileError(path + ": a grain has a material that the scene has not");
  const bool listed = !state.list_expired;  // else the first step makes its list anew
  if (listed && has_couples(needed_friction(scene)) && state.contacts.couple.size() != state.contacts.first.size())
    throw FileError(path + ": the contacts lack the rolling couples that the scene asks for");
}

/// Refuses a start with grains outside the widest wall: they would fall past the vessel and count as discharged.
static void refuse_grains_outside(const State& state) {
  const Particles& p = state.particles;
  for (std::size_t i = 0; i < static_cast<std::size_t>(p.count()); ++i) {
    const Vec3 x = p.position.get(i);
    if (!state.vessel.beside(x, 0)) continue;
    std::ostringstream text;
    text << "grain " << p.id[i] << " starts outside the vessel, at (" << x.x << ", " << x.y << ", " << x.z
         << ") m. Make particles.region narrower, or correct the state file.";
    throw SceneError(text.str());
  }
}

State make_start(const Scene& scene) {
  State state = make_domain(scene);
  if (!scene.start_from.empty()) {
    take_over(state, scene);
  } else if (const auto* file = std::get_if<StateFile>(&scene.particles.grains)) {
    read_grains(state, scene, *file);
  } else {
    fill_at_random(state, scene, std::get<RandomFill>(scene.particles.grains));
  }
  refuse_grains_outside(state);
  describe_grains(state);
  return state;
}

std::string no_grains_text(const Scene& scene) {
  const auto* file = std::get_if<StateFile>(&scene.particles.grains);
  const std::string source = !scene.start_from.empty() ? "start.from: '" + scene.start_from + "'"
                             : file                    ? "particles.file: '" + file->path + "'"
                                                       : "particles.count: this sector's share";
  return source + " holds no grains: the run starts empty; check that this is meant";
}

double stage_time_step(const Scene& scene, const State& state, const Stage& stage) {
  if (stage.time_step) return *stage.time_step;
  if (scene.time_step > 0) return scene.time_step;
  double shortest = std::numeric_limits<double>::infinity();  // the smallest grain really there decides
  for (std::size_t i = 0; i < static_cast<std::size_t>(state.particles.count()); ++i)
    shortest =
        std::min(shortest, rayleigh_time(state.particles.radius[i],
                                         scene.materials[static_cast<std::size_t>(state.particles.material[i])]));
  const bool by_grains = std::isfinite(shortest) && !stiffness_is_given(scene.contact.law);
  const double step = by_grains ? automatic_part(scene) * shortest : chosen_time_step(scene);
  if (!(step > 0))
    throw SceneError(
        "time.step = \"auto\": no grain is there, or none of known size, to choose a time step by; give it in "
        "seconds, "
        "such as step = 1e-5");
  return step;
}

}  // namespace wedge

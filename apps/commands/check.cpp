// check.cpp: wedge check: what a scene means, and what running it will take.
#include <cmath>
#include <iostream>
#include <optional>

#include "apps/commands/commands.hpp"
#include "apps/commands/sector_error.hpp"
#include "apps/results/text_table.hpp"
#include "apps/run/progress_line.hpp"
#include "apps/run/threads.hpp"
#include "apps/setup/setup.hpp"
#include "core/restitution.hpp"
#include "core/time_scales.hpp"
#include "io/scene/diagnostics.hpp"
#include "io/scene/names.hpp"
#include "io/scene/scene_file.hpp"
#include "kernels/time_step.hpp"

namespace wedge {
namespace {

// What the estimates assume, as measured on dense beds of equal grains.
constexpr double bytes_per_grain = 1200;    // memory: grain, near pairs, images, scratch, while a bed collapses
constexpr double bytes_in_any_case = 20e6;  // memory: program and libraries
constexpr double steps_per_core_second = 12e6, mixed_steps_per_core_second = 18e6;  // grains times steps
constexpr double frame_bytes = 52;               // per grain, packed, single precision
constexpr double contact_bytes = 58;             // per contact, packed, single precision
constexpr double contacts_per_grain = 2.5;       // half of a coordination number of 5
constexpr double double_precision_factor = 2.2;  // doubles are longer and pack less well
constexpr double checkpoint_bytes = 550;         // per grain
constexpr double series_row_bytes = 640;         // a row of energies, ledger and walls together

std::string text_of(std::int64_t number) { return std::to_string(number); }
std::string four_digits(double value) { return short_number(std::round(1e4 * value) / 1e4); }

void print_pairs(const Scene& scene) {
  TextTable table;
  table.row({"pair", "sliding", "rolling [m]", "damping normal", "tangential", "restitution", "given"});
  const ContactModel& model = scene.contact;
  for (int a = 0; a < scene.interactions.kinds(); ++a) {
    for (int b = a; b < scene.interactions.kinds(); ++b) {
      const Interaction& pair = scene.interactions(a, b);
      const std::string name = scene.materials[static_cast<std::size_t>(a)].name + "-" +
                               scene.materials[static_cast<std::size_t>(b)].name;
      if (!pair.given) {
        table.row({name, "not given"});
        continue;
      }
      const double asked = pair.restitution ? damping_for(model.law, model.tension, *pair.restitution) : 0;
      const double normal = pair.restitution ? asked : pair.damping_normal;
      const double tangential = pair.restitution ? asked : pair.damping_tangential;
      const double restitution =
          pair.restitution ? *pair.restitution : restitution_of(model.law, model.tension, pair.damping_normal);
      table.row({name, short_number(pair.sliding), short_number(pair.rolling), four_digits(normal),
                 four_digits(tangential), four_digits(restitution), pair.restitution ? "restitution" : "damping"});
    }
  }
  std::cout << "\nPairs of materials\n"
            << table.text("  ")
            << "  Restitution of a head-on impact, whatever its speed, and damping follow from one another"
            << (model.tension == Tension::none ? " (tension = \"none\")" : "") << ", as dt goes to 0.\n";
}

/// Speeds [m/s] at which grains may meet: 0.1 m/s, and that of a fall through the fill region.
std::vector<double> meeting_speeds(const Scene& scene) {
  std::vector<double> speeds = {0.1};
  if (const auto* fill = std::get_if<RandomFill>(&scene.particles.grains)) {
    const double fall = std::sqrt(2 * scene.domain.gravity.norm() * (fill->z_high - fill->z_low));
    if (fall > 0) speeds.push_back(fall);
  }
  return speeds;
}

void print_time_step(const Scene& scene, double step, const std::string& name) {
  std::cout << "  " << name << ": " << short_number(step) << " s";
  const StepScale scale = step_scale(scene);
  if (!(scale.time > 0)) {
    std::cout << " (not compared: grain sizes are in the particle file)\n";
    return;
  }
  std::cout << " = " << short_number(100 * step / scale.time) << " % of the " << scale.name << " time, "
            << short_number(scale.time) << " s\n";
  if (!is_hertzian(scene.contact.law)) return;
  for (const double speed : meeting_speeds(scene)) {
    const double contact = collision_time(scene, speed);
    std::cout << "    a collision at " << short_number(std::round(speed * 1000) / 1000) << " m/s lasts "
              << short_number(contact) << " s = " << short_number(std::round(10 * contact / step) / 10)
              << " steps\n";
  }
}

void print_time_steps(const Scene& scene) {
  std::cout << "\nTime step\n";
  print_time_step(scene, chosen_time_step(scene), scene.time_step > 0 ? "of the scene" : "auto");
  for (const Stage& stage : scene.stages)
    if (stage.time_step) print_time_step(scene, *stage.time_step, "stage " + stage.name);
}

/// Grains in this domain. Those of another run or of a file are read as for a run, and refused as by one.
std::int64_t grains_here(const Scene& scene) {
  const auto* fill = std::get_if<RandomFill>(&scene.particles.grains);
  if (!fill || !scene.start_from.empty()) {
    State state = make_start(scene);
    TimeStep step(scene, state);
    if (scene.start_from.empty()) step.start(state, stage_time_step(scene, state, scene.stages.front()));
    return state.particles.count();
  }
  return std::llround(static_cast<double>(fill->count) / scene.domain.order);
}

void print_axis(const Domain& domain) {
  const bool cylinder = is_cylinder(domain.axis);
  if (!cylinder && (domain.kind != DomainKind::sector || domain.sides != Sides::periodic)) {
    std::cout << "  axis: no rule is needed here\n";
    return;
  }
  std::cout << "  axis: " << axis_names.of(domain.axis) << ": " << traits_of(domain.axis).meaning;
  if (cylinder) std::cout << "; its radius is " << short_number(domain.inner_radius) << " m";
  std::cout << '\n';
}

void print_domain(const Scene& scene, std::int64_t grains) {
  const Domain& domain = scene.domain;
  std::cout << "\nDomain\n  ";
  if (domain.kind == DomainKind::full) std::cout << "the full vessel";
  if (domain.kind == DomainKind::slot) std::cout << "a slot, " << short_number(domain.slot_width) << " m wide";
  if (domain.kind == DomainKind::sector)
    std::cout << "a sector of " << short_number(360.0 / domain.order) << " degrees, one of " << domain.order;
  if (domain.kind != DomainKind::full) std::cout << ", sides " << sides_names.of(domain.sides);
  std::cout << '\n';
  if (domain.kind == DomainKind::sector) {
    const auto* fill = std::get_if<RandomFill>(&scene.particles.grains);
    const bool filled = fill && scene.start_from.empty();
    std::cout << "  grains: " << text_of(filled ? fill->count : grains * domain.order) << " in the full vessel, "
              << text_of(grains) << " in this sector\n";
  } else {
    std::cout << "  grains: " << text_of(grains) << '\n';
  }
  print_axis(domain);
  if (const auto expected = expected_errors(scene))
    std::cout << "  expected deviations from the full vessel (apps/study/README.md): "
              << expectation_text(*expected) << '\n';
}

/// Simulated time [s] the stages can take; `exact` where a time ends them all, else bounds. Nothing without bound.
std::optional<double> simulated_time(const Scene& scene, bool& exact) {
  double total = 0;
  exact = true;
  for (const Stage& stage : scene.stages) {
    if (const auto* until = std::get_if<UntilTime>(&stage.until)) {
      total += stage.at_most > 0 ? std::min(stage.at_most, until->duration) : until->duration;
    } else if (stage.at_most > 0) {
      total += stage.at_most;
      exact = false;
    } else {
      return std::nullopt;
    }
  }
  return total;
}

/// Time steps the stages can take. Pre: every stage is bounded.
double steps_of(const Scene& scene) {
  double steps = 0;
  for (const Stage& stage : scene.stages) {
    const auto* until = std::get_if<UntilTime>(&stage.until);
    double duration = until ? until->duration : stage.at_most;
    if (until && stage.at_most > 0) duration = std::min(duration, stage.at_most);
    steps += duration / stage.time_step.value_or(chosen_time_step(scene));
  }
  return steps;
}

void print_disk(const Scene& scene, double grains, double time, const char* at_most) {
  const Output& output = scene.output;
  const double number = output.precision == FramePrecision::double_precision ? double_precision_factor : 1;
  double frames = 1 + static_cast<double>(scene.stages.size());
  for (const double t : output.frames_at) frames += t <= time ? 1 : 0;
  if (output.frames_every > 0) frames += std::floor(time / output.frames_every);
  const double rows = output.series_every > 0 ? time / output.series_every : 200 * time;
  const double contacts = output.contacts ? frames * grains * contacts_per_grain * contact_bytes * number : 0;
  const std::int64_t checkpoints = 2 + static_cast<std::int64_t>(scene.stages.size());
  std::cout << "  disk: " << at_most << text_of(std::llround(frames)) << " frames of grains, "
            << size_text(frames * grains * frame_bytes * number) << "; contacts "
            << (output.contacts ? size_text(contacts) : "none") << "; series " << size_text(rows * series_row_bytes)
            << "; " << text_of(checkpoints) << " checkpoints (the last two, one for each stage) "
            << size_text(static_cast<double>(checkpoints) * grains * checkpoint_bytes) << '\n';
}

void print_costs(const Scene& scene, double grains, int threads) {
  const int used = threads > 0 ? threads : scene.run.threads > 0 ? scene.run.threads : usable_threads();
  std::cout << "\nCost (estimates)\n  memory: " << size_text(bytes_in_any_case + grains * bytes_per_grain)
            << " (assumes " << size_text(bytes_in_any_case) << " and " << size_text(bytes_per_grain)
            << " per grain with its contacts and images in a dense bed that collapses)\n";
  bool exact = true;
  const std::optional<double> time = simulated_time(scene, exact);
  if (!time) {
    std::cout << "  disk and wall time: unknown, since a stage has no time limit (at_most)\n";
    return;
  }
  const char* const at_most = exact ? "" : "at most ";
  print_disk(scene, grains, *time, at_most);
  const double step = chosen_time_step(scene);
  if (!(step > 0)) {
    std::cout << "  wall time: unknown until the grain sizes are known\n";
    return;
  }
  const double steps = steps_of(scene);
  const bool mixed = scene.run.precision == Precision::mixed;
  const double rate = mixed ? mixed_steps_per_core_second : steps_per_core_second;
  std::cout << "  wall time: " << at_most << duration_text(steps * grains / (rate * used)) << " on " << used
            << (used == 1 ? " thread" : " threads") << " (" << short_number(*time) << " s simulated, "
            << text_of(std::llround(steps)) << " steps; assumes " << short_number(rate)
            << " particle-steps per second and core" << (mixed ? ", in mixed precision" : "") << ")\n";
}

}  // namespace

int command_check(const std::string& scene_file, const std::vector<std::string>& overrides, int threads) {
  const Scene scene = read_scene(scene_file, overrides);
  require_sources(scene);
  std::cout << resolved_scene(scene);
  print_pairs(scene);
  print_time_steps(scene);
  const std::int64_t grains = grains_here(scene);
  print_domain(scene, grains);
  print_costs(scene, static_cast<double>(grains), threads);
  std::vector<std::string> warnings = scene_warnings(scene);
  if (const auto warning = expectation_warning(scene)) warnings.push_back(*warning);
  if (grains == 0) warnings.push_back(no_grains_text(scene));
  std::cout << (warnings.empty() ? "\nNo warnings.\n" : "\nWarnings\n");
  for (const std::string& warning : warnings) std::cout << "  " << warning << '\n';
  return exit_code::ok;
}

}  // namespace wedge

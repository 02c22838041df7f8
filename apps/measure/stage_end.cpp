// stage_end.cpp: the numbers of a bed at the end of a stage, with loads on walls and weights.
#include "apps/measure/stage_end.hpp"

#include <cmath>
#include <limits>

#include "apps/measure/bed_numbers.hpp"
#include "kernels/passes/measure.hpp"

namespace wedge {
namespace {

/// Mass of all grains of the whole vessel [kg].
double mass_in_vessel(const State& state) {
  double mass = 0;
  for (Index i = 0; i < state.particles.count(); ++i)
    mass += state.weight(i) * state.particles.mass[static_cast<std::size_t>(i)];
  return mass;
}

}  // namespace

StageResult measure_stage_end(const State& state, const MeasuredDomain& domain, const FinishedStage& stage,
                              const std::vector<Crossing>& crossings) {
  const Part whole = whole_part(domain);
  const std::vector<Scalar> numbers = bed_numbers(domain, bed_of_run(domain, state), whole);
  StageResult result{stage.name, {}};
  const auto add = [&](const char* name, double value) {
    result.quantities.push_back({name, quantity(name).unit, value});
  };
  const auto add_number = [&](const char* name) { add(name, value_of(numbers, name)); };
  add("time", state.time);
  add_number("grains");
  add("grains_discharged", static_cast<double>(state.taken_out) * domain.order);
  add_number("packing");
  add_number("cn");
  const std::vector<WallLoad> loads = wall_loads(state);
  for (int w = 0; w < state.vessel.wall_count(); ++w)
    result.quantities.push_back({wall_load_name(state.vessel.wall(w).name), quantity("wall_load").unit,
                                 0 - loads[static_cast<std::size_t>(w)].force.z * domain.order});
  add("weight_of_grains", mass_in_vessel(state) * std::abs(domain.scene.domain.gravity.z()));
  add("kinetic_energy_per_grain",
      state.particles.count() > 0 ? mean_kinetic_energy(state) : std::numeric_limits<double>::quiet_NaN());
  add_number("bed_height");
  add("discharge_rate", discharge_rate(crossings, whole, stage.begin, state.time).value);
  add_number("angle_of_repose");
  add("wall_time", stage.wall_seconds);
  return result;
}

}  // namespace wedge

// law_passes.hpp: the passes that depend on the contact law, with all types chosen: one call each per step.
#pragma once

#include <functional>

#include "core/scene.hpp"
#include "core/state.hpp"
#include "kernels/laws/friction.hpp"
#include "kernels/passes/force_sums.hpp"

namespace wedge {

struct ElasticEnergy {
  double normal = 0, tangential = 0;  // J
};

using ContactPass = std::function<void(State&, const ReactionMap&, ForceSums&, double dt)>;

/// What varies from scene to scene; every member is chosen before the first step and calls a loop without options.
struct LawPasses {
  ContactPass evaluate_contacts;
  std::function<void(State&, ForceSums&, double dt)> evaluate_walls;
  std::function<Vec3Array(const State&)> contact_forces;  // see contact_forces.hpp
  /// Elastic energy of all contacts for which `counts(slot of a grain)` holds for either grain; every contact if
  /// empty.
  std::function<ElasticEnergy(const State&, const std::function<bool(Index)>& counts)> elastic_energy;
};

/// The least of friction that the scene's contacts need.
Friction needed_friction(const Scene& scene);

/// The passes of the scene's law. Pre: as make_law_passes.
LawPasses choose_law_passes(const Scene& scene, const State& state, Friction friction, bool uniform);

/// Those of one law, compiled in a file that CMake makes of law_passes.cpp.in. Pre: all grains of `state` stay as
/// uniform as they are now: `uniform` says that radius and material are one.
template <class Law>
LawPasses make_law_passes(const Scene& scene, const State& state, Friction friction, bool uniform);

/// Its pass over contacts between grains, in the width `Number`, compiled in one made of contact_pass.cpp.in.
template <class Law, class Number>
ContactPass make_contact_pass(const PairTable<typename Law::Coefficients>& table, const Scene& scene,
                              const State& state, Friction friction, bool uniform);

}  // namespace wedge

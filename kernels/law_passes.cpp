// law_passes.cpp: which law, and how much of friction, a scene asks for.
#include "kernels/law_passes.hpp"

#include <optional>

#include "core/contact_laws.hpp"
#include "core/require.hpp"
#include "kernels/laws/total_coulomb.hpp"

namespace wedge {

Friction needed_friction(const Scene& scene) {
  bool slides = false, rolls = false;
  for (const Interaction& pair : scene.interactions.entries()) {
    slides = slides || pair.sliding > 0;
    rolls = rolls || pair.rolling > 0;
  }
  if (rolls && scene.contact.rolling == RollingModel::elastic_plastic_spring) return Friction::spring;
  if (rolls && scene.contact.rolling == RollingModel::constant_torque)
    return scene.contact.rolling_velocity == RollingVelocity::relative ? Friction::relative : Friction::rolling;
  return slides ? Friction::sliding : Friction::none;
}

LawPasses choose_law_passes(const Scene& scene, const State& state, Friction friction, bool uniform) {
  std::optional<LawPasses> passes;
  for_each_law([&](const auto& entry) {
    using Law = typename std::decay_t<decltype(entry)>::Law;
    if (entry.law != scene.contact.law) return;
    passes = scene.contact.coulomb == Coulomb::total
                 ? make_law_passes<TotalCoulomb<Law>>(scene, state, friction, uniform)
                 : make_law_passes<Law>(scene, state, friction, uniform);
  });
  require(passes.has_value(), "the law of the scene is not in core/contact_laws.hpp");
  return *passes;
}

}  // namespace wedge

// state.cpp: the state of a scene before there are grains.
#include "core/state.hpp"

namespace wedge {

State make_domain(const Scene& scene) {
  State state;
  if (scene.domain.sides == Sides::periodic) {
    if (scene.domain.kind == DomainKind::sector) state.symmetry = Symmetry::rotation(scene.domain.order);
    if (scene.domain.kind == DomainKind::slot) state.symmetry = Symmetry::translation(scene.domain.slot_width);
  }
  state.vessel = Vessel(scene);
  state.copies = copies_in_vessel(scene.domain);
  return state;
}

}  // namespace wedge

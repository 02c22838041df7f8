// test_state.cpp: what a state is before there are grains.
#include "core/state.hpp"

#include "tests/support/catch.hpp"

using namespace wedge;

TEST_CASE("a grain stands for as many of the whole vessel as there are copies of the domain", "[weight]") {
  Scene scene;
  CHECK(make_domain(scene).weight(0) == 1);
  scene.domain.kind = DomainKind::slot;
  scene.domain.slot_width = 0.1;
  CHECK(make_domain(scene).weight(0) == 1);
  scene.domain.kind = DomainKind::sector;
  scene.domain.order = 7;
  for (const Sides sides : {Sides::periodic, Sides::rigid, Sides::frictionless}) {
    scene.domain.sides = sides;
    const State state = make_domain(scene);
    CHECK(state.weight(3) == 7);
    CHECK(state.symmetry.order() == (sides == Sides::periodic ? 7 : 1));
  }
}

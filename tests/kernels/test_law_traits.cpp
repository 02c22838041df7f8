// test_law_traits.cpp: what core/contact_laws.hpp says of each law against what the law does.
#include <cmath>
#include <set>
#include <string>

#include "core/contact_laws.hpp"
#include "kernels/laws/hertz_mindlin.hpp"
#include "kernels/laws/linear_law.hpp"
#include "kernels/laws/mindlin_deresiewicz.hpp"
#include "tests/support/catch.hpp"

using namespace wedge;

namespace {

/// Elastic energy [J] of two grains of this stiffness at this overlap [m].
template <class Law>
double energy(ContactLaw law, double young, double spring, double overlap) {
  const Material m{"grain", 2500, young, 0.3};
  Interaction pair;
  pair.sliding = 0.5;
  ContactModel model;
  model.law = law;
  model.normal_stiffness = spring;
  return Law::normal_energy(Law::prepare(m, m, pair, model), 0.001, 1e-5, overlap);
}

}  // namespace

TEST_CASE("the traits of a law are those of its normal force", "[laws]") {
  std::set<std::string> names;
  for_each_law([&](const auto& entry) {
    using Law = typename std::decay_t<decltype(entry)>::Law;
    INFO(entry.name);
    CHECK(names.insert(entry.name).second);
    const double here = energy<Law>(entry.law, 1e7, 1e4, 1e-5);
    CHECK(energy<Law>(entry.law, 1e7, 1e4, 2e-5) / here ==
          Approx(std::pow(2, is_hertzian(entry.law) ? 2.5 : 2)).epsilon(1e-12));
    const bool given = stiffness_is_given(entry.law);
    CHECK(energy<Law>(entry.law, 2e7, 1e4, 1e-5) / here == Approx(given ? 1 : 2).epsilon(1e-12));
    CHECK(energy<Law>(entry.law, 1e7, 2e4, 1e-5) / here == Approx(given ? 2 : 1).epsilon(1e-12));
  });
  CHECK(names.size() == std::tuple_size_v<decltype(contact_laws)>);
}

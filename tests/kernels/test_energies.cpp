// test_energies.cpp: the energies and sliding losses of the laws, against the work of their own forces.
//
// history_coupling is defined as what is left of the budget's tangential part (time_step.cpp), so a residual of
// zero says nothing about tangential_energy and sliding_loss: these tests do.
#include "kernels/laws/hertz_mindlin.hpp"
#include "kernels/laws/linear_law.hpp"
#include "kernels/laws/mindlin_deresiewicz.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/experiment.hpp"

using namespace wedge;
using namespace wedge::test;

namespace {

constexpr double mu = 0.4, effective_radius = 0.0011, effective_mass = 2e-4;
const Vec3 along{0.6, 0.8, 0};

ContactModel model_of(ContactLaw law) {
  ContactModel model;
  model.law = law;
  model.normal_stiffness = 2e4;
  model.tangential_ratio = 0.7;
  return model;
}

/// A law with the coefficients of two different materials.
template <class Law>
struct Bench {
  typename Law::Coefficients coefficients = [] {
    Interaction contact;
    contact.sliding = mu;
    contact.damping_normal = contact.damping_tangential = 0.3;
    return Law::prepare({"soft", 3800, 1e7, 0.3}, {"hard", 2500, 4e7, 0.2}, contact, model_of(ContactLaw::linear));
  }();

  ContactResponse respond(double overlap, double length) const {
    return Law::respond(coefficients,
                        ContactInput{overlap, effective_radius, effective_mass, 0, {}, length * along});
  }
  double normal_energy(double overlap) const {
    return Law::normal_energy(coefficients, effective_radius, effective_mass, overlap);
  }
  double tangential_energy(double overlap, double length) const {
    return Law::tangential_energy(coefficients, effective_radius, effective_mass, overlap, length);
  }
  /// The length at which it slides [m]: what is left of one far too long.
  double limit(double overlap) const { return norm(respond(overlap, overlap).displacement); }
};

/// Integral from 0 to `end` by the midpoint rule.
template <class Function>
double integral(double end, const Function& f) {
  constexpr int parts = 20000;
  double sum = 0;
  for (int k = 0; k < parts; ++k) sum += f((k + 0.5) * end / parts);
  return sum * end / parts;
}

}  // namespace

TEMPLATE_TEST_CASE("the elastic energies of a law are the work of its elastic forces", "[energies]",
                   MindlinDeresiewicz, HertzMindlin, LinearLaw) {
  // E_n(dn) = int f_cn d dn; E_t(s) = -int f_ct . d delta at a fixed overlap, below the limit.
  const Bench<TestType> law;
  for (const double overlap : {1e-6, 3e-5}) {
    CHECK(law.normal_energy(overlap) ==
          Approx(integral(overlap, [&](double x) { return law.respond(x, 0).elastic_normal; })).epsilon(1e-7));
    const double limit = law.limit(overlap);
    CHECK(limit > 0);
    CHECK(limit < 0.9 * overlap);
    for (const double part : {0.2, 0.7, 0.9999})
      CHECK(law.tangential_energy(overlap, part * limit) ==
            Approx(integral(part * limit, [&](double s) {
              return -dot(law.respond(overlap, s).elastic_tangential, along);
            })).epsilon(1e-7));
  }
}

TEMPLATE_TEST_CASE("sliding loses mu_s f_cn times the way beyond the limit, and the rest of the work is stored",
                   "[energies]", MindlinDeresiewicz, HertzMindlin, LinearLaw) {
  const Bench<TestType> law;
  const double overlap = 2e-5, limit = law.limit(overlap), load = law.respond(overlap, 0).elastic_normal;
  const int steps = 10000;
  const double slip = 5 * limit / steps;
  Vec3 displacement, force;
  double work = 0, lost = 0;
  for (int k = 1; k <= steps; ++k) {  // as the contact pass does: slip, then the law, which cuts the displacement
    const ContactResponse out = TestType::respond(
        law.coefficients,
        ContactInput{overlap, effective_radius, effective_mass, 0, {}, displacement + slip * along});
    work -= 0.5 * slip * dot(force + out.elastic_tangential, along);
    lost += out.sliding_loss;
    displacement = out.displacement;
    force = out.elastic_tangential;
    if (k * slip < 0.999 * limit) CHECK(out.sliding_loss < 1e-12 * load * slip);
  }
  CHECK(norm(displacement) == Approx(limit).epsilon(1e-12));
  CHECK(lost == Approx(mu * load * (5 * limit - limit)).epsilon(1e-9));
  CHECK(work == Approx(lost + law.tangential_energy(overlap, limit)).epsilon(1e-6));
}

namespace {

// Grains of so much mass that no force moves them: a contact whose overlap and slip are given.
constexpr double R = 0.0025, heavy = 1e15, overlap = 2e-5;  // m, kg/m3, m

Scene immovable(ContactLaw law) {
  Scene s = plain_scene(1e7, 0.3, heavy, mu);
  s.contact = model_of(law);
  return s;
}

/// The energy budget of an experiment whose only contact slides at `speed` [m/s] from the start.
void check_sliding(Experiment& e, ContactLaw law, double effective, double speed, double dt) {
  const double young = 1e7 / (2 * (1 - 0.09));
  const double load =
      law == ContactLaw::linear ? 2e4 * overlap : 4.0 / 3.0 * young * std::sqrt(effective * overlap) * overlap;
  CHECK(e.begin.elastic_normal ==
        Approx((law == ContactLaw::linear ? 1.0 / 2 : 2.0 / 5) * load * overlap).epsilon(1e-6));
  CHECK(e.begin.elastic_tangential == 0);
  const int half = 2000;
  e.run(half);
  const double lost = e.state.energy.sliding, work = e.state.energy.tangential_work;
  e.run(half);
  const double way = half * dt * speed;
  CHECK(lost > 0);
  CHECK(e.state.energy.sliding - lost == Approx(mu * load * way).epsilon(1e-6));
  CHECK(e.state.energy.tangential_work - work == Approx(mu * load * way).epsilon(1e-6));
  CHECK(e.state.energy.tangential_damping == Approx(0).margin(1e-12));
  // At constant overlap what is stored is what was done and not lost.
  const Energies now = e.step.energies(e.state);
  CHECK(now.elastic_tangential > 0);
  CHECK(std::fabs(history_coupling(e.state.energy, e.begin, now)) < 5e-3 * now.elastic_tangential);
}

}  // namespace

TEST_CASE("the ledger's sliding loss is mu_s N times the way: two grains, and a grain on a plate", "[energies]") {
  for (const ContactLaw law : {ContactLaw::mindlin_deresiewicz, ContactLaw::hertz_mindlin, ContactLaw::linear}) {
    const double dt = 1e-6, speed = 0.05;
    CAPTURE(static_cast<int>(law));
    {  // radii R and 1.5 R, spinning about z, which is perpendicular to their normal: slip l_i w_i + l_j w_j
      const double far = 2.5 * R - overlap, li = R - 0.5 * overlap, lj = 1.5 * R - 0.5 * overlap, w = 4;
      Experiment e(
          immovable(law),
          {{R, {0, 0, 0}, {}, {0, 0, w}}, {1.5 * R, {0.6 * far, 0.8 * far, 0}, {}, {0, 0, (speed - li * w) / lj}}},
          dt);
      check_sliding(e, law, R * 1.5 * R / (2.5 * R), speed, dt);
    }
    {
      Scene s = immovable(law);
      add_wall(s, "plate", {{0, 0}, {10, 0}});
      Experiment e(s, {{R, {1.5, 2.5, R - overlap}, {0.6 * speed, 0.8 * speed, 0}, {}}}, dt);
      check_sliding(e, law, R, speed, dt);
    }
  }
}

TEST_CASE("slip to roll costs the energy of the slip, half the reduced mass times its square", "[energies]") {
  // Rigid sphere: the slip u has the reduced mass 1 / (1/m + l^2/I) = m / (1 + 5 l^2 / (2 R^2)), 2/7 m for l = R.
  for (const ContactLaw law : {ContactLaw::mindlin_deresiewicz, ContactLaw::hertz_mindlin, ContactLaw::linear}) {
    CAPTURE(static_cast<int>(law));
    const double g = 9.81, u = 0.2;
    Scene s = plain_scene(1e7, 0.3, 3800, mu);  // undamped: friction is loaded within a few steps
    s.contact = model_of(law);
    add_wall(s, "plate", {{0, 0}, {10, 0}});
    s.domain.gravity = {0, 0, -g};
    const double m = sphere_mass(R, 3800), young = 1e7 / (2 * (1 - 0.09)), weight = m * g;
    const double dn =
        law == ContactLaw::linear ? weight / 2e4 : std::pow(weight / (4.0 / 3.0 * young * std::sqrt(R)), 2.0 / 3.0);
    Experiment e(s, {{R, {1.5, 2.5, R - dn}, {u, 0, 0}, {}}}, 2e-6);
    e.run(static_cast<int>(1.5 * 2 * u / (7 * mu * g) / 2e-6));
    const double l = R - dn, cost = 0.5 * m * u * u / (1 + 2.5 * l * l / (R * R));
    CHECK(e.state.energy.sliding == Approx(cost).epsilon(3e-3));
  }
}

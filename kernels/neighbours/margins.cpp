// margins.cpp: how far each grain may move before the neighbour list is made anew.
#include "core/parallel.hpp"
#include "kernels/neighbours/neighbours.hpp"

namespace wedge {
namespace {

struct Speeds {
  double sum = 0, largest = 0;  // m/s
  double smallest_radius = 1e300;
};

constexpr double widest_margin = 0.3;  // radii: the most that a fast grain's margin may be
constexpr double longest_list = 200;   // steps
// Steps until the list is renewed if every grain keeps its speed: balances the work of a list, shared by the steps
// it lasts, against the pairs that wider margins bring in. An estimate (perf/README.md, "Margins").
constexpr double list_work_over_pair_work = 0.75;

}  // namespace

void choose_margins(State& state, double smallest, double dt) {
  Particles& p = state.particles;
  const Index n = p.count();
  const Speeds speeds = reduce_blocks(
      n, Speeds{},
      [&](Index begin, Index end) {
        Speeds r;
        for (Index i = begin; i < end; ++i) {
          const auto s = static_cast<std::size_t>(i);
          const double v = norm(p.velocity.get(s));
          r.sum += v;
          r.largest = std::max(r.largest, v);
          r.smallest_radius = std::min(r.smallest_radius, p.radius[s]);
        }
        return r;
      },
      [](Speeds a, const Speeds& b) {
        return Speeds{a.sum + b.sum, std::max(a.largest, b.largest),
                      std::min(a.smallest_radius, b.smallest_radius)};
      });
  if (n == 0) return;
  const double diameter = 2 * speeds.smallest_radius;
  const double mean_way = speeds.sum / n * dt / diameter + 1e-12;  // diameters per step
  const double largest_way = speeds.largest * dt / speeds.smallest_radius + 1e-12;
  const double steps =
      std::min({std::sqrt(list_work_over_pair_work / mean_way), widest_margin / largest_way, longest_list});
  for_each(n, [&](Index i) {
    const auto s = static_cast<std::size_t>(i);
    p.list_margin[s] = smallest + steps * dt * norm(p.velocity.get(s));
    p.reference.set(s, p.position.get(s));
  });
  state.wall_margin = state.vessel.fastest_wall() * dt * steps;
  state.wall_travel = 0;
}

}  // namespace wedge

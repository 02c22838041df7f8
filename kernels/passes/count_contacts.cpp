// count_contacts.cpp: how many contacts each grain has now, for couples that share out what can stop a grain.
#include "kernels/passes/count_contacts.hpp"

namespace wedge {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

}  // namespace

void count_contacts(State& state) {
  ContactTable& c = state.contacts;
  const Particles& p = state.particles;
  const ImageMap& images = state.images;
  const WallContactTable& w = state.wall_contacts;
  const Index n = p.count();
  c.contact_count.assign(at(n + images.count()), 0);
  // Row after row by one thread: cheap beside what the couples cost, and only a comparison needs it.
  for (std::size_t k = 0; k < c.first.size(); ++k) {
    if (!(row_overlap(state, k) > 0)) continue;
    const Index i = c.first[k], j = row_partner(state, k).grain;
    ++c.contact_count[at(i)];
    if (!row_is_shared(state, k)) ++c.contact_count[at(j)];  // half a turn away it is the same contact
  }
  for (std::size_t g = 0; g < w.grain.size(); ++g) {
    const std::size_t i = at(w.grain[g]);
    for (std::size_t k = at(w.begin[g]); k < at(w.begin[g + 1]); ++k) {
      const WallProximity near = state.vessel.proximity(w.feature[k], p.position.get(i));
      c.contact_count[i] += near.minimum && near.distance < p.radius[i] && state.vessel.active(w.feature[k]);
    }
  }
  for (Index m = 0; m < images.count(); ++m) c.contact_count[at(n + m)] = c.contact_count[at(images.owner[at(m)])];
}

}  // namespace wedge

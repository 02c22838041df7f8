// count_contacts.cpp: how many contacts each grain has now, for couples that share out what can stop a grain.
#include "kernels/count_contacts.hpp"

#include "core/parallel.hpp"

namespace wedge {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

bool touches(const State& state, Index row) {
  const Particles& p = state.particles;
  const std::size_t i = at(state.contacts.first[at(row)]), j = at(state.contacts.second[at(row)]);
  const Vec3 d = p.position.get(j) - p.position.get(i);
  return std::sqrt(dot(d, d)) < p.radius[i] + p.radius[j];
}

Index incoming(const State& state, Index slot) {
  const ContactTable& c = state.contacts;
  Index n = 0;
  for (Index m = c.incoming_begin[at(slot)]; m < c.incoming_begin[at(slot) + 1]; ++m)
    n += touches(state, c.incoming[at(m)]);
  return n;
}

}  // namespace

void count_contacts(State& state) {
  ContactTable& c = state.contacts;
  const Particles& p = state.particles;
  const ImageMap& images = state.images;
  const WallContactTable& w = state.wall_contacts;
  const Index n = p.count();
  c.contact_count.resize(at(n + images.count()));
  for_each(n, [&](Index i) {
    Index count = incoming(state, i);
    for (Index k = c.row_begin[at(i)]; k < c.row_begin[at(i) + 1]; ++k) count += touches(state, k);
    c.contact_count[at(i)] = count;
  });
  for (Index m = 0; m < images.count(); ++m) c.contact_count[at(images.owner[at(m)])] += incoming(state, n + m);
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

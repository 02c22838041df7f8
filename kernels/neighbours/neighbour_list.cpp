// neighbour_list.cpp: the order in which a list is made; grains put in and taken out.
#include "kernels/neighbours/neighbour_list.hpp"

#include <algorithm>
#include <limits>

#include "core/parallel.hpp"
#include "core/require.hpp"

namespace wedge {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

/// Makes room for `more` slots between the grains and their images, in a field that has slots of `images` images.
template <class Field>
void open_gap(Field& field, std::size_t grains, std::size_t images, std::size_t more) {
  field.resize(grains + images + more);
  std::move_backward(field.begin() + static_cast<std::ptrdiff_t>(grains),
                     field.begin() + static_cast<std::ptrdiff_t>(grains + images), field.end());
}
void open_gap(SeenTable& seen, std::size_t grains, std::size_t images, std::size_t more) {
  seen.resize(grains + images + more);
  for (std::size_t m = images; m-- > 0;) seen.set(grains + more + m, seen.get(grains + m));
}

/// Images, and the rows that name them, move on by `more` slots; the new slots of grains have no rows.
void move_images(State& state, Index more) {
  Particles& p = state.particles;
  ContactTable& c = state.contacts;
  const Index n = p.count();
  const std::size_t images = at(state.images.count());
  for (Index& second : c.second)
    if (second >= n) second += more;
  if (!c.row_begin.empty()) c.row_begin.resize(c.row_begin.size() + at(more), c.rows());
  for (Array<double>* field : {&p.position.x, &p.position.y, &p.position.z, &p.radius, &p.mass})
    open_gap(*field, at(n), images, at(more));
  open_gap(p.material, at(n), images, at(more));
  open_gap(p.seen, at(n), images, at(more));
}

std::int32_t next_id(const State& state) {
  require(state.next_id <= std::numeric_limits<std::int32_t>::max(), "there are no numbers left for new grains");
  return static_cast<std::int32_t>(state.next_id);
}

void put(State& state, std::size_t slot, const NewGrain& g) {
  Particles& p = state.particles;
  p.position.set(slot, g.position);
  p.reference.set(slot, g.position);
  p.velocity.set(slot, g.velocity);
  p.angular_velocity.set(slot, g.angular_velocity);
  p.radius[slot] = g.radius;
  p.mass[slot] = g.mass;
  p.material[slot] = g.material;
  p.layer[slot] = g.layer;
  p.id[slot] = g.id.value_or(next_id(state));
  state.next_id = std::max(state.next_id, std::int64_t{p.id[slot]} + 1);
  state.alike = state.alike && g.radius == p.radius[0] && g.material == p.material[0];
}

}  // namespace

void NeighbourList::start(State& state, double dt) {
  show_grains(state.particles, 0);
  check_motion(state, dt);
  renew(state, dt);
}

void NeighbourList::renew(State& state, double dt) {
  set_contacts_aside(state, scratch_);
  wrap(state, scratch_);
  choose_margins(state, smallest_margin_, dt);
  sort_by_cell(state, scratch_);
  make_images(state, rules_.axis);
  find_contacts(state, scratch_, rules_);
  find_wall_contacts(state, scratch_);
  ++state.list_builds;
  state.list_expired = false;
  map_reactions(state, rules_.axis, map_);
}

void NeighbourList::insert(State& state, const std::vector<NewGrain>& grains) {
  if (grains.empty()) return;
  Particles& p = state.particles;
  const auto more = static_cast<Index>(grains.size());
  const Index n = p.count();
  for (const NewGrain& g : grains)
    require(!g.id || std::find(p.id.begin(), p.id.end(), *g.id) == p.id.end(), "a grain with this id is there");
  move_images(state, more);
  Particles::for_each_field(p, [&](const FieldInfo&, auto& field) {
    if (field.size() < at(n + more)) field.resize(at(n + more));
    std::fill_n(field.begin() + n, more, 0);
  });
  for (Index k = 0; k < more; ++k) put(state, at(n + k), grains[at(k)]);
  show_grains(p, n);
  state.put_in += more;
  expire(state);
}

void NeighbourList::remove(State& state, const std::vector<Index>& slots) {
  scratch_.leaves.assign(at(state.particles.count()), 0);
  for (const Index i : slots) scratch_.leaves[at(i)] = 1;
  state.taken_out += static_cast<std::int64_t>(slots.size());
  expire(state);
}

void show_grains(Particles& p, Index from) {
  for (Index i = from; i < p.count(); ++i) {
    const std::size_t s = at(i);
    p.seen.set(s, {p.position.get(s), p.radius[s], p.velocity.get(s), p.mass[s], p.angular_velocity.get(s),
                   static_cast<double>(p.material[s])});
  }
}

}  // namespace wedge

// images.cpp: the image pass: which grains have copies across the periodic faces, and moving these along.
#include <vector>

#include "core/parallel.hpp"
#include "kernels/neighbours/neighbours.hpp"

namespace wedge {
namespace {

/// Turns at which copies may act: every one where every copy acts or a grain is held on the axis, the next ones
/// otherwise.
std::vector<int> acting_turns(const Symmetry& symmetry, AxisRule axis) {
  if (symmetry.kind() == Symmetry::Kind::translation) return {-1, 1};
  const bool every = every_copy_acts(axis) || holds_on_axis(axis);
  std::vector<int> turns;
  for (int k = 1; k < symmetry.order(); ++k) {
    const int residue = symmetry.residue(k);
    if (every || residue == 1 || residue == -1) turns.push_back(residue);
  }
  std::sort(turns.begin(), turns.end());
  return turns;
}

template <class Array_>
void resize_with_room(Array_& array, std::size_t n) {
  if (n > array.capacity()) array.reserve(n + n / 16 + 64);
  array.resize(n);
}

template <class Number>
void refresh(State& state) {
  Particles& p = state.particles;
  const ImageMap& images = state.images;
  const Symmetry& symmetry = state.symmetry;
  SeenOf<Number>* const seen = p.seen.data<Number>();
  const Index n = p.count();
  for_each(images.count(), [&](Index m) {
    const auto image = static_cast<std::size_t>(n + m),
               owner = static_cast<std::size_t>(images.owner[static_cast<std::size_t>(m)]);
    const int k = images.turn[static_cast<std::size_t>(m)];
    const SeenOf<Number>& original = seen[owner];
    SeenOf<Number>& copy = seen[image];
    copy = original;
    copy.position = symmetry.turn_point(original.position, k);
    copy.velocity = in_width<Number>(symmetry.turn_vector(in_width<double>(original.velocity), k));
    copy.angular_velocity = in_width<Number>(symmetry.turn_vector(in_width<double>(original.angular_velocity), k));
    p.position.set(image, copy.position);
  });
}

}  // namespace

void make_images(State& state, AxisRule axis) {
  ImageMap& images = state.images;
  images.clear();
  Particles& p = state.particles;
  const Index n = p.count();
  if (state.symmetry.periodic()) {
    double widest = 0;  // reach of the partner with the widest reach
    for (Index i = 0; i < n; ++i)
      widest = std::max(widest, p.radius[static_cast<std::size_t>(i)] + p.list_margin[static_cast<std::size_t>(i)]);
    const std::vector<int> turns = acting_turns(state.symmetry, axis);
    for (Index i = 0; i < n; ++i) {
      const auto s = static_cast<std::size_t>(i);
      const double reach = widest + p.radius[s] + p.list_margin[s];
      const Vec3 x = p.position.get(s);
      if (state.symmetry.distance_to_face(x) > reach) continue;
      if (held_on_axis(axis, x.x, x.y, p.radius[s])) continue;  // its copies act on nobody
      for (const int k : turns) {
        if (state.symmetry.distance_to_domain(x, k) > reach) continue;
        images.owner.push_back(i);
        images.turn.push_back(k);
      }
    }
  }
  const auto slots = static_cast<std::size_t>(n + images.count());
  for (Array<double>* component : {&p.position.x, &p.position.y, &p.position.z})
    resize_with_room(*component, slots);
  resize_with_room(p.seen, slots);
  resize_with_room(p.radius, slots);
  resize_with_room(p.mass, slots);
  resize_with_room(p.material, slots);
  for (Index m = 0; m < images.count(); ++m) {
    const auto image = static_cast<std::size_t>(n + m),
               owner = static_cast<std::size_t>(images.owner[static_cast<std::size_t>(m)]);
    p.radius[image] = p.radius[owner];
    p.mass[image] = p.mass[owner];
    p.material[image] = p.material[owner];
  }
  refresh_images(state);
}

void refresh_images(State& state) {
  if (state.particles.seen.precision() == Precision::mixed)
    refresh<float>(state);
  else
    refresh<double>(state);
}

}  // namespace wedge

// images.cpp: the image pass: which grains have copies across the periodic faces, and moving these along.
#include <vector>

#include "core/parallel.hpp"
#include "kernels/integrate.hpp"
#include "kernels/neighbours.hpp"

namespace wedge {
namespace {

/// Turns at which copies may act: every one for exact symmetry and for a grain pinned to the axis, the next ones
/// otherwise.
std::vector<int> acting_turns(const Symmetry& symmetry, AxisRule axis) {
  if (symmetry.kind() == Symmetry::Kind::translation) return {-1, 1};
  const bool every = meets_itself(axis) || axis == AxisRule::pin;
  std::vector<int> turns;
  for (int k = 1; k < symmetry.order(); ++k) {
    const int residue = symmetry.residue(k);
    if (every || residue == 1 || residue == -1) turns.push_back(residue);
  }
  std::sort(turns.begin(), turns.end());
  return turns;
}

template <class T>
void resize_with_room(Array<T>& array, std::size_t n) {
  if (n > array.capacity()) array.reserve(n + n / 16 + 64);
  array.resize(n);
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
      if (axis == AxisRule::pin && on_axis(x.x, x.y, p.radius[s])) continue;  // its copies act on nobody
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
  Particles& p = state.particles;
  const ImageMap& images = state.images;
  const Symmetry& symmetry = state.symmetry;
  const Index n = p.count();
  for_each(images.count(), [&](Index m) {
    const auto image = static_cast<std::size_t>(n + m),
               owner = static_cast<std::size_t>(images.owner[static_cast<std::size_t>(m)]);
    const int k = images.turn[static_cast<std::size_t>(m)];
    const Seen& original = p.seen[owner];
    Seen& copy = p.seen[image];
    copy = original;
    copy.position = symmetry.turn_point(original.position, k);
    copy.velocity = symmetry.turn_vector(original.velocity, k);
    copy.angular_velocity = symmetry.turn_vector(original.angular_velocity, k);
    p.position.set(image, copy.position);
  });
}

}  // namespace wedge

// wrap_and_sort.cpp: bring grains home through the periodic faces, and order them by cell.
#include <cmath>
#include <numeric>
#include <sstream>

#include "core/parallel.hpp"
#include "core/require.hpp"
#include "kernels/neighbours/neighbours.hpp"

namespace wedge {
namespace {

struct Box {
  Vec3 low, high;
};

Box bounding_box(const Vec3Array& x, Index n) {
  const double far = 1e300;
  return reduce_blocks(
      n, Box{{far, far, far}, {-far, -far, -far}},
      [&](Index begin, Index end) {
        Box b{{far, far, far}, {-far, -far, -far}};
        for (Index i = begin; i < end; ++i) {
          const Vec3 p = x.get(static_cast<std::size_t>(i));
          b.low = {std::min(b.low.x, p.x), std::min(b.low.y, p.y), std::min(b.low.z, p.z)};
          b.high = {std::max(b.high.x, p.x), std::max(b.high.y, p.y), std::max(b.high.z, p.z)};
        }
        return b;
      },
      [](Box a, const Box& b) {
        return Box{{std::min(a.low.x, b.low.x), std::min(a.low.y, b.low.y), std::min(a.low.z, b.low.z)},
                   {std::max(a.high.x, b.high.x), std::max(a.high.y, b.high.y), std::max(a.high.z, b.high.z)}};
      });
}

/// Reach of a pair of the largest grains with the largest margins [m]: the smallest cell that needs only its
/// neighbours.
double largest_reach(const Particles& p) {
  const double half = reduce_blocks(
      p.count(), 0.0,
      [&](Index begin, Index end) {
        double m = 0;
        for (Index i = begin; i < end; ++i)
          m = std::max(m, p.radius[static_cast<std::size_t>(i)] + p.list_margin[static_cast<std::size_t>(i)]);
        return m;
      },
      [](double a, double b) { return std::max(a, b); });
  return 2 * half;
}

template <class T>
void permute(Array<T>& field, const Array<Index>& order, Array<T>& buffer) {
  const auto n = static_cast<Index>(order.size());
  buffer.resize(order.size());
  for_each(n, [&](Index k) {
    buffer[static_cast<std::size_t>(k)] = field[static_cast<std::size_t>(order[static_cast<std::size_t>(k)])];
  });
  field.swap(buffer);
}

/// The same for what contacts see: velocities one after the other; the rest is that of the grains, which are in
/// order.
void permute_seen(Particles& p, NeighbourScratch& s) {
  const auto n = static_cast<Index>(s.order.size());
  s.vector_buffer.resize(s.order.size());
  for (Vec3 Seen::*const vector : {&Seen::velocity, &Seen::angular_velocity}) {
    for_each(n, [&](Index k) {
      const auto to = static_cast<std::size_t>(k);
      s.vector_buffer.set(to, p.seen.get(static_cast<std::size_t>(s.order[to])).*vector);
    });
    for_each(n, [&](Index k) {
      const auto to = static_cast<std::size_t>(k);
      Seen seen = p.seen.get(to);
      seen.*vector = s.vector_buffer.get(to);
      p.seen.set(to, seen);
    });
  }
  for_each(n, [&](Index k) {
    const auto i = static_cast<std::size_t>(k);
    const Seen seen = p.seen.get(i);
    p.seen.set(i, {p.position.get(i), p.radius[i], seen.velocity, p.mass[i], seen.angular_velocity,
                   static_cast<double>(p.material[i])});
  });
}

/// Counting sort by cell, then ids within a cell: the order is a function of positions and ids alone.
void order_by_cell(const Particles& p, NeighbourScratch& s) {
  const auto n = static_cast<std::size_t>(p.count());
  const auto cells = static_cast<std::size_t>(s.grid.cells());
  s.grain_begin.assign(cells + 1, 0);
  const auto stays = [&](std::size_t i) { return s.leaves.empty() || s.leaves[i] == 0; };
  for (std::size_t i = 0; i < n; ++i)
    if (stays(i)) ++s.grain_begin[static_cast<std::size_t>(s.cell[i]) + 1];
  std::partial_sum(s.grain_begin.begin(), s.grain_begin.end(), s.grain_begin.begin());
  s.order.resize(static_cast<std::size_t>(s.grain_begin.back()));
  s.next_in_cell.assign(s.grain_begin.begin(), s.grain_begin.end() - 1);
  for (std::size_t i = 0; i < n; ++i)
    if (stays(i))
      s.order[static_cast<std::size_t>(s.next_in_cell[static_cast<std::size_t>(s.cell[i])]++)] =
          static_cast<Index>(i);
  for_each(static_cast<Index>(cells), [&](Index c) {
    const auto b = s.order.begin() + s.grain_begin[static_cast<std::size_t>(c)];
    const auto e = s.order.begin() + s.grain_begin[static_cast<std::size_t>(c) + 1];
    if (e - b > 1)
      std::sort(b, e, [&](Index a, Index d) {
        return p.id[static_cast<std::size_t>(a)] < p.id[static_cast<std::size_t>(d)];
      });
  });
}

}  // namespace

void wrap(State& state, NeighbourScratch& scratch) {
  Particles& p = state.particles;
  scratch.wrap.resize(static_cast<std::size_t>(p.count()));
  if (!state.symmetry.periodic()) {
    for_each(p.count(), [&](Index i) { scratch.wrap[static_cast<std::size_t>(i)] = 0; });
    return;
  }
  const Symmetry& symmetry = state.symmetry;
  for_each(p.count(), [&](Index i) {
    const auto s = static_cast<std::size_t>(i);
    const int k = symmetry.turns_home(p.position.get(s));
    scratch.wrap[s] = k;
    if (k == 0) return;
    p.position.set(s, symmetry.turn_point(p.position.get(s), k));
    for (Vec3Array* field : {&p.velocity, &p.angular_velocity, &p.force, &p.torque})
      field->set(s, symmetry.turn_vector(field->get(s), k));
    Seen seen = p.seen.get(s);
    seen.position = p.position.get(s);
    for (Vec3* vector : {&seen.velocity, &seen.angular_velocity}) *vector = symmetry.turn_vector(*vector, k);
    p.seen.set(s, seen);
    p.turns[s] -= k;
  });
}

void sort_by_cell(State& state, NeighbourScratch& s) {
  Particles& p = state.particles;
  const Index n = p.count();
  const Box box = n > 0 ? bounding_box(p.position, n) : Box{};
  const double reach = n > 0 ? largest_reach(p) : 1.0;
  // Images stand within one reach around the domain; they find their place in the same grid.
  const Vec3 around{reach, reach, 0};
  s.grid = CellGrid(box.low - around, box.high + around, reach, std::max<std::int64_t>(4096, 8 * std::int64_t{n}));
  s.cell.resize(static_cast<std::size_t>(n));
  for_each(n, [&](Index i) {
    s.cell[static_cast<std::size_t>(i)] = s.grid.cell(p.position.get(static_cast<std::size_t>(i)));
  });
  order_by_cell(p, s);
  const auto reorder = [&](auto& field) {
    using Number = typename std::decay_t<decltype(field)>::value_type;
    if constexpr (std::is_same_v<Number, double>)
      permute(field, s.order, s.real_buffer);
    else
      permute(field, s.order, s.whole_buffer);
  };
  Particles::for_each_field(p, [&](const FieldInfo&, auto& field) { reorder(field); });
  permute_seen(p, s);
  reorder(s.wrap);
  s.old_slot.swap(s.order);
  s.leaves.clear();
}

void check_motion(const State& state, double dt) {
  const Particles& p = state.particles;
  const auto wrong = [&](Index i) {
    const auto s = static_cast<std::size_t>(i);
    const double way = norm(p.velocity.get(s)) * dt;
    return !(way <= largest_way_per_step * p.radius[s]) ||
           !std::isfinite(dot(p.position.get(s), p.position.get(s)));
  };
  const Index first = reduce_blocks(
      p.count(), p.count(),
      [&](Index begin, Index end) {
        for (Index i = begin; i < end; ++i)
          if (wrong(i)) return i;
        return p.count();
      },
      [](Index a, Index b) { return std::min(a, b); });
  if (first == p.count()) return;
  const auto s = static_cast<std::size_t>(first);
  const Vec3 x = p.position.get(s), v = p.velocity.get(s);
  std::ostringstream text;
  text << "grain " << p.id[s] << " at (" << x.x << ", " << x.y << ", " << x.z << ") m moves at " << norm(v)
       << " m/s in step " << state.step << ": more than " << largest_way_per_step << " radii in one step of " << dt
       << " s. Likely cause: the time step is too long for the stiffness, or grains started deep inside each other "
          "or a wall.";
  throw PhysicsError(text.str());
}

}  // namespace wedge

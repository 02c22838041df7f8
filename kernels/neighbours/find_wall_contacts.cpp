// find_wall_contacts.cpp: which wall features are near which grain, with the histories of the list before.
#include <sstream>

#include "core/pack.hpp"
#include "core/parallel.hpp"
#include "core/require.hpp"
#include "kernels/neighbours/neighbours.hpp"

namespace wedge {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

struct FoundWalls {
  std::vector<Index> grain, rows_of_grain;
  std::vector<std::int32_t> feature;
  Index deep_grain = -1;  // a grain that reaches too far into a wall, and the feature it reaches into
  std::int32_t deep_feature = -1;
};

/// Which grains of a pack are within reach of any of the features: a quick look, so that the many grains that are
/// near no wall are not asked feature by feature.
class NearWalls {
public:
  NearWalls(const Vessel& vessel, const std::vector<std::int32_t>& features) : slot_(vessel.slot()) {
    for (const std::int32_t f : features)
      features_.push_back({&vessel.feature(f), vessel.travel(vessel.feature(f).wall)});
  }
  Pack::mask_type operator()(const PackVec3& x, const Pack& reach) const {
    using std::abs, std::sqrt;
    const Pack r = slot_ ? x.x : sqrt(x.x * x.x + x.y * x.y), wide = 1.000001 * reach;  // more than round-off
    Pack::mask_type near(false);
    for (const Placed& placed : features_) {
      const WallFeature& f = *placed.feature;
      Pack distance;
      if (f.kind == WallFeature::Kind::plane) {
        distance = abs(height_over_plane(f, x));
      } else if (f.kind == WallFeature::Kind::core) {
        distance = abs(beyond_core(f, r));
      } else {
        distance = way_to_profile(f, r, Pack(x.z - placed.travel)).distance;
      }
      near = near || distance < wide;
    }
    return near;
  }

private:
  struct Placed {
    const WallFeature* feature;
    double travel;  // m, upwards
  };
  bool slot_;
  std::vector<Placed> features_;
};

void report_overlap(const State& state, Index i, std::int32_t f) {
  const Particles& p = state.particles;
  const Vec3 x = p.position.get(at(i));
  std::ostringstream text;
  text << "grain " << p.id[at(i)] << " at (" << x.x << ", " << x.y << ", " << x.z << ") m overlaps the wall '"
       << state.vessel.wall(state.vessel.carrier(f)).name << "' by "
       << p.radius[at(i)] - state.vessel.proximity(f, x).distance << " m in step " << state.step << ": more than "
       << wall_overlap_limit
       << " of its radius. Likely cause: grains or walls too soft for their speed, a time step "
       << "too long, or a start within the wall.";
  throw PhysicsError(text.str());
}

/// Remembers the list before, indexed by the slot each grain had then.
void set_aside(WallContactTable& c, NeighbourScratch& s, Index old_count) {
  std::swap(s.old_walls, c);
  s.old_wall_row.assign(at(old_count), 0);
  s.old_wall_row_end.assign(at(old_count), 0);
  for (std::size_t g = 0; g < s.old_walls.grain.size(); ++g) {
    const std::size_t i = at(s.old_walls.grain[g]);
    if (i >= at(old_count)) s.old_wall_row.resize(i + 1, 0), s.old_wall_row_end.resize(i + 1, 0);
    s.old_wall_row[i] = s.old_walls.begin[g];
    s.old_wall_row_end[i] = s.old_walls.begin[g + 1];
  }
}

void carry_history(State& state, const NeighbourScratch& s, Index i, std::size_t row) {
  WallContactTable& c = state.wall_contacts;
  const WallContactTable& old = s.old_walls;
  c.touching[row] = 0;
  c.history.set(row, {});
  c.normal.set(row, {});
  c.rolling_moment.set(row, {});
  const Index before = s.old_slot[at(i)];
  if (at(before) >= s.old_wall_row.size()) return;
  for (Index k = s.old_wall_row[at(before)]; k < s.old_wall_row_end[at(before)]; ++k) {
    if (old.feature[at(k)] != c.feature[row]) continue;
    c.touching[row] = old.touching[at(k)];
    c.history.set(row, state.symmetry.turn_vector(old.history.get(at(k)), s.wrap[at(i)]));
    c.normal.set(row, state.symmetry.turn_vector(old.normal.get(at(k)), s.wrap[at(i)]));
    c.rolling_moment.set(row, state.symmetry.turn_vector(old.rolling_moment.get(at(k)), s.wrap[at(i)]));
  }
}

}  // namespace

void find_wall_contacts(State& state, NeighbourScratch& scratch) {
  const Particles& p = state.particles;
  const Vessel& vessel = state.vessel;
  const Index n = p.count();
  std::vector<std::int32_t> active;
  for (int f = 0; f < vessel.feature_count(); ++f)
    if (vessel.active(f)) active.push_back(f);

  const NearWalls near_walls(vessel, active);
  std::vector<FoundWalls> found(at(block_count(n)));
  for_each_block(block_count(n), [&](Index b) {
    FoundWalls& out = found[at(b)];
    const Index end = std::min(n, (b + 1) * block_size);
    const auto look = [&](Index i) {
      const double reach = scratch.reach[at(i)] + state.wall_margin;
      const auto before = out.feature.size();
      for (const std::int32_t f : active) {
        const WallProximity near = vessel.proximity(f, p.position.get(at(i)));
        if (near.distance < reach) out.feature.push_back(f);
        // On the wall itself, and on the axis line, there is no normal: the distance alone decides.
        const bool deep = near.minimum && near.distance < (1 - wall_overlap_limit) * p.radius[at(i)];
        if (deep && out.deep_grain < 0) out.deep_grain = i, out.deep_feature = f;
      }
      if (out.feature.size() == before) return;
      out.grain.push_back(i);
      out.rows_of_grain.push_back(static_cast<Index>(out.feature.size() - before));
    };
    for (Index i = b * block_size; i < end; i += pack_size) {
      const Vec3Array& x = scratch.places;
      const Pack reach = load(&scratch.reach[at(i)]) + state.wall_margin;
      for_each_lane(near_walls({load(&x.x[at(i)]), load(&x.y[at(i)]), load(&x.z[at(i)])}, reach), [&](Index lane) {
        if (i + lane < end) look(i + lane);
      });
    }
  });

  for (const FoundWalls& f : found)
    if (f.deep_grain >= 0) report_overlap(state, f.deep_grain, f.deep_feature);

  WallContactTable& c = state.wall_contacts;
  set_aside(c, scratch, n);
  c.grain.clear();
  c.begin.clear();
  c.feature.clear();
  Index rows = 0;
  for (const FoundWalls& f : found) {
    for (std::size_t g = 0; g < f.grain.size(); ++g) {
      c.grain.push_back(f.grain[g]);
      c.begin.push_back(rows);
      rows += f.rows_of_grain[g];
    }
    c.feature.insert(c.feature.end(), f.feature.begin(), f.feature.end());
  }
  c.begin.push_back(rows);
  c.resize(rows);
  for_each(static_cast<Index>(c.grain.size()), [&](Index g) {
    for (Index k = c.begin[at(g)]; k < c.begin[at(g) + 1]; ++k)
      carry_history(state, scratch, c.grain[at(g)], at(k));
  });
}

}  // namespace wedge

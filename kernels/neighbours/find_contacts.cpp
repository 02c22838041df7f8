// find_contacts.cpp: the half list of near pairs of grains and images, with the histories of the list before.
#include <numeric>
#include <sstream>
#include <vector>

#include "core/pack.hpp"
#include "core/parallel.hpp"
#include "core/require.hpp"
#include "kernels/neighbours/neighbours.hpp"

namespace wedge {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

/// What was found for the grains of one block, before rows have their final place.
struct Found {
  std::vector<Index> second;
  std::vector<Index> rows_of_grain;
  Index deepest_first = -1, deepest_second = -1;  // a pair that overlaps too much
};

/// The search around one grain.
class PairSearch {
public:
  PairSearch(const State& state, const NeighbourScratch& scratch, AxisRule axis)
      : p_(state.particles),
        images_(state.images),
        symmetry_(state.symmetry),
        s_(scratch),
        n_(state.particles.count()),
        axis_(axis),
        widest_(n_ > 0 ? 1.000001 * *std::max_element(scratch.reach.begin(), scratch.reach.end()) : 0) {}

  void around(Index i, Found& found) const {
    const Vec3 x = p_.position.get(at(i));
    const auto before = found.second.size();
    const PackVec3 here{Pack(x.x), Pack(x.y), Pack(x.z)};
    const Pack reach = s_.reach[at(i)];
    s_.grid.for_each_run_around(x, [&](Index first, Index last) {
      const Index end = s_.grain_begin[at(last) + 1];
      for (Index j = s_.grain_begin[at(first)]; j < end; j += pack_size) {
        const PackVec3 d =
            PackVec3{load(&s_.places.x[at(j)]), load(&s_.places.y[at(j)]), load(&s_.places.z[at(j)])} - here;
        const Pack both = reach + load(&s_.reach[at(j)]);
        for_each_lane(dot(d, d) < both * both, [&](Index lane) {
          if (j + lane < end && p_.id[at(j + lane)] > p_.id[at(i)]) consider(i, j + lane, j + lane, x, found);
        });
      }
    });
    // A line from a grain to an image crosses a face.
    if (images_.count() > 0 && symmetry_.distance_to_face(x) < s_.reach[at(i)] + widest_)
      images_around(i, x, found);
    found.rows_of_grain.push_back(static_cast<Index>(found.second.size() - before));
  }

private:
  void images_around(Index i, Vec3 x, Found& found) const {
    s_.grid.for_each_run_around(x, [&](Index first, Index last) {
      for (Index q = s_.image_begin[at(first)]; q < s_.image_begin[at(last) + 1]; ++q) {
        const Index m = s_.image_order[at(q)];
        const Index owner = images_.owner[at(m)];
        if (ours(i, owner, images_.turn[at(m)])) consider(i, owner, n_ + m, x, found);
      }
    });
  }

  /// Is the pair of grain i and the copy of `owner` at this turn computed, and from the side of i? One side
  /// computes a seam pair: the grain with the smaller id; a grain meets each of its own copies k and -k once, at
  /// the positive turn. A grain held on the axis meets every copy, and they do not meet it.
  bool ours(Index i, Index owner, int turn) const {
    if (held_on_axis(axis_, p_.position.x[at(i)], p_.position.y[at(i)], p_.radius[at(i)])) return true;
    if (!every_copy_acts(axis_) && turn != 1 && turn != -1) return false;
    if (owner == i) return meets_itself(axis_) && turn > 0;
    return p_.id[at(owner)] > p_.id[at(i)];
  }

  void consider(Index i, Index owner, Index slot, Vec3 x, Found& found) const {
    const Vec3 d = p_.position.get(at(slot)) - x;
    const double radii = p_.radius[at(i)] + p_.radius[at(owner)];
    const double reach = radii + p_.list_margin[at(i)] + p_.list_margin[at(owner)];
    const double square = dot(d, d);
    if (!(square < reach * reach)) return;
    found.second.push_back(slot);
    const double limit = radii - overlap_limit * std::min(p_.radius[at(i)], p_.radius[at(owner)]);
    if (square < limit * limit && found.deepest_first < 0) {
      found.deepest_first = i;
      found.deepest_second = slot;
    }
  }

  const Particles& p_;
  const ImageMap& images_;
  const Symmetry& symmetry_;
  const NeighbourScratch& s_;
  Index n_;
  AxisRule axis_;
  double widest_;  // m, reach of the partner with the widest reach, and more than round-off
};

/// Copies what the search reads of all grains, with a pack behind the last that is near nobody.
void list_places(const Particles& p, NeighbourScratch& s) {
  const Index n = p.count();
  for (Array<double>* field : {&s.places.x, &s.places.y, &s.places.z, &s.reach})
    resize_anew(*field, at(n + pack_size));
  for_each(n, [&](Index i) {
    s.places.set(at(i), p.position.get(at(i)));
    s.reach[at(i)] = p.radius[at(i)] + p.list_margin[at(i)];
  });
  for (Index i = n; i < n + pack_size; ++i) {
    s.places.set(at(i), {1e30, 0, 0});
    s.reach[at(i)] = 0;
  }
}

/// Places images in the cells of the grid: a list of images per cell, in image order.
void bin_images(const State& state, NeighbourScratch& s) {
  const Index m = state.images.count(), n = state.particles.count();
  s.image_begin.assign(at(s.grid.cells()) + 1, 0);
  if (m == 0) return;
  s.image_cell.resize(at(m));
  for (Index q = 0; q < m; ++q) {
    s.image_cell[at(q)] = s.grid.cell(state.particles.position.get(at(n + q)));
    ++s.image_begin[at(s.image_cell[at(q)]) + 1];
  }
  std::partial_sum(s.image_begin.begin(), s.image_begin.end(), s.image_begin.begin());
  s.next_in_cell.assign(s.image_begin.begin(), s.image_begin.end() - 1);
  s.image_order.resize(at(m));
  for (Index q = 0; q < m; ++q) s.image_order[at(s.next_in_cell[at(s.image_cell[at(q)])]++)] = q;
}

void report_overlap(const State& state, Index i, Index slot) {
  const Particles& p = state.particles;
  const Index owner = slot < p.count() ? slot : state.images.owner[at(slot - p.count())];
  const Vec3 x = p.position.get(at(i));
  std::ostringstream text;
  text << "grains " << p.id[at(i)] << " and " << p.id[at(owner)] << " at (" << x.x << ", " << x.y << ", " << x.z
       << ") m overlap by " << (p.radius[at(i)] + p.radius[at(owner)] - norm(p.position.get(at(slot)) - x))
       << " m in step " << state.step << ": more than " << overlap_limit
       << " of the smaller radius. Likely cause: grains too soft for their speed, a time step too long, or a start "
          "with overlaps.";
  throw PhysicsError(text.str());
}

/// Finds the row of the old list that is the same contact, or -1.
/// `first_wrap` and `partner_wrap` are the turns by which the two grains were turned since.
Index old_row(const NeighbourScratch& s, const Symmetry& symmetry, Index old_first, std::int32_t partner,
              int turn_now, int first_wrap, int partner_wrap) {
  for (Index k = s.old_row_begin[at(old_first)]; k < s.old_row_begin[at(old_first) + 1]; ++k) {
    if (s.old_partner[at(k)] != partner) continue;
    if (symmetry.residue(s.old_turn[at(k)] + first_wrap - partner_wrap) == turn_now) return k;
  }
  return -1;
}

/// Fills the rows of grain i; histories of known contacts come along, turned with grain i.
void fill_rows(State& state, const NeighbourScratch& s, Index i, Index begin, const Index* seconds, Index count) {
  const Particles& p = state.particles;
  ContactTable& c = state.contacts;
  const bool has_old = s.old_row_begin.back() > 0, had_moments = s.old_rolling_moment.size() > 0;
  for (Index m = 0; m < count; ++m) {
    const std::size_t k = at(begin + m);
    const Index slot = seconds[m];
    c.first[k] = i;
    c.second[k] = slot;
    Vec3 history, moment;
    if (has_old) {
      const Partner partner = row_partner(state, k);
      const Index old = old_row(s, state.symmetry, s.old_slot[at(i)], p.id[at(partner.grain)], partner.turn,
                                s.wrap[at(i)], s.wrap[at(partner.grain)]);
      if (old >= 0) {
        history = state.symmetry.turn_vector(s.old_history.get(at(old)), s.wrap[at(i)]);
        if (had_moments) moment = state.symmetry.turn_vector(s.old_rolling_moment.get(at(old)), s.wrap[at(i)]);
      }
    }
    c.history.set(k, history);
    if (c.rolling_moment.size() > 0) c.rolling_moment.set(k, moment);
  }
}

}  // namespace

void set_contacts_aside(const State& state, NeighbourScratch& s) {
  const ContactTable& c = state.contacts;
  const auto grains = static_cast<Index>(c.row_begin.size()) - 1;
  const bool moments = c.rolling_moment.size() == at(c.rows());
  const auto some = [](Vec3 v) { return v.x != 0 || v.y != 0 || v.z != 0; };
  const auto stores = [&](std::size_t k) {
    return some(c.history.get(k)) || (moments && some(c.rolling_moment.get(k)));
  };
  s.old_row_begin.assign(at(std::max(grains, 0)) + 1, 0);
  for_each(grains, [&](Index i) {
    Index kept = 0;
    for (std::size_t k = at(c.row_begin[at(i)]); k < at(c.row_begin[at(i) + 1]); ++k) kept += stores(k);
    s.old_row_begin[at(i) + 1] = kept;
  });
  std::partial_sum(s.old_row_begin.begin(), s.old_row_begin.end(), s.old_row_begin.begin());
  const Index rows = s.old_row_begin.back();
  for (Array<double>* field : {&s.old_history.x, &s.old_history.y, &s.old_history.z}) resize_anew(*field, at(rows));
  s.old_rolling_moment.resize(moments ? at(rows) : 0);
  resize_anew(s.old_partner, at(rows));
  resize_anew(s.old_turn, at(rows));
  for_each(grains, [&](Index i) {
    std::size_t to = at(s.old_row_begin[at(i)]);
    for (std::size_t k = at(c.row_begin[at(i)]); k < at(c.row_begin[at(i) + 1]); ++k) {
      if (!stores(k)) continue;
      const Partner partner = row_partner(state, k);
      s.old_partner[to] = state.particles.id[at(partner.grain)];
      s.old_turn[to] = partner.turn;
      s.old_history.set(to, c.history.get(k));
      if (moments) s.old_rolling_moment.set(to, c.rolling_moment.get(k));
      ++to;
    }
  });
}

void find_contacts(State& state, NeighbourScratch& scratch, const PairRules& rules) {
  const Index n = state.particles.count();
  bin_images(state, scratch);
  list_places(state.particles, scratch);
  ContactTable& c = state.contacts;

  std::vector<Found> found(at(block_count(n)));
  const PairSearch search(state, scratch, rules.axis);
  for_each_block(block_count(n), [&](Index b) {
    Found& f = found[at(b)];
    f.second.reserve(at(4 * block_size));
    f.rows_of_grain.reserve(at(block_size));
    for (Index i = b * block_size; i < std::min(n, (b + 1) * block_size); ++i) search.around(i, f);
  });

  resize_anew(c.row_begin, at(n + 1));
  Index rows = 0;
  for (Index b = 0; b < block_count(n); ++b) {
    const Found& f = found[at(b)];
    if (f.deepest_first >= 0) report_overlap(state, f.deepest_first, f.deepest_second);
    for (std::size_t g = 0; g < f.rows_of_grain.size(); ++g) {
      c.row_begin[at(b * block_size) + g] = rows;
      rows += f.rows_of_grain[g];
    }
  }
  c.row_begin[at(n)] = rows;
  ContactTable::for_each_field(c, [&](const FieldInfo&, auto& field) { resize_anew(field, at(rows)); });
  const Index couples = rules.couples ? rows : 0;  // none of a bed that was taken over from a run with couples
  ContactTable::for_each_couple_field(c, [&](const FieldInfo&, auto& field) { resize_anew(field, at(couples)); });
  for_each_block(block_count(n), [&](Index b) {
    const Found& f = found[at(b)];
    const Index* next = f.second.data();
    for (std::size_t g = 0; g < f.rows_of_grain.size(); ++g) {
      const Index i = b * block_size + static_cast<Index>(g);
      fill_rows(state, scratch, i, c.row_begin[at(i)], next, f.rows_of_grain[g]);
      next += f.rows_of_grain[g];
    }
  });
}

}  // namespace wedge

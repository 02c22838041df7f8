// bed.cpp: makes grains, contacts and neighbours ready for measuring.
#include "apps/measure/bed.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "core/parallel.hpp"
#include "core/time_scales.hpp"
#include "kernels/neighbours/neighbour_list.hpp"

namespace wedge {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

/// Components along the radius, the azimuth and z at a place; of a slot along x, y, z. On the axis there is no
/// radius.
Vec3 in_cylinder_axes(const MeasuredDomain& domain, Vec3 place, Vec3 v) {
  if (domain.slot) return v;
  const double r = std::hypot(place.x, place.y);
  if (!(r > 0)) return {0, 0, v.z};
  const double c = place.x / r, s = place.y / r;
  return {c * v.x + s * v.y, c * v.y - s * v.x, v.z};
}

/// Grains with a list of neighbours that holds every pair nearer than near_gap, at rest and without walls; images
/// act as in the run.
class NearPairs {
public:
  NearPairs(const MeasuredDomain& domain, const Particles& grains) {
    state.symmetry = domain.symmetry;
    state.particles = grains;
    for (auto* field : {&state.particles.velocity, &state.particles.angular_velocity})
      for (auto* component : {&field->x, &field->y, &field->z}) std::fill(component->begin(), component->end(), 0);
    NeighbourList({domain.scene.domain.axis, false}, 0.6 * near_gap * domain.diameter).start(state, 1e-9);
  }
  State state;
};

/// Places of grains by id.
std::unordered_map<std::int32_t, Index> places_by_id(const Particles& grains) {
  std::unordered_map<std::int32_t, Index> places;
  places.reserve(at(grains.count()));
  for (Index i = 0; i < grains.count(); ++i) places.emplace(grains.id[at(i)], i);
  return places;
}

void take_contacts(Bed& bed, const ContactFrame& contacts, const std::unordered_map<std::int32_t, Index>& places) {
  bed.has_forces = true;
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const auto first = places.find(contacts.first_id[c]), second = places.find(contacts.second_id[c]);
    if (first == places.end() || second == places.end()) continue;
    bed.contacts.push_back({first->second, second->second, contacts.turn[c], contacts.first_position.get(c),
                            contacts.second_position.get(c),
                            contacts.normal_force.get(c) + contacts.tangential_force.get(c),
                            contacts.normal_load[c]});
  }
}

/// Contacts from the overlaps of a state's own rows, without forces. `place` gives the place of a grain of the
/// state among the bed's.
template <class PlaceOf>
void take_overlaps(Bed& bed, const State& state, PlaceOf place) {
  for (std::size_t k = 0; k < at(state.contacts.rows()); ++k) {
    if (!(row_overlap(state, k) > 0)) continue;
    const Partner partner = row_partner(state, k);
    const Vec3 from = state.particles.position.get(at(state.contacts.first[k]));
    bed.contacts.push_back({place(state.contacts.first[k]),
                            place(partner.grain),
                            partner.turn,
                            from,
                            from + row_way(state, k),
                            {},
                            0});
  }
}

/// Near neighbours, at both ends.
template <class PlaceOf>
void count_near(Bed& bed, const MeasuredDomain& domain, const State& state, PlaceOf place) {
  bed.has_near = true;
  for (std::size_t k = 0; k < at(state.contacts.rows()); ++k) {
    if (!(row_overlap(state, k) > -near_gap * domain.diameter)) continue;
    ++bed.grains[at(place(state.contacts.first[k]))].cn_near;
    if (!row_is_shared(state, k)) ++bed.grains[at(place(row_partner(state, k).grain))].cn_near;
  }
}

/// Counts contacts and sums normal forces at both ends.
void count_contacts_of(Bed& bed, const MeasuredDomain& domain) {
  std::vector<std::pair<Index, Index>> meetings;
  meetings.reserve(2 * bed.contacts.size());
  for (const BedContact& c : bed.contacts) {
    BedGrain &first = bed.grains[at(c.first)], &second = bed.grains[at(c.second)];
    const Vec3 way = c.to - c.from;
    const Vec3 pull = (-c.load / norm(way)) * way;  // normal force on the first
    first.normal_force += in_cylinder_axes(domain, first.position, pull);
    ++first.cn;
    meetings.emplace_back(c.first, c.second);
    if (domain.symmetry.is_seen_from_both_ends(c.first, c.second, c.turn)) continue;
    second.normal_force += in_cylinder_axes(domain, second.position, domain.symmetry.turn_vector(-pull, -c.turn));
    ++second.cn;
    meetings.emplace_back(c.second, c.first);
  }
  std::sort(meetings.begin(), meetings.end());
  meetings.erase(std::unique(meetings.begin(), meetings.end()), meetings.end());
  for (const auto& meeting : meetings) ++bed.grains[at(meeting.first)].cn_distinct;
}

/// Marks the bed and its bulk, by height.
void mark_bed(Bed& bed) {
  std::vector<double> heights;
  for (BedGrain& g : bed.grains) {
    g.in_bed = g.position.z >= bed.ground;
    if (g.in_bed) heights.push_back(g.position.z);
  }
  if (heights.empty()) return;
  const auto quantile = [&](double share) {
    const auto place =
        heights.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(heights.size() - 1));
    std::nth_element(heights.begin(), place, heights.end());
    return *place;
  };
  bed.bulk_low = quantile(0.1);
  bed.bulk_high = quantile(0.9);
  for (BedGrain& g : bed.grains)
    g.in_bulk = g.in_bed && g.position.z >= bed.bulk_low && g.position.z <= bed.bulk_high;
}

}  // namespace

double ground_height(const MeasuredDomain& domain, const Vessel& vessel, const Particles& grains) {
  std::vector<double> heights(grains.position.z.begin(),
                              grains.position.z.begin() + static_cast<std::ptrdiff_t>(grains.count()));
  double ground = domain.lowest_wall;
  if (heights.empty()) return ground;
  const auto middle = heights.begin() + static_cast<std::ptrdiff_t>(heights.size() / 2);
  std::nth_element(heights.begin(), middle, heights.end());
  for (int w = 0; w < vessel.wall_count(); ++w) {
    if (!vessel.present(w)) continue;
    for (const Eigen::Vector2d& point : vessel.wall(w).profile) {
      const double z = point.y() + vessel.travel(w);
      if (!domain.slot && point.x() == 0 && z < *middle) ground = std::max(ground, z);
    }
  }
  return ground;
}

namespace {

/// Places, speeds and sizes; contacts are still to be taken.
Bed bed_of_grains(const MeasuredDomain& domain, const State& state) {
  const Particles& p = state.particles;
  Bed bed;
  bed.ground = ground_height(domain, state.vessel, p);
  bed.grains.resize(at(p.count()));
  for_each(p.count(), [&](Index i) {
    const std::size_t s = at(i);
    BedGrain& g = bed.grains[s];
    g.position = p.position.get(s);
    g.r = domain.slot ? std::abs(g.position.x) : std::hypot(g.position.x, g.position.y);
    const double azimuth = domain.slot ? 0 : std::atan2(g.position.y, g.position.x);
    g.azimuth = azimuth < 0 ? azimuth + 2 * numbers::pi : azimuth;
    g.radius = p.radius[s];
    g.mass = p.mass[s];
    g.weight = state.weight(i);
    g.layer = p.layer[s];
    g.velocity = in_cylinder_axes(domain, g.position, p.velocity.get(s));
  });
  return bed;
}

Bed completed(Bed bed, const MeasuredDomain& domain) {
  count_contacts_of(bed, domain);
  mark_bed(bed);
  return bed;
}

}  // namespace

Bed bed_of_run(const MeasuredDomain& domain, const State& state) {
  Bed bed = bed_of_grains(domain, state);
  take_overlaps(bed, state, [](Index grain) { return grain; });
  return completed(std::move(bed), domain);
}

Bed bed_of_frame(const MeasuredDomain& domain, const State& state, const ContactFrame* contacts) {
  Bed bed = bed_of_grains(domain, state);
  if (state.particles.count() > 0) {
    const auto places = places_by_id(state.particles);
    const NearPairs pairs(domain, state.particles);
    const auto place = [&](Index grain) { return places.at(pairs.state.particles.id[at(grain)]); };
    if (contacts != nullptr)
      take_contacts(bed, *contacts, places);
    else
      take_overlaps(bed, pairs.state, place);
    count_near(bed, domain, pairs.state, place);
  }
  return completed(std::move(bed), domain);
}

}  // namespace wedge

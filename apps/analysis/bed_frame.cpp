// bed_frame.cpp: makes the grains, contacts and neighbours of a frame ready for measuring.
#include "apps/analysis/bed_frame.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <unordered_map>

#include "apps/run/walls_at.hpp"
#include "core/parallel.hpp"
#include "core/time_scales.hpp"
#include "kernels/fill.hpp"
#include "kernels/time_step.hpp"

namespace wedge {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

/// Components along the radius, the azimuth and z at a place; of a slot along x, y, z. On the axis there is no
/// radius.
Vec3 in_cylinder_axes(const AnalysedRun& run, Vec3 place, Vec3 v) {
  if (run.slot) return v;
  const double r = std::hypot(place.x, place.y);
  if (!(r > 0)) return {0, 0, v.z};
  const double c = place.x / r, s = place.y / r;
  return {c * v.x + s * v.y, c * v.y - s * v.x, v.z};
}

/// Grains with a grid of neighbours that holds every pair nearer than near_gap: the run's own neighbour list, at
/// rest and without walls, so that images act as in the run.
class NearPairs {
public:
  NearPairs(const AnalysedRun& run, const Particles& grains) : scene_(run.scene) {
    scene_.domain.outlet_height.reset();
    scene_.run.skin = 1.2 * near_gap * run.diameter;
    scene_.run.precision = Precision::double_precision;
    state.symmetry = run.symmetry;
    state.vessel = Vessel(scene_);
    for (int w = 0; w < state.vessel.wall_count(); ++w) state.vessel.set_present(w, false);
    state.particles = grains;
    for (auto* field : {&state.particles.velocity, &state.particles.angular_velocity})
      for (auto* component : {&field->x, &field->y, &field->z}) std::fill(component->begin(), component->end(), 0);
    describe_grains(state);
    TimeStep step(scene_, state);
    step.start(state, 1e-9);
  }
  State state;

private:
  Scene scene_;
};

/// Places of grains by id.
std::unordered_map<std::int32_t, Index> places_by_id(const Particles& grains) {
  std::unordered_map<std::int32_t, Index> places;
  places.reserve(at(grains.count()));
  for (Index i = 0; i < grains.count(); ++i) places.emplace(grains.id[at(i)], i);
  return places;
}

/// Whether a contact is one of a grain with its copy half a turn away: one contact, seen from both ends.
bool is_shared(const AnalysedRun& run, Index first, Index second, int turn) {
  return first == second && 2 * turn == run.symmetry.order();
}

void take_contacts(BedFrame& bed, const ContactFrame& contacts,
                   const std::unordered_map<std::int32_t, Index>& places) {
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

/// Contacts from overlaps, without forces; and near neighbours in any case.
void take_near_pairs(BedFrame& bed, const AnalysedRun& run, const NearPairs& pairs,
                     const std::unordered_map<std::int32_t, Index>& places) {
  const State& state = pairs.state;
  const auto place = [&](Index slot) { return places.at(state.particles.id[at(slot)]); };
  for (std::size_t k = 0; k < at(state.contacts.rows()); ++k) {
    const double overlap = row_overlap(state, k);
    if (!(overlap > -near_gap * run.diameter)) continue;
    const Partner partner = row_partner(state, k);
    const Index first = place(state.contacts.first[k]), second = place(partner.grain);
    ++bed.grains[at(first)].cn_near;
    if (!is_shared(run, first, second, partner.turn)) ++bed.grains[at(second)].cn_near;
    if (bed.has_forces || !(overlap > 0)) continue;
    const Vec3 from = state.particles.position.get(at(state.contacts.first[k]));
    bed.contacts.push_back({first, second, partner.turn, from, from + row_way(state, k), {}, 0});
  }
}

/// Counts contacts and sums normal forces at both ends.
void count_contacts_of(BedFrame& bed, const AnalysedRun& run) {
  std::vector<std::pair<Index, Index>> meetings;
  meetings.reserve(2 * bed.contacts.size());
  for (const BedContact& c : bed.contacts) {
    BedGrain &first = bed.grains[at(c.first)], &second = bed.grains[at(c.second)];
    const Vec3 way = c.to - c.from;
    const Vec3 pull = (-c.load / norm(way)) * way;  // normal force on the first
    first.normal_force += in_cylinder_axes(run, first.position, pull);
    ++first.cn;
    meetings.emplace_back(c.first, c.second);
    if (is_shared(run, c.first, c.second, c.turn)) continue;
    second.normal_force += in_cylinder_axes(run, second.position, run.symmetry.turn_vector(-pull, -c.turn));
    ++second.cn;
    meetings.emplace_back(c.second, c.first);
  }
  std::sort(meetings.begin(), meetings.end());
  meetings.erase(std::unique(meetings.begin(), meetings.end()), meetings.end());
  for (const auto& meeting : meetings) ++bed.grains[at(meeting.first)].cn_distinct;
}

/// Marks the bed and its bulk, by height.
void mark_bed(BedFrame& bed) {
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

double ground_height(const AnalysedRun& run, const Vessel& vessel, const Particles& grains) {
  std::vector<double> heights(grains.position.z.begin(),
                              grains.position.z.begin() + static_cast<std::ptrdiff_t>(grains.count()));
  double ground = run.lowest_wall;
  if (heights.empty()) return ground;
  const auto middle = heights.begin() + static_cast<std::ptrdiff_t>(heights.size() / 2);
  std::nth_element(heights.begin(), middle, heights.end());
  for (int w = 0; w < vessel.wall_count(); ++w) {
    if (!vessel.present(w)) continue;
    for (const Eigen::Vector2d& point : vessel.wall(w).profile) {
      const double z = point.y() + vessel.travel(w);
      if (!run.slot && point.x() == 0 && z < *middle) ground = std::max(ground, z);
    }
  }
  return ground;
}

BedFrame make_bed_frame(const AnalysedRun& run, const Vessel& vessel, const ParticleFrame& frame,
                        const ContactFrame* contacts) {
  const Particles& p = frame.particles;
  BedFrame bed;
  bed.time = frame.header.time;
  bed.ground = ground_height(run, vessel, p);
  bed.grains.resize(at(p.count()));
  for_each(p.count(), [&](Index i) {
    const std::size_t s = at(i);
    BedGrain& g = bed.grains[s];
    g.position = p.position.get(s);
    g.r = run.slot ? std::abs(g.position.x) : std::hypot(g.position.x, g.position.y);
    const double azimuth = run.slot ? 0 : std::atan2(g.position.y, g.position.x);
    g.azimuth = azimuth < 0 ? azimuth + 2 * numbers::pi : azimuth;
    g.radius = p.radius[s];
    g.mass = p.mass[s];
    g.layer = p.layer[s];
    g.velocity = in_cylinder_axes(run, g.position, p.velocity.get(s));
  });
  if (p.count() > 0) {
    const auto places = places_by_id(p);
    if (contacts) take_contacts(bed, *contacts, places);
    take_near_pairs(bed, run, NearPairs(run, p), places);
  }
  count_contacts_of(bed, run);
  mark_bed(bed);
  return bed;
}

BedFrame read_bed_frame(const AnalysedRun& run, std::int64_t number) {
  const ParticleFrame grains = read_particle_frame(run.folder.frame("particles", number));
  const Vessel vessel = walls_at(run.scene, run.folder, grains.header.time);
  const std::string contact_file = run.folder.frame("contacts", number);
  if (!std::filesystem::exists(contact_file)) return make_bed_frame(run, vessel, grains, nullptr);
  const ContactFrame contacts = read_contact_frame(contact_file);
  return make_bed_frame(run, vessel, grains, &contacts);
}

}  // namespace wedge

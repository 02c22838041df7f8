// checkpoint_checks.cpp: lengths and indices, table by table.
#include "io/files/checkpoint_checks.hpp"

#include <algorithm>
#include <cmath>

#include "io/files/atomic_file.hpp"

namespace wedge {
namespace {

constexpr std::int32_t most_turns = 1 << 30;  // of a grain's path; sums of a few stay within 32 bits

/// Whether every number is at least `low` and less than `end`.
template <class Number>
bool all_within(const Array<Number>& numbers, std::int64_t low, std::int64_t end) {
  return std::all_of(numbers.begin(), numbers.end(), [&](Number x) { return x >= low && x < end; });
}

/// Whether `begin` cuts `rows` rows into `pieces` pieces: begins at 0, never falls, ends at `rows`.
bool cuts(const Array<Index>& begin, std::size_t pieces, std::size_t rows) {
  return begin.size() == pieces + 1 && begin.front() == 0 && static_cast<std::size_t>(begin.back()) == rows &&
         std::is_sorted(begin.begin(), begin.end());
}

bool positive(double x) { return x > 0 && std::isfinite(x); }

/// Turns at which a copy can be seen: those of its symmetry, to either side.
std::int64_t largest_turn(const Symmetry& symmetry) {
  switch (symmetry.kind()) {
    case Symmetry::Kind::none:
      return 0;
    case Symmetry::Kind::rotation:
      return symmetry.order();
    case Symmetry::Kind::translation:
      break;
  }
  return 1;
}

bool grains_fit(const State& s) {
  const Particles& p = s.particles;
  return std::all_of(p.radius.begin(), p.radius.begin() + p.count(), positive) &&
         std::all_of(p.mass.begin(), p.mass.begin() + p.count(), positive) &&
         all_within(p.turns, -most_turns, most_turns) && s.step >= 0 && s.list_builds >= 0 && s.put_in >= 0 &&
         s.taken_out >= 0;
}

bool images_fit(const State& s) {
  const ImageMap& images = s.images;
  const std::int64_t turn = largest_turn(s.symmetry);
  return images.turn.size() == images.owner.size() && all_within(images.owner, 0, s.particles.count()) &&
         std::is_sorted(images.owner.begin(), images.owner.end()) && all_within(images.turn, -turn, turn + 1) &&
         (images.owner.empty() || turn > 0);
}

bool contacts_fit(const State& s) {
  const ContactTable& c = s.contacts;
  const std::size_t rows = c.first.size(), n = s.particles.id.size(), slots = n + s.images.owner.size();
  bool fit = true;
  ContactTable::for_each_field(c, [&](const FieldInfo&, const auto& field) { fit = fit && field.size() == rows; });
  ContactTable::for_each_couple_field(
      c, [&](const FieldInfo&, const auto& field) { fit = fit && (field.empty() || field.size() == rows); });
  if (!fit || !all_within(c.first, 0, static_cast<Index>(n)) || !all_within(c.second, 0, static_cast<Index>(slots)))
    return false;
  if (c.row_begin.empty()) return rows == 0;
  if (!cuts(c.row_begin, n, rows)) return false;
  for (std::size_t i = 0; i < n; ++i)
    for (Index k = c.row_begin[i]; k < c.row_begin[i + 1]; ++k)
      if (static_cast<std::size_t>(c.first[static_cast<std::size_t>(k)]) != i) return false;
  return true;
}

bool wall_contacts_fit(const State& s) {
  const WallContactTable& w = s.wall_contacts;
  const std::size_t rows = w.feature.size();
  bool fit = true;
  WallContactTable::for_each_field(w,
                                   [&](const FieldInfo&, const auto& field) { fit = fit && field.size() == rows; });
  if (!fit || !all_within(w.feature, 0, s.vessel.feature_count()) || !all_within(w.touching, 0, 2)) return false;
  if (w.begin.empty()) return w.grain.empty() && rows == 0;
  const bool ascending =
      std::adjacent_find(w.grain.begin(), w.grain.end(), [](Index a, Index b) { return a >= b; }) == w.grain.end();
  return ascending && all_within(w.grain, 0, s.particles.count()) && cuts(w.begin, w.grain.size(), rows);
}

}  // namespace

void check_consistency(const State& state, const std::string& path) {
  const char* wrong = !images_fit(state)          ? "the images"
                      : !grains_fit(state)        ? "the grains"
                      : !contacts_fit(state)      ? "the contacts of grains"
                      : !wall_contacts_fit(state) ? "the contacts with walls"
                                                  : nullptr;
  if (wrong != nullptr)
    throw_file_error(
        path, std::string("the checkpoint is damaged: lengths or indices of ") + wrong + " do not fit together");
}

}  // namespace wedge

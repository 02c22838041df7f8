// analysed_beds.hpp: beds laid by hand, as wedge analyse sees them: the vessel, grains and contacts of a frame,
// sums.
#pragma once

#include "apps/analysis/moment_sums.hpp"
#include "apps/analysis/results.hpp"
#include "core/time_scales.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/experiment.hpp"

namespace wedge::test {
inline constexpr double R = 0.0025, d = 2 * R;
inline const double mass = sphere_mass(R, 3800);

/// A vessel 40 d wide: the full one, or a sector of it.
inline MeasuredDomain vessel(int order = 1, AxisRule axis = AxisRule::clamp) {
  Scene scene = hopper_material();
  scene.domain.gravity = {0, 0, -9.81};
  add_wall(scene, "shell", {{20 * d, 0}, {20 * d, 60 * d}});
  add_wall(scene, "floor", {{4 * d, 0}, {20 * d, 0}});
  add_wall(scene, "plug", {{0, 0}, {4 * d, 0}});
  if (order > 1) make_sector(scene, order, axis);
  return describe_domain(scene, make_domain(scene).symmetry, d);
}

/// As read from a frame without contacts: contacts are overlaps.
inline Bed bed_of(const MeasuredDomain& run, const std::vector<Grain>& grains) {
  return bed_of_frame(run, make_state(run.scene, grains), nullptr);
}

/// A contact as a frame lists it; `way` leads from the first grain to the second.
struct Touch {
  int first, second, turn;
  double load;  // N
};

inline Bed bed_of(const MeasuredDomain& run, const std::vector<Grain>& grains, const std::vector<Touch>& touches) {
  ContactFrame contacts;
  contacts.first_position.resize(touches.size());
  contacts.second_position.resize(touches.size());
  contacts.normal_force.resize(touches.size());
  contacts.tangential_force.resize(touches.size());
  for (std::size_t c = 0; c < touches.size(); ++c) {
    const Touch& t = touches[c];
    contacts.first_id.push_back(t.first);
    contacts.second_id.push_back(t.second);
    contacts.turn.push_back(t.turn);
    contacts.normal_load.push_back(t.load);
    const Vec3 from = grains[static_cast<std::size_t>(t.first)].x;
    const Vec3 to = run.symmetry.turn_point(grains[static_cast<std::size_t>(t.second)].x, t.turn);
    contacts.first_position.set(c, from);
    contacts.second_position.set(c, to);
    contacts.normal_force.set(c, (-t.load / norm(to - from)) * (to - from));
    contacts.tangential_force.set(c, {0, 0, 0});
  }
  return bed_of_frame(run, make_state(run.scene, grains), &contacts);
}

inline std::vector<Grain> lattice(int nx, int ny, int nz, double spacing) {
  std::vector<Grain> grains;
  for (int k = 0; k < nz; ++k)
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i)
        grains.push_back(
            {R, {(i - 0.5 * (nx - 1)) * spacing, (j - 0.5 * (ny - 1)) * spacing, (k + 2) * spacing}, {}, {}});
  return grains;
}

/// Cells d wide and high over the whole vessel and a margin outside it.
inline FieldGrid wide_grid(const MeasuredDomain& run) {
  FieldGrid grid;
  grid.left = run.left;
  grid.low = -10 * d;
  grid.width = d;
  grid.height = d;
  grid.columns = 30;
  grid.rows = 80;
  grid.smoothing = d;
  return grid;
}

inline PartSums sums_of(const MeasuredDomain& run, const Bed& bed, const Part& part) {
  PartSums sums(run, part, wide_grid(run), mass);
  sums.add(bed);
  return sums;
}
inline PartSums sums_of(const MeasuredDomain& run, const Bed& bed) {
  return sums_of(run, bed, make_parts(run, {}).front());
}

/// The integrals of packing and pressures over the volume of the grid.
inline CellFields over_space(const PartSums& sums) {
  CellFields all;
  all.packing = all.prr = all.ptt = all.pzz = all.prz = 0;
  for (int row = 0; row < sums.grid().rows; ++row) {
    for (int column = 0; column < sums.grid().columns; ++column) {
      const CellFields c = cell_fields(sums, column, row);
      const double volume = sums.grid().volume(column);
      all.packing += c.packing * volume;
      if (!(c.grains > 0)) continue;  // no pressure where nothing reaches
      all.prr += c.prr * volume;
      all.ptt += c.ptt * volume;
      all.pzz += c.pzz * volume;
      all.prz += c.prz * volume;
    }
  }
  return all;
}

inline double number(const PartSums& sums, const std::string& name) {
  for (const Scalar& s : sums.scalars())
    if (s.quantity->name == name) return s.estimate.value;
  FAIL("no number " << name);
  return 0;
}

inline std::size_t kind(const PartSums& sums, const std::string& name) {
  for (std::size_t k = 0; k < sums.kinds().size(); ++k)
    if (sums.kinds()[k].quantity->name == name) return k;
  FAIL("no distribution " << name);
  return 0;
}

/// Counts of whole numbers: by value.
inline double count_of(const PartSums& sums, const std::string& name, int value) {
  const auto& counts = sums.histogram(0, kind(sums, name)).counts();
  const auto found = counts.find(value);
  return found == counts.end() ? 0 : found->second;
}
}  // namespace wedge::test

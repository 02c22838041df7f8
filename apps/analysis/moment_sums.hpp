// moment_sums.hpp: what the frames of a moment add up to in one part of the bed: distributions, rings, fields,
// numbers.
#pragma once

#include <string_view>
#include <utility>
#include <vector>

#include "apps/analysis/coarse_graining.hpp"
#include "apps/analysis/histogram.hpp"
#include "apps/measure/bed.hpp"
#include "apps/measure/part.hpp"
#include "apps/results/scalar.hpp"

namespace wedge {

/// A quantity whose distribution is taken.
struct DistributionKind {
  const ResultQuantity* quantity;
  Bins bins;
};
/// Those of the vocabulary, in its order.
std::vector<DistributionKind> distribution_kinds(const MeasuredDomain& domain, double mean_mass);

/// What a cell of the map carries, per volume of space.
enum FieldIndex {
  field_count,
  field_volume,
  field_cn,
  field_cn_near,
  field_cn_distinct,
  field_mass,
  field_mvr,
  field_mvt,
  field_mvz,
  field_mvrvr,
  field_mvtvt,
  field_mvzvz,
  field_mvrvz,
  grain_fields
};
enum StressIndex { stress_rr, stress_tt, stress_zz, stress_rz, stress_fields };

/// Sums over bulk grains of a ring d/2 wide.
struct Ring {
  double grains = 0, cn = 0, cn_near = 0, cn_distinct = 0, vr = 0, vt = 0, vz = 0,
         squares = 0;  // squares: of v, m2/s2
};

/// Sums for a straight line y = slope x + intercept.
struct LineSums {
  double n = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0;
  void add(double at, double value);
  /// Slope and intercept with 1.96 standard errors; `repeats`: frames that show the same grains again.
  std::pair<Estimate, Estimate> fit(double repeats) const;
};

class PartSums {
public:
  PartSums(const MeasuredDomain& domain, const Part& part, const FieldGrid& grid, double mean_mass);
  void add(const Bed& bed);

  const Part& part() const { return part_; }
  int frames() const { return frames_; }
  const std::vector<DistributionKind>& kinds() const { return kinds_; }
  /// Of region r (of part().regions) and kind k, summed over frames.
  const Histogram& histogram(std::size_t region, std::size_t kind) const;
  const std::vector<Ring>& rings() const { return rings_; }
  double ring_width() const { return 0.5 * domain_.diameter; }
  /// Per cell, summed over frames: grain_fields and stress_fields numbers.
  const std::vector<double>& fields() const { return fields_; }
  const std::vector<double>& stresses() const { return stresses_; }
  const FieldGrid& grid() const { return grid_; }
  /// Means over frames of what each frame has, and fits over all of them.
  std::vector<Scalar> scalars() const;
  /// One of the means over frames; nan where there is none.
  double mean(std::string_view scalar) const;
  /// Mean coordination number of bulk grains at arcs of axis_zone_arc and more, but not within 2 d of the widest
  /// wall; nan where there are none.
  double outer_cn() const;
  /// What the paper's line says the number of distinct neighbours is short of, as a factor, at r [m]: CN0 / (k arc
  /// + b).
  double correction(double r) const;
  /// r theta / d, nan in a slot.
  double arc(double r) const;
  bool has_forces() const { return has_forces_; }

private:
  /// Counts a value at r [m] in the regions that hold it; what is no number is not counted.
  void count(double r, std::size_t kind, double value);
  void add_distributions(const Bed& bed);
  void add_rings(const Bed& bed);
  void add_fields_of(const Bed& bed);
  void add_scalars(const Bed& bed);

  const MeasuredDomain& domain_;
  Part part_;
  FieldGrid grid_;
  std::vector<DistributionKind> kinds_;
  std::vector<Histogram> histograms_;
  std::vector<Ring> rings_;
  std::vector<double> fields_, stresses_;
  LineSums distinct_line_;  // the same of distinct neighbours
  LineSums inner_line_;     // CN against arc, arcs below axis_zone_arc
  double outer_grains_ = 0, outer_sum_ = 0;
  struct Mean {
    Scalar last;  // of the last frame, whose interval stands for all: they show the same grains
    double sum = 0, count = 0;
  };
  std::vector<Mean> means_;
  int frames_ = 0;
  bool has_forces_ = true;
};

}  // namespace wedge

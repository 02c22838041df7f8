// observables.cpp: scalars and distributions of two sets of runs as samples; moments; domains.
#include "apps/comparison/observables.hpp"

#include <algorithm>
#include <cmath>

#include "apps/comparison/field_observables.hpp"
#include "apps/comparison/gathered.hpp"

namespace wedge {
namespace {

constexpr double normal_95 = 1.959963984540054;

Sample scalar_sample(double value) { return {Eigen::ArrayXd::Constant(1, value), Eigen::ArrayXd::Ones(1)}; }

/// A run's own standard error, of its interval.
double own_error(const ScalarResult& scalar) { return (scalar.high - scalar.low) / (2 * normal_95); }

Observable scalar_observable(const RunSets& sets, const std::string& moment, const std::string& quantity) {
  Observable o;
  o.kind = Kind::scalar;
  o.region = name_of(RegionKind::all);
  o.quantity = quantity;
  const auto gathered = gather<ScalarResult>(sets, [&](const RunResults& run, const std::string& part) {
    const auto found = run.scalars.find({moment, part, o.region, quantity});
    return found == run.scalars.end() || !std::isfinite(found->second.value) ? nullptr : &found->second;
  });
  for (const auto& run : gathered.reference) {
    std::vector<Sample> wedges;
    for (const ScalarResult* wedge : run.wedges) wedges.push_back(scalar_sample(wedge->value));
    if (!run.whole && wedges.empty()) continue;
    // What only sectors and wedges have (the slope of CN against the arc): a vessel is then its wedges.
    o.reference.push_back(run.whole ? scalar_sample(run.whole->value) : scalar_sample(pool_of(wedges).value[0]));
    o.reference_errors.push_back(run.whole ? own_error(*run.whole) : std::nan(""));
    o.wedges.push_back(std::move(wedges));
  }
  for (const ScalarResult* run : gathered.compared) {
    o.compared.push_back(scalar_sample(run->value));
    o.compared_errors.push_back(own_error(*run));
  }
  return o;
}

/// Edges of all, each once: those of one scale differ by rounding at most.
Eigen::ArrayXd common_edges(const std::vector<const DistributionResult*>& all) {
  std::vector<double> edges;
  for (const DistributionResult* one : all) edges.insert(edges.end(), one->edges.begin(), one->edges.end());
  std::sort(edges.begin(), edges.end());
  const double rounding = 1e-12 * (edges.back() - edges.front());
  edges.erase(std::unique(edges.begin(), edges.end(), [&](double a, double b) { return b - a <= rounding; }),
              edges.end());
  return Eigen::Map<Eigen::ArrayXd>(edges.data(), static_cast<Eigen::Index>(edges.size()));
}

/// Grains below each of `edges`, in proportion inside a bin.
Sample distribution_sample(const DistributionResult& distribution, const Eigen::ArrayXd& edges) {
  Sample sample{Eigen::ArrayXd(edges.size()), Eigen::ArrayXd::Constant(edges.size(), distribution.counts.sum())};
  double below = 0;  // grains in the bins before bin b
  Eigen::Index b = 0;
  for (Eigen::Index k = 0; k < edges.size(); ++k) {
    while (b < distribution.counts.size() && edges[k] >= distribution.edges[b + 1])
      below += distribution.counts[b++];
    double inside = 0;
    if (b < distribution.counts.size() && edges[k] > distribution.edges[b])
      inside = (edges[k] - distribution.edges[b]) / (distribution.edges[b + 1] - distribution.edges[b]);
    sample.content[k] = below + (inside > 0 ? inside * distribution.counts[b] : 0);
  }
  return sample;
}

/// In a region of the compared runs' angle.
Observable distribution_observable(const RunSets& sets, const std::string& moment, const std::string& quantity,
                                   RegionKind region) {
  Observable o;
  o.kind = Kind::distribution;
  o.region = name_of(region);
  o.quantity = quantity;
  const std::string named = name_of(RegionId{region, sets.compared[0].order});
  std::vector<const DistributionResult*> all;
  const auto gathered = gather<DistributionResult>(sets, [&](const RunResults& run, const std::string& part) {
    const auto found = run.distributions.find({moment, part, named, quantity});
    const bool told = found != run.distributions.end() && found->second.counts.sum() > 0;
    if (told) all.push_back(&found->second);
    return told ? &found->second : nullptr;
  });
  if (all.empty()) return o;
  o.bins = {common_edges(all), all[0]->whole_numbers};
  const auto sample = [&](const DistributionResult* one) { return distribution_sample(*one, o.bins.edges); };
  put_samples(gathered, sample, o);
  return o;
}

bool is_velocity(const ResultQuantity& quantity) { return std::string_view(quantity.unit) == "m/s"; }

/// Whether all grains are in bins that reach zero.
bool beside_zero(const DistributionResult& distribution) {
  const Eigen::ArrayXd& edges = distribution.edges;
  for (Eigen::Index k = 0; k < distribution.counts.size(); ++k)
    if (distribution.counts[k] > 0 && (edges[k] > 0 || edges[k + 1] < 0)) return false;
  return true;
}

/// Distributions of velocities of a moment: whether there are any, and whether they tell no more than signs.
struct Unresolved {
  bool any = false, all = true;
};
Unresolved unresolved_velocities(const std::vector<RunResults>& runs, const std::string& moment) {
  Unresolved found;
  for (const RunResults& run : runs) {
    for (const auto& [name, distribution] : run.distributions) {
      if (name.moment != moment || !is_velocity(quantity(name.quantity))) continue;
      found.any = true;
      found.all = found.all && beside_zero(distribution);
    }
  }
  return found;
}

template <class T>
void append_missing(std::vector<T>& list, const T& entry) {
  if (std::find(list.begin(), list.end(), entry) == list.end()) list.push_back(entry);
}

}  // namespace

Design design_of(const RunSets& sets) {
  const RunResults &reference = sets.reference[0], &compared = sets.compared[0];
  Design design;
  design.alike = reference.slot == compared.slot && reference.order == compared.order;
  if (sets.wedge_order > 0) {
    design.wedges_per_reference = std::max(1, sets.wedge_order / reference.order);
    design.wedges_per_compared = std::max(1, sets.wedge_order / compared.order);
  }
  return design;
}

bool has_axis_zone(const RunSets& sets) { return !sets.compared[0].slot && sets.compared[0].order > 1; }

double axis_zone_radius(const RunSets& sets) {
  const RunResults& run = sets.compared[0];
  return has_axis_zone(sets) ? axis_zone_edge(run.order, run.diameter) : 0;
}

bool is_compared(const ResultQuantity& quantity, const RunSets& sets) {
  const bool sum = quantity.kind == QuantityKind::extensive || quantity.kind == QuantityKind::per_height;
  return quantity.compared() && !(sum && sets.reference[0].slot != sets.compared[0].slot);
}

std::vector<std::string> common_moments(const RunSets& sets) {
  std::vector<std::string> first, both;
  for (const RunResults& run : sets.reference)
    for (const std::string& moment : run.moments) append_missing(first, moment);
  for (const std::string& moment : first)
    if (std::any_of(sets.compared.begin(), sets.compared.end(), [&](const RunResults& run) {
          return std::find(run.moments.begin(), run.moments.end(), moment) != run.moments.end();
        }))
      both.push_back(moment);
  return both;
}

bool velocities_at_rest(const RunSets& sets, const std::string& moment) {
  const Unresolved reference = unresolved_velocities(sets.reference, moment),
                   compared = unresolved_velocities(sets.compared, moment);
  return reference.any && compared.any && reference.all && compared.all;
}

std::vector<Observable> observables(const RunSets& sets, const std::string& moment) {
  std::vector<Observable> all;
  const bool at_rest = velocities_at_rest(sets, moment);
  const auto keep = [&](Observable o) {
    if (o.reference.empty() || o.compared.empty() || (at_rest && is_velocity(quantity(o.quantity)))) return;
    o.moment = moment;
    o.unit = quantity(o.quantity).unit;
    all.push_back(std::move(o));
  };
  const auto compared = [&](ResultTable table) {
    std::vector<const ResultQuantity*> found;
    for (const ResultQuantity* q : quantities_in(table))
      if (is_compared(*q, sets)) found.push_back(q);
    return found;
  };
  std::vector<RegionKind> regions{RegionKind::all};
  if (has_axis_zone(sets)) regions.insert(regions.end(), {RegionKind::axis_zone, RegionKind::rest});
  for (const ResultQuantity* q : compared(in_scalars)) keep(scalar_observable(sets, moment, q->name));
  for (const ResultQuantity* q : compared(in_distributions))
    for (const RegionKind region : regions) keep(distribution_observable(sets, moment, q->name, region));
  for (const auto& [kind, table] : {std::pair{Kind::profile, in_profile}, std::pair{Kind::map, in_map}}) {
    for (Observable& o : field_observables(sets, moment, kind, compared(table))) keep(std::move(o));
  }
  return all;
}

}  // namespace wedge

// part.cpp: cuts a domain into wedges and regions.
#include "apps/measure/part.hpp"

#include <algorithm>
#include <cmath>

#include "core/random.hpp"
#include "core/time_scales.hpp"

namespace wedge {
namespace {

constexpr std::uint32_t wedge_stream = 0x77656467;  // of the random numbers of a seed: "wedg"

/// Axis zone and rest of a sector of this order; no rest where the axis zone is all there is.
void add_regions(std::vector<Region>& regions, int order, const MeasuredDomain& domain) {
  const double edge = axis_zone_edge(order, domain.diameter);
  regions.push_back({{RegionKind::axis_zone, order}, 0, edge});
  if (edge < domain.radius) regions.push_back({{RegionKind::rest, order}, edge});
}

}  // namespace

bool Part::holds(double azimuth) const {
  if (id.whole()) return true;
  double turned = azimuth - begin;
  if (turned < 0) turned += 2 * numbers::pi;
  return turned < angle;
}

Part whole_part(const MeasuredDomain& domain) {
  Part whole;
  whole.angle = domain.theta;
  whole.regions = {Region{}};
  if (domain.order > 1) add_regions(whole.regions, domain.order, domain);
  return whole;
}

std::vector<Part> make_parts(const MeasuredDomain& domain, const PartRequest& request) {
  std::vector<Part> parts = {whole_part(domain)};
  if (domain.scene.domain.kind != DomainKind::full) return parts;
  for (const int order : request.orders) add_regions(parts.front().regions, order, domain);
  RandomStream stream(domain.scene.particles.seed, wedge_stream);
  for (const int order : request.orders) {
    const double begin = stream.uniform(0, 2 * numbers::pi);
    for (int k = 0; k < std::min(request.wedges, order); ++k) {
      Part wedge;
      wedge.id = {order, k};
      wedge.pieces = order;
      wedge.angle = 2 * numbers::pi / order;
      wedge.begin = std::fmod(begin + k * wedge.angle, 2 * numbers::pi);
      wedge.regions = {Region{}};
      add_regions(wedge.regions, order, domain);
      parts.push_back(wedge);
    }
  }
  return parts;
}

}  // namespace wedge

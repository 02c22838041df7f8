// analysed_run.cpp: opens a run for analysis; cuts it into parts and regions.
#include "apps/analysis/analysed_run.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "apps/setup/setup.hpp"
#include "core/random.hpp"
#include "core/time_scales.hpp"
#include "io/files/frame.hpp"
#include "io/scene/scene_file.hpp"
#include "io/tables/csv.hpp"

namespace wedge {
namespace {

constexpr std::uint32_t wedge_stream = 0x77656467;  // of the random numbers of a seed: "wedg"

Region inside(int order, double edge) { return {"core_" + degrees_text(order), 0, edge}; }
Region outside(int order, double edge) { return {"rest_" + degrees_text(order), edge}; }

/// Core and rest of a sector of this order; no rest where the core is all there is.
void add_regions(std::vector<Region>& regions, int order, const AnalysedRun& run) {
  const double edge = core_arc * run.diameter * order / (2 * numbers::pi);
  regions.push_back(inside(order, edge));
  if (edge < run.radius) regions.push_back(outside(order, edge));
}

}  // namespace

std::string degrees_text(int order) { return number_text(std::round(360e6 / order) / 1e6); }

double AnalysedRun::cross_section() const {
  return slot ? 2 * radius * scene.domain.slot_width : numbers::pi * radius * radius;
}

AnalysedRun describe_run(const RunFolder& folder, Scene scene, double diameter) {
  const State domain = make_domain(scene);
  AnalysedRun run{folder, std::move(scene), domain.symmetry};
  run.diameter = diameter;
  run.slot = run.scene.domain.kind == DomainKind::slot;
  run.order = run.scene.domain.kind == DomainKind::sector ? run.scene.domain.order : 1;
  run.theta = 2 * numbers::pi / run.order;
  double low = std::numeric_limits<double>::infinity(), left = low, right = -low;
  for (const WallDescription& wall : run.scene.walls) {
    for (const Eigen::Vector2d& point : wall.profile) {
      left = std::min(left, point.x());
      right = std::max(right, point.x());
      low = std::min(low, point.y());
    }
  }
  if (!(right > 0))
    throw FileError(folder.path() + ": the scene has no walls; a vessel is needed to analyse a run");
  run.left = run.slot ? left : 0;
  run.radius = run.slot ? (right - left) / 2 : right;
  run.lowest_wall = low;
  return run;
}

AnalysedRun open_run(const std::string& folder) {
  const RunFolder files(folder);
  files.require_run();
  const std::string start = files.frame("particles", 0);
  if (!std::filesystem::exists(start)) throw FileError(files.frames() + ": holds no frames of grains to analyse");
  const Particles first = read_particle_frame(start).particles;
  double sum = 0;
  for (Index i = 0; i < first.count(); ++i) sum += 2 * first.radius[static_cast<std::size_t>(i)];
  if (first.count() == 0) throw FileError(files.path() + ": the run has no grains at its start");
  return describe_run(files, read_scene(files.resolved_scene(), {}), sum / first.count());
}

bool Part::holds(double azimuth) const {
  if (whole) return true;
  double turned = azimuth - begin;
  if (turned < 0) turned += 2 * numbers::pi;
  return turned < angle;
}

std::vector<Part> make_parts(const AnalysedRun& run, const PartRequest& request) {
  const bool full = run.scene.domain.kind == DomainKind::full;
  Part whole;
  whole.angle = run.theta;
  whole.copies = run.order;
  whole.regions = {Region{"all"}};
  if (run.order > 1) add_regions(whole.regions, run.order, run);
  if (full)
    for (const int order : request.orders) add_regions(whole.regions, order, run);
  std::vector<Part> parts = {whole};
  if (!full) return parts;
  RandomStream stream(run.scene.particles.seed, wedge_stream);
  for (const int order : request.orders) {
    const double begin = stream.uniform(0, 2 * numbers::pi);
    for (int k = 0; k < std::min(request.wedges, order); ++k) {
      Part wedge;
      wedge.name = "wedge_" + degrees_text(order) + "_" + std::to_string(k);
      wedge.whole = false;
      wedge.copies = order;
      wedge.angle = 2 * numbers::pi / order;
      wedge.begin = std::fmod(begin + k * wedge.angle, 2 * numbers::pi);
      wedge.regions = {Region{"all"}};
      add_regions(wedge.regions, order, run);
      parts.push_back(wedge);
    }
  }
  return parts;
}

}  // namespace wedge

// summary.cpp: summary.json: domain, moments, cost and numbers of a run.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "apps/analysis/results.hpp"
#include "io/files/atomic_file.hpp"
#include "io/scene/names.hpp"
#include "io/tables/csv.hpp"
#include "io/tables/json.hpp"
#include "io/tables/provenance.hpp"

namespace wedge {
namespace {

/// `value` rounded to six digits.
double short_number(double value) {
  if (!std::isfinite(value)) return value;
  char digits[40];
  const auto end = std::to_chars(digits, digits + sizeof digits, value, std::chars_format::general, 6);
  double rounded = value;
  std::from_chars(digits, end.ptr, rounded);
  return rounded;
}

Json domain_object(const AnalysedRun& run) {
  const Domain& domain = run.scene.domain;
  const double orifice = orifice_diameter(run.scene);
  return {{"kind", domain_kind_names.of(domain.kind)},
          {"angle_deg", short_number(360.0 / run.order)},
          {"order", run.order},
          {"sides", sides_names.of(domain.sides)},
          {"axis", axis_names.of(domain.axis)},
          {"diameter_m", short_number(run.diameter)},
          {"radius_m", short_number(run.radius)},
          {"orifice_m", orifice > 0 ? Json(short_number(orifice)) : Json()},
          {"gravity_m_s2", short_number(run.gravity())}};
}

/// Integral of the grains inside over the steps, from series/ledger.csv.
double particle_steps(const AnalysedRun& run, double time_step) {
  const std::string text = read_text_file(run.folder.series("ledger"));
  double sum = 0, time_before = 0, inside_before = 0;
  bool first = true;
  for (std::size_t begin = text.find('\n'); begin != std::string::npos && begin + 1 < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin + 1), text.size());
    const auto fields = split_csv_line(std::string_view(text).substr(begin + 1, end - begin - 1));
    double time = 0, inside = 0;
    if (fields.size() < 3 || parse_number(fields[0].text, time) != NumberError::none ||
        parse_number(fields[2].text, inside) != NumberError::none)
      break;
    if (!first) sum += 0.5 * (inside + inside_before) * (time - time_before) / time_step;
    first = false;
    time_before = time;
    inside_before = inside;
    begin = end;
  }
  return sum;
}

Json cost_object(const AnalysedRun& run, double grains) {
  Json object{{"grains", short_number(grains)}, {"precision", precision_names.of(run.scene.run.precision)}};
  if (!std::filesystem::exists(run.folder.progress())) return object;
  const Progress progress = read_progress(run.folder.progress());
  object["steps"] = progress.step;
  object["simulated_s"] = short_number(progress.time);
  object["wall_seconds"] = short_number(progress.wall_seconds);
  if (std::filesystem::exists(run.folder.series("ledger"))) {
    const double steps = particle_steps(run, progress.time_step);
    object["particle_steps"] = short_number(steps);
    object["particle_steps_per_second"] = short_number(steps / progress.wall_seconds);
  }
  return object;
}

Json scalars_object(const PartResult& part) {
  Json object = Json::object();
  for (const Scalar& scalar : part.scalars) {
    const Estimate& e = scalar.estimate;
    const ResultQuantity& quantity = *scalar.quantity;
    Json& entry = object[quantity.name] = {{"value", short_number(e.value)}};
    if (std::isfinite(e.low)) entry.update({{"low", short_number(e.low)}, {"high", short_number(e.high)}});
    entry["unit"] = quantity.unit;
  }
  return object;
}

}  // namespace

std::string summary_json(const AnalysedRun& run, const std::vector<MomentResult>& results) {
  const std::optional<double> opening = run.opened();
  Json moments = Json::array(), scalars = Json::object();
  for (const MomentResult& result : results) {
    const Moment& m = result.moment;
    const bool after_opening = opening && m.end > *opening;
    moments.push_back({{"name", m.name},
                       {"stage", m.stage},
                       {"kind", name_of(m.kind)},
                       {"role", name_of(m.role)},
                       {"walls", m.walls},
                       {"begin_s", short_number(m.begin)},
                       {"end_s", short_number(m.end)},
                       {"frames", m.frames.size()},
                       {"since_opening_s", after_opening ? Json(short_number(m.end - *opening)) : Json()}});
    scalars[m.name] = scalars_object(result.parts.front());
  }
  double grains = 0;
  if (!results.empty()) grains = results.front().parts.front().sums->mean("grains") / run.order;
  return json_text({{"domain", domain_object(run)},
                    {"seed", run.scene.particles.seed},
                    {"cost", cost_object(run, grains)},
                    {"moments", moments},
                    {"scalars", scalars}});
}

}  // namespace wedge

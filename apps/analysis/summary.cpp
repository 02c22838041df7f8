// summary.cpp: summary.json: domain, moments, cost and numbers of a run.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <variant>

#include "apps/analysis/results.hpp"
#include "io/files/atomic_file.hpp"
#include "io/tables/provenance.hpp"
#include "io/scene/names.hpp"
#include "io/tables/csv.hpp"
#include "io/tables/json.hpp"

namespace wedge {
namespace {

/// An object as the value of a key: without the line break at its end.
std::string value_of(const JsonObject& object) {
  std::string text = object.text();
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text;
}

std::string list_of(const std::vector<std::string>& values) {
  std::string text;
  for (const std::string& value : values) text += (text.empty() ? "" : ", ") + value;
  return "[" + text + "]";
}

/// A number with six digits.
std::string short_json(double value) {
  if (!std::isfinite(value) || value == 0) return json_number(value);
  char digits[40];
  const auto end = std::to_chars(digits, digits + sizeof digits, value, std::chars_format::general, 6);
  return {digits, end.ptr};
}

JsonObject domain_object(const AnalysedRun& run) {
  const Domain& domain = run.scene.domain;
  JsonObject object;
  object.add("kind", domain_kind_names.of(domain.kind));
  object.add_raw("angle_deg", short_json(360.0 / run.order));
  object.add("order", run.order);
  object.add("sides", sides_names.of(domain.sides));
  object.add("axis", axis_names.of(domain.axis));
  object.add_raw("diameter_m", short_json(run.diameter));
  object.add_raw("radius_m", short_json(run.radius));
  object.add_raw("orifice_m", orifice_diameter(run.scene) > 0 ? short_json(orifice_diameter(run.scene)) : "null");
  object.add_raw("gravity_m_s2", short_json(run.gravity()));
  return object;
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

JsonObject cost_object(const AnalysedRun& run, double grains) {
  JsonObject object;
  object.add_raw("grains", short_json(grains));
  object.add("precision", precision_names.of(run.scene.run.precision));
  if (!std::filesystem::exists(run.folder.progress())) return object;
  const Progress progress = read_progress(run.folder.progress());
  object.add("steps", progress.step);
  object.add_raw("simulated_s", short_json(progress.time));
  object.add_raw("wall_seconds", short_json(progress.wall_seconds));
  if (std::filesystem::exists(run.folder.series("ledger"))) {
    const double steps = particle_steps(run, progress.time_step);
    object.add_raw("particle_steps", short_json(steps));
    object.add_raw("particle_steps_per_second", short_json(steps / progress.wall_seconds));
  }
  return object;
}

JsonObject scalars_object(const PartResult& part) {
  JsonObject object;
  for (const Scalar& scalar : part.scalars) {
    const Estimate& e = scalar.estimate;
    std::string value = "{\"value\": " + short_json(e.value);
    if (std::isfinite(e.low)) value += ", \"low\": " + short_json(e.low) + ", \"high\": " + short_json(e.high);
    object.add_raw(scalar.name, value + ", \"unit\": " + json_string(scalar.unit) + "}");
  }
  return object;
}

}  // namespace

std::string summary_json(const AnalysedRun& run, const std::vector<MomentResult>& results) {
  const std::optional<double> opening = opening_time(run);
  std::vector<std::string> moments;
  JsonObject scalars;
  for (const MomentResult& result : results) {
    const Moment& m = result.moment;
    moments.push_back("{\"name\": " + json_string(m.name) + ", \"kind\": \"" + (m.average ? "mean" : "instant") +
                      "\", \"begin_s\": " + short_json(m.begin) + ", \"end_s\": " + short_json(m.end) +
                      ", \"frames\": " + std::to_string(m.frames.size()) + ", \"since_opening_s\": " +
                      (opening && m.end > *opening ? short_json(m.end - *opening) : "null") + "}");
    scalars.add_raw(m.name, value_of(scalars_object(result.parts.front())));
  }
  double grains = 0;
  if (!results.empty()) grains = results.front().parts.front().sums->mean("grains") / run.order;
  JsonObject summary;
  summary.add_raw("domain", value_of(domain_object(run)));
  summary.add_raw("seed", std::to_string(run.scene.particles.seed));
  summary.add_raw("cost", value_of(cost_object(run, grains)));
  summary.add_raw("moments", list_of(moments));
  summary.add_raw("scalars", value_of(scalars));
  return summary.text();
}

}  // namespace wedge

// summary.cpp: summary.json: domain, moments, cost and numbers of a run.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <variant>

#include "apps/analysis/results.hpp"
#include "io/atomic_file.hpp"
#include "io/csv.hpp"
#include "io/json.hpp"
#include "io/scene_names.hpp"

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

JsonObject domain_object(const AnalysedRun& run) {
  const Domain& domain = run.scene.domain;
  JsonObject object;
  object.add("scene", run.scene.name);
  object.add("kind", domain_kind_names.of(domain.kind));
  object.add("angle_deg", 360.0 / run.order);
  object.add("order", run.order);
  object.add("sides", sides_names.of(domain.sides));
  object.add("axis", axis_names.of(domain.axis));
  object.add("diameter_m", run.diameter);
  object.add("radius_m", run.radius);
  object.add("orifice_m", orifice_diameter(run) > 0 ? orifice_diameter(run) : std::nan(""));
  object.add("gravity_m_s2", run.gravity());
  return object;
}

/// Number of a flat JSON object; nan where it has none.
double number_in(const std::vector<std::pair<std::string, std::string>>& object, const std::string& key) {
  double value = std::nan("");
  for (const auto& [name, text] : object)
    if (name == key && parse_number(text, value) != NumberError::none) value = std::nan("");
  return value;
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
  object.add("grains", grains);
  object.add("precision", precision_names.of(run.scene.run.precision));
  if (!std::filesystem::exists(run.folder.progress())) return object;
  const auto progress = parse_flat_json(read_text_file(run.folder.progress()), run.folder.progress());
  const double seconds = number_in(progress, "wall_seconds"), step = number_in(progress, "time_step");
  object.add("steps", number_in(progress, "step"));
  object.add("simulated_s", number_in(progress, "time"));
  object.add("wall_seconds", seconds);
  if (std::filesystem::exists(run.folder.series("ledger"))) {
    const double steps = particle_steps(run, step);
    object.add("particle_steps", std::round(steps));
    object.add("particle_steps_per_second", std::round(steps / seconds));
  }
  return object;
}

JsonObject scalars_object(const PartResult& part) {
  JsonObject object;
  for (const Scalar& scalar : part.scalars) {
    const auto number = [](double value) { return json_number(value); };
    object.add_raw(scalar.name, "{\"value\": " + number(scalar.estimate.value) + ", \"low\": " +
                                    number(scalar.estimate.low) + ", \"high\": " + number(scalar.estimate.high) +
                                    ", \"unit\": " + json_string(scalar.unit) + "}");
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
                      "\", \"begin_s\": " + json_number(m.begin) + ", \"end_s\": " + json_number(m.end) +
                      ", \"frames\": " + std::to_string(m.frames.size()) + ", \"since_opening_s\": " +
                      (opening && m.end > *opening ? json_number(m.end - *opening) : "null") + "}");
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

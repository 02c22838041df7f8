// page.cpp: the page: tables of speed and error, with uncertainties, from the results of the jobs.
#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "io/files/atomic_file.hpp"
#include "io/tables/csv.hpp"
#include "perf/speed_error/plan.hpp"
#include "perf/speed_error/statistics.hpp"

namespace wedge::speed_error {
namespace {

// What stands below this line in the page is written by hand, and kept.
const std::string by_hand = "<!-- by hand from here on: speed_error.sh keeps it -->";

constexpr double resting =
    1e-6;  // m g d: the program's own criterion is 5e-7, the mean of 0.5 m (1e-3 sqrt(g d))^2

std::string formatted(const char* format, double value) {
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}
std::string percent(double part) { return formatted("%.3g", 100 * part); }
/// 1e+07 as 1e7.
std::string short_power(double value) {
  std::string text = formatted("%.0e", value);
  for (const char* clumsy : {"e+0", "e-0"})
    if (const std::size_t place = text.find(clumsy); place != std::string::npos)
      text.replace(place, 3, clumsy[1] == '+' ? "e" : "e-");
  return text;
}
/// "± 0.1", or how it comes that it is not known.
std::string plus_minus(const char* format, double uncertainty) {
  return std::isfinite(uncertainty) ? "± " + formatted(format, uncertainty) : "(one seed)";
}
std::string signed_percent(double part) { return formatted("%+.2g", 100 * part); }

std::string row(const std::vector<std::string>& cells) {
  std::string text = "|";
  for (const std::string& cell : cells) text += " " + cell + " |";
  return text + "\n";
}
std::string head(const std::vector<std::string>& cells) {
  return row(cells) + row(std::vector<std::string>(cells.size(), "---"));
}

std::vector<Column> columns(const std::string& scene) {
  std::vector<Column> all{{"packing", "packing fraction"},
                          {"coordination", "coordination number"},
                          {"overlap", "mean overlap / d"},
                          {"stress", "vertical stress"}};
  if (scene == "hopper") {
    all.push_back({"floor", "load on the floor / weight"});
    all.push_back({"rate", "discharge rate [1/s]"});
  } else {
    all.push_back({"left", "grains left"});
    all.push_back({"angle", "angle of repose [deg]"});
  }
  return all;
}

class Page {
public:
  Page(const Plan& plan, const Store& store) : plan_(plan), store_(store) {}

  std::string text(const std::string& origin);

private:
  std::string introduction(const std::string& origin) const;
  std::string impact_table(const std::string& scene) const;
  std::string error_table(const Table& table, const std::string& scene);
  std::string trend_row(const Table& table, const std::string& scene) const;
  std::string drift_table() const;
  std::string stability_table() const;
  std::string label(const Table& table, const Variant& v) const;
  std::string speed(const std::string& scene, const Variant& v, const char* phase) const;
  std::string cell(const Sample& sample, const Sample& reference);
  std::vector<std::string> plain_cells(const std::string& scene, const Variant& v) const;

  const Plan& plan_;
  const Store& store_;
  int comparisons_ = 0, significant_ = 0;
};

/// What the cells of the tables mean.
std::string legend(Size size) {
  std::string text = R"(
The standard choice, which every table holds, is a step of 10 % of the Rayleigh time, E = 1e7 Pa, the program's own
skin, double precision, the full vessel. Seeds are 1, 2, ...; their number stands above each table.

How to read a cell: difference from the mean of the reference in per cent of it ± its standard error, from the spread
of both over the seeds. **Bold**: beyond the 99 % interval of Welch's comparison of two means. Else it is within the
spread: no error was seen, which does not say that there is none. The row of the reference has means ± standard
errors. *Smallest error that would show* is that interval for the standard choice (where this is the reference, for the last row).

Speeds are simulated time per second of computing over that of the standard choice, in turn within one process, on the
settled bed and with the outlet open: median (least to most of the rounds); time of the process, not of the clock.
`steps` is the exact ratio of simulated time per step.

Vertical stress: the sum over contacts of vertical force times vertical branch, over the sum of weight times height of
all grains, which is what it would be without walls. Heat: mean kinetic energy of a grain after settling, in m g d, the
largest of the seeds; at rest: by the program's own criterion within 1 s. Residual: what the energy budget leaves
unexplained at the end, in per cent of what was dissipated; a run by `wedge` warns beyond 10 % and stops beyond 50 %,
these go on. A hopper has arched when no grain came for 0.25 s before COUNT were out (of the whole vessel); the rate,
between 10 and 90 % of these, is that of the others.

![error against speed](PICTURE)
)";
  const bool quick = size == Size::quick;
  text.replace(text.find("COUNT"), 5, quick ? "200" : "600");
  text.replace(text.find("PICTURE"), 7, quick ? "quick.svg" : "speed_error.svg");
  return text;
}

std::string Page::introduction(const std::string& origin) const {
  std::string text =
      "# Speed against error\n\nHow much accuracy does speed cost, and the other way round, in the time step, the "
      "stiffness, the skin, the precision and the angle of a sector?\n\nMade by `bash "
      "perf/speed_error/speed_error.sh" +
      std::string(plan_.size() == Size::quick ? " --quick" : "") + "` (" + origin + ").\n";
  for (const std::string& scene : scenes) {
    text += "\n- **" + scene + "**: `" + scene_file(scene) + "` with";
    for (const std::string& change : scaled_down(scene, plan_.size())) text += " `--set '" + change + "'`";
  }
  return text + "\n" + legend(plan_.size());
}

std::string Page::impact_table(const std::string& scene) const {
  std::string text = "\n" + scene + ":\n\n" +
                     head({"step, % of Rayleigh", "steps in a contact, 0.1 and 1 m/s", "restitution, 0.1 m/s",
                           "restitution, 1 m/s", "spin, 0.1 m/s", "spin, 1 m/s"});
  std::vector<double> steps{Plan::reference_check};
  steps.insert(steps.end(), plan_.steps().begin(), plan_.steps().end());
  for (const double step : steps) {
    const auto slow = store_.find(Plan::impact_name(scene, step, Plan::slow_impact));
    const auto fast = store_.find(Plan::impact_name(scene, step, Plan::fast_impact));
    if (!slow || !fast) continue;
    const auto both = [](const Result& r, const std::string& name) {
      return formatted("%.2g", 100 * r.at(name)) + " ± " + formatted("%.1g", 100 * r.at(name + "_error"));
    };
    text += row({number_text(step),
                 formatted("%.0f", slow->at("contact_steps")) + ", " + formatted("%.0f", fast->at("contact_steps")),
                 both(*slow, "restitution"), both(*fast, "restitution"), both(*slow, "spin"), both(*fast, "spin")});
  }
  return text;
}

/// Finite values of a quantity over the seeds there are.
Sample sample(const Plan& plan, const Store& store, const std::string& scene, const Variant& v,
              const std::string& key) {
  Sample s;
  for (int seed = 1; seed <= plan.seeds(v); ++seed) {
    const auto result = store.find(Plan::run_name(scene, v, seed));
    if (!result || !result->count(key) || !std::isfinite(result->at(key))) continue;
    s.values.push_back(result->at(key));
  }
  return s;
}

std::string Page::cell(const Sample& s, const Sample& reference) {
  if (s.count() == 0 || reference.count() == 0) return "-";
  if (s.count() < 2 || reference.count() < 2)
    return signed_percent((s.mean() - reference.mean()) / reference.mean()) + " (one seed)";
  const Difference d = difference(s, reference);
  const std::string text = signed_percent(d.value) + " ± " + formatted("%.2g", 100 * d.uncertainty);
  ++comparisons_;
  significant_ += d.significant() ? 1 : 0;
  return d.significant() ? "**" + text + "**" : "within the spread (" + text + ")";
}

std::string Page::label(const Table& table, const Variant& v) const {
  if (table.key == "step") return number_text(v.step) + " %";
  if (table.key == "young") return short_power(v.young) + " Pa";
  if (table.key == "skin") return v.skin > 0 ? number_text(v.skin) + " d" : "the program's own";
  if (table.key == "precision") return v.precision;
  return v.angle == 360 ? "360, full" : number_text(v.angle) + ", " + v.axis;
}

std::string Page::speed(const std::string& scene, const Variant& v, const char* phase) const {
  const auto race = store_.find(Plan::race_name(scene));
  const std::string key = v.name() + phase;
  if (!race || !race->count(key)) return "-";
  return formatted("%.2f", race->at(key)) + " (" + formatted("%.2f", race->at(key + "_low")) + " to " +
         formatted("%.2f", race->at(key + "_high")) + ")";
}

/// Heat, rest, residual, arches: numbers that are not errors.
std::vector<std::string> Page::plain_cells(const std::string& scene, const Variant& v) const {
  const auto of = [&](const char* key) { return sample(plan_, store_, scene, v, key); };
  const auto share = [](const Sample& s) {
    double sum = 0;
    for (const double x : s.values) sum += x;
    return formatted("%.0f", sum) + " of " + std::to_string(s.count());
  };
  const Sample heat = of("heat"), residual = of("residual_end");
  const auto largest = [](const Sample& s) {
    return s.count() > 0 ? *std::max_element(s.values.begin(), s.values.end()) : 0;
  };
  std::vector<std::string> cells{short_power(largest(heat)), share(of("bed_rests")),
                                 residual.count() > 0 ? percent(residual.mean()) : "-", share(of("broke"))};
  cells.push_back(share(of(scene == "hopper" ? "arched" : "pile_rests")));
  return cells;
}

/// Straight line through all runs with steps up to 20 %: change per 10 % of the Rayleigh time.
std::string Page::trend_row(const Table& table, const std::string& scene) const {
  std::vector<std::string> cells{"*trend*: change per 10 % more step, steps up to 20 %", "", "", ""};
  for (const Column& column : columns(scene)) {
    std::vector<double> x, y;
    for (const Variant& v : table.variants) {
      if (v.step > 20) continue;
      for (const double value : sample(plan_, store_, scene, v, column.key).values)
        x.push_back(v.step), y.push_back(value);
    }
    const auto n = static_cast<double>(x.size());
    const Sample xs{x}, ys{y};
    if (n < 4) {
      cells.emplace_back("-");
      continue;
    }
    double along = 0, left = 0;
    const double squares = xs.variance() * (n - 1);
    for (std::size_t k = 0; k < x.size(); ++k) along += (x[k] - xs.mean()) * (y[k] - ys.mean());
    const double slope = along / squares;
    for (std::size_t k = 0; k < x.size(); ++k) left += std::pow(y[k] - ys.mean() - slope * (x[k] - xs.mean()), 2);
    const double error = std::sqrt(left / (n - 2) / squares);
    const std::string text =
        signed_percent(10 * slope / ys.mean()) + " ± " + formatted("%.2g", 1000 * error / ys.mean());
    const bool significant = std::fabs(slope) > student_quantile(n - 2) * error;
    cells.push_back(significant ? "**" + text + "**" : "within the spread (" + text + ")");
  }
  cells.insert(cells.end(), 5, "");
  return row(cells);
}

std::string Page::error_table(const Table& table, const std::string& scene) {
  const Variant& reference = table.variants[table.reference];
  std::vector<std::string> heading{table.title, "steps", "speed, settled", "speed, open"};
  for (const Column& c : columns(scene)) heading.push_back(c.heading);
  for (const char* h : {"heat (largest)", "at rest", "residual, %", "stopped by a guard"}) heading.emplace_back(h);
  heading.emplace_back(scene == "hopper" ? "arched" : "pile at rest");
  std::size_t fewest = 1000, most = 0;  // a page of a stopped command has fewer than the plan
  for (const Variant& v : table.variants) {
    const std::size_t there = sample(plan_, store_, scene, v, "steps").count();
    fewest = std::min(fewest, there);
    most = std::max(most, there);
  }
  const std::string seeds =
      (fewest < most ? std::to_string(fewest) + " to " : "") + std::to_string(most) + " seeds";
  std::string text =
      "\n" + scene + ", " + seeds + ", reference " + label(table, reference) + ":\n\n" + head(heading);
  std::vector<std::string> seen{"*smallest error that would show*, %", "", "", ""};
  for (const Variant& v : table.variants) {
    const bool is_reference = v.name() == reference.name();
    std::vector<std::string> cells{label(table, v) + (is_reference ? ", reference" : ""),
                                   formatted("%.3g", v.step / 10 * std::sqrt(1e7 / v.young)),
                                   speed(scene, v, ":rest"), speed(scene, v, ":flow")};
    for (const Column& c : columns(scene)) {
      const Sample mine = sample(plan_, store_, scene, v, c.key);
      const Sample base = sample(plan_, store_, scene, reference, c.key);
      if (is_reference)
        cells.push_back(formatted("%.4g", base.mean()) + " " + plus_minus("%.2g", base.standard_error()));
      else
        cells.push_back(cell(mine, base));
      const bool shows = is_reference ? table.reference == 0 && v.name() == "standard" : v.name() == "standard";
      if (!shows) continue;
      const Sample other =
          is_reference ? sample(plan_, store_, scene, table.variants.back(), c.key) : base;  // as good a comparison
      seen.push_back(percent(mine.count() > 1 && other.count() > 1 ? difference(mine, other).bound : 0));
    }
    for (const std::string& c : plain_cells(scene, v)) cells.push_back(c);
    text += row(cells);
  }
  seen.resize(heading.size());
  text += row(seen);
  return table.key == "step" ? text + trend_row(table, scene) : text;
}

std::string Page::stability_table() const {
  std::vector<std::string> heading{"scene", "E [Pa]", "damping", "mean overlap / d"};
  for (const double step : long_steps) heading.push_back(number_text(step) + " %");
  std::string text = head(heading);
  for (const std::string& scene : scenes) {
    for (const Firmness f : plan_.beds()) {
      const auto r = store_.find(Plan::stability_name(scene, f));
      if (!r) continue;
      std::vector<std::string> cells{scene, short_power(f.young), number_text(f.damping),
                                     formatted("%.2g", r->at("overlap"))};
      for (const double step : long_steps) {
        const double heat = r->at("heat" + number_text(step));
        const bool rests = heat < resting;
        cells.push_back(std::isfinite(heat) ? (rests ? "rests" : "**" + short_power(heat) + "**") : "**stopped**");
      }
      text += row(cells);
    }
  }
  return text;
}

std::string Page::drift_table() const {
  std::string text = head({"scene", "against double precision", "after 10 steps", "after 100", "after 1000"});
  for (const std::string& scene : scenes) {
    for (const std::string& other : plan_.drifters()) {
      std::vector<std::string> cells{scene, other == "nudged" ? "double, places moved by their last bit" : other};
      for (const char* after : {"after10", "after100", "after1000"}) {
        Sample rms;
        double largest = 0;
        for (int seed = 1; seed <= Plan::drift_seeds; ++seed) {
          const auto r = store_.find(Plan::drift_name(scene, other, seed));
          if (!r) continue;
          rms.values.push_back(r->at(after));
          largest = std::max(largest, r->at(std::string(after) + "_largest"));
        }
        cells.push_back(rms.count() == 0
                            ? "-"
                            : formatted("%.1e", rms.mean()) + " " + plus_minus("%.0e", rms.standard_error()) +
                                  ", largest " + formatted("%.1e", largest));
      }
      text += row(cells);
    }
  }
  return text;
}

std::string Page::text(const std::string& origin) {
  const std::string places = plan_.size() == Size::quick ? "3" : "16";
  std::string body =
      "\n## Impacts\n\nA grain hits a resting one at 10, 25, 40, 55 and 70 degrees off the line of " +
      ("centres, the first touch at " + places) + R"( places within a step: root mean square error of
the restitution and of the final spin, in per cent of their own root mean square, ± its uncertainty by these places;
against 0.05 % of the Rayleigh time. The first row shows what error is left in that reference: less than the row itself.
)";
  for (const std::string& scene : scenes) body += impact_table(scene);
  for (const Table& table : plan_.tables()) {
    body += "\n## " + table.title + "\n";
    for (const std::string& scene : scenes) body += error_table(table, scene);
  }
  body += R"(
## Stability of a bed at rest

A bed (seed 1) that came to rest at the standard step (damping ratio 0.6: at 5 %) goes on at another one for 1000
Rayleigh times: mean kinetic energy of a grain in m g d, "rests" below 1e-6, "stopped" by a guard against overlap. Soft
grains stand here for deep beds too, whose overlaps are as large.

)" + stability_table();
  body += R"(
## Drift of trajectories

Root mean square distance of equal grains, in d, from one moment of the flow on; mean of the seeds ± standard error. The
first line of a scene is what chaos makes of round-off alone.

)" + drift_table();
  const std::string count = "\nOf the " + std::to_string(comparisons_) + " comparisons with a reference above, " +
                            std::to_string(significant_) + " are bold; " + formatted("%.1f", 0.01 * comparisons_) +
                            " would be by chance alone.\n";
  return introduction(origin) + body + count;
}

}  // namespace

void write_page(const std::string& base, const Plan& plan, const Store& store, const std::string& origin) {
  const std::string path = base + ".md";
  std::string kept = "\n" + by_hand + "\n";
  if (std::filesystem::exists(path)) {
    const std::string before = read_text_file(path);
    const std::size_t place = before.find(by_hand);
    if (place != std::string::npos) kept = "\n" + before.substr(place);
  }
  write_text_file_atomically(path, Page(plan, store).text(origin) + kept);
  write_plot(base + ".svg", plan, store);
}

}  // namespace wedge::speed_error

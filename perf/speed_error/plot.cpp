// plot.cpp: the picture: error against speed as the time step varies, one panel for each scene.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "io/files/atomic_file.hpp"
#include "io/tables/csv.hpp"
#include "perf/speed_error/plan.hpp"
#include "perf/speed_error/statistics.hpp"

namespace wedge::speed_error {
namespace {

constexpr double left = 75, top = 60, width = 430, height = 400, gap = 90;  // pixels, of a panel
constexpr double x_low = 0.15, x_high = 5;                                  // simulated time per step, standard = 1
constexpr double y_low = 1e-3, y_high = 300;                                // %

struct Series {
  const char* key;
  const char* words;
  const char* colour;
};

std::string pixels(double value) { return number_text(std::round(10 * value) / 10); }

class Panel {
public:
  explicit Panel(double origin) : origin_(origin) {}
  double x(double speed) const { return origin_ + width * std::log(speed / x_low) / std::log(x_high / x_low); }
  double y(double error) const {
    const double inside = std::clamp(error, y_low, y_high);
    return top + height * (1 - std::log(inside / y_low) / std::log(y_high / y_low));
  }
  void line(double x1, double y1, double x2, double y2, const std::string& style) {
    text_ += "<line x1=\"" + pixels(x1) + "\" y1=\"" + pixels(y1) + "\" x2=\"" + pixels(x2) + "\" y2=\"" +
             pixels(y2) + "\" " + style + "/>\n";
  }
  void words(double px, double py, const std::string& words, const std::string& style) {
    text_ += "<text x=\"" + pixels(px) + "\" y=\"" + pixels(py) + "\" " + style + ">" + words + "</text>\n";
  }
  void add(const std::string& piece) { text_ += piece + "\n"; }
  double origin() const { return origin_; }
  const std::string& text() const { return text_; }

private:
  double origin_;
  std::string text_;
};

void draw_frame(Panel& p, const std::string& scene) {
  p.add("<rect x=\"" + pixels(p.origin()) + "\" y=\"" + pixels(top) + "\" width=\"" + pixels(width) +
        "\" height=\"" + pixels(height) + "\" fill=\"none\" stroke=\"#444\"/>");
  p.words(p.origin(), top - 12, scene, "font-size=\"17\"");
  for (const double step : {2, 5, 10, 15, 20, 30, 40}) {
    const double at = p.x(step / 10);
    p.line(at, top + height, at, top + height + 5, "stroke=\"#444\"");
    p.words(at, top + height + 19, number_text(step / 10), "text-anchor=\"middle\"");
    p.words(at, top + height + 34, number_text(step) + " %", "text-anchor=\"middle\" fill=\"#777\"");
  }
  for (const double error : {0.001, 0.01, 0.1, 1.0, 10.0, 100.0}) {
    p.line(p.origin(), p.y(error), p.origin() + width, p.y(error), "stroke=\"#ddd\"");
    p.words(p.origin() - 8, p.y(error) + 5, number_text(error), "text-anchor=\"end\"");
  }
  p.words(p.origin() + width / 2, top + height + 54,
          "simulated time per step, standard = 1 (step, % of the Rayleigh time)", "text-anchor=\"middle\"");
  const std::string middle = pixels(top + height / 2), at = pixels(p.origin() - 52);
  p.add("<text x=\"" + at + "\" y=\"" + middle + "\" text-anchor=\"middle\" transform=\"rotate(-90 " + at + " " +
        middle + ")\">error [%]</text>");
}

/// A line through points (speed, error); not-a-number is left out.
void draw_line(Panel& p, const std::vector<std::pair<double, double>>& points, const std::string& style) {
  std::string list;
  for (const auto& [speed, error] : points)
    if (error > 0) list += pixels(p.x(speed)) + "," + pixels(p.y(error)) + " ";
  p.add("<polyline points=\"" + list + "\" fill=\"none\" stroke-width=\"2\" " + style + "/>");
}

void draw_impacts(Panel& p, const std::string& scene, const Plan& plan, const Store& store) {
  for (const char* key : {"restitution", "spin"}) {
    for (const double speed : {Plan::slow_impact, Plan::fast_impact}) {
      std::vector<std::pair<double, double>> points;
      for (const double step : plan.steps())
        if (const auto r = store.find(Plan::impact_name(scene, step, speed)))
          points.emplace_back(step / 10, 100 * r->at(key));
      draw_line(p, points,
                std::string("stroke=\"") + (key[0] == 'r' ? "#1f77b4" : "#2ca02c") + "\"" +
                    (speed == Plan::slow_impact ? " stroke-dasharray=\"5 4\"" : ""));
    }
  }
}

Sample sample(const Plan& plan, const Store& store, const std::string& scene, double step, const char* key) {
  Sample s;
  Variant v;
  v.step = step;
  for (int seed = 1; seed <= plan.seeds(v); ++seed) {
    const auto r = store.find(Plan::run_name(scene, v, seed));
    if (r && r->count(key) && std::isfinite(r->at(key))) s.values.push_back(r->at(key));
  }
  return s;
}

void draw_residual(Panel& p, const std::string& scene, const Plan& plan, const Store& store) {
  std::vector<std::pair<double, double>> points;
  for (const double step : plan.steps()) {
    const Sample s = sample(plan, store, scene, step, "residual_end");
    if (s.count() > 0) points.emplace_back(step / 10, 100 * std::fabs(s.mean()));
  }
  draw_line(p, points, "stroke=\"#000\" stroke-dasharray=\"2 3\"");
}

/// Differences from the smallest step: a disc with its standard error where an error shows, else an open triangle
/// at the bound of 99 % confidence: the error is below it.
void draw_bed(Panel& p, const std::string& scene, const Plan& plan, const Store& store,
              const std::vector<Series>& all) {
  double shift = 0.94;
  for (const Series& series : all) {
    const Sample reference = sample(plan, store, scene, plan.steps().front(), series.key);
    for (const double step : plan.steps()) {
      const Sample s = sample(plan, store, scene, step, series.key);
      if (step == plan.steps().front() || s.count() < 2 || reference.count() < 2) continue;
      const Difference d = difference(s, reference);
      const double at = p.x(shift * step / 10), error = 100 * std::fabs(d.value), spread = 100 * d.uncertainty;
      const std::string paint = std::string("stroke=\"") + series.colour + "\" fill=\"";
      if (d.significant()) {
        p.line(at, p.y(error - spread), at, p.y(error + spread), paint + "none\"");
        p.add("<circle cx=\"" + pixels(at) + "\" cy=\"" + pixels(p.y(error)) + "\" r=\"4\" " + paint +
              series.colour + "\"/>");
      } else {
        const double y = p.y(error + 100 * d.bound);
        p.add("<path d=\"M" + pixels(at - 4) + " " + pixels(y - 4) + " h8 l-4 8 z\" " + paint + "#fff\"/>");
      }
    }
    shift *= 1.06;
  }
}

void draw_legend(std::string& text, const std::vector<Series>& bed) {
  double y = top + height + 84;
  const auto entry = [&](double x, const std::string& mark, const std::string& words) {
    text += "<g transform=\"translate(" + pixels(x) + " " + pixels(y) + ")\">" + mark + "<text x=\"34\" y=\"5\">" +
            words + "</text></g>\n";
  };
  const auto stroke = [](const char* style) {
    return std::string("<line x1=\"0\" y1=\"0\" x2=\"26\" y2=\"0\" stroke-width=\"2\" ") + style + "/>";
  };
  entry(left, stroke("stroke=\"#1f77b4\""), "restitution, impact at 1 m/s");
  entry(left + 260, stroke("stroke=\"#1f77b4\" stroke-dasharray=\"5 4\""), "the same at 0.1 m/s");
  entry(left + 470, stroke("stroke=\"#2ca02c\""), "spin, impact at 1 m/s");
  entry(left + 690, stroke("stroke=\"#2ca02c\" stroke-dasharray=\"5 4\""), "the same at 0.1 m/s");
  y += 24;
  entry(left, stroke("stroke=\"#000\" stroke-dasharray=\"2 3\""), "residual of the energy budget");
  double x = left + 260;
  for (const Series& s : bed) {
    entry(x, std::string("<circle cx=\"13\" r=\"4\" fill=\"") + s.colour + "\"/>", s.words);
    x += 62 + 7.5 * static_cast<double>(std::string(s.words).size());
  }
  y += 24;
  entry(left, "<path d=\"M9 -4 h8 l-4 8 z\" fill=\"#fff\" stroke=\"#000\"/>",
        "open: within the spread over the seeds, the error is below this mark (99 %); discs: difference from the "
        "smallest step");
}

}  // namespace

void write_plot(const std::string& path, const Plan& plan, const Store& store) {
  const std::vector<Series> shown{
      {"packing", "packing", "#d62728"}, {"stress", "stress", "#9467bd"}, {"rate", "rate or angle", "#ff7f0e"}};
  std::string text;
  double origin = left;
  for (const std::string& scene : scenes) {
    std::vector<Series> bed = shown;
    if (scene == "pile") bed.back().key = "angle";
    Panel panel(origin);
    draw_frame(panel, scene);
    draw_impacts(panel, scene, plan, store);
    draw_residual(panel, scene, plan, store);
    draw_bed(panel, scene, plan, store, bed);
    text += panel.text();
    origin += width + gap;
  }
  draw_legend(text, shown);
  const std::string size_x = pixels(origin - gap + 30), size_y = pixels(top + height + 150);
  write_text_file_atomically(
      path, "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " +
                size_x + " " + size_y + "\" width=\"" + size_x + "\" height=\"" + size_y +
                "\" font-family=\"sans-serif\" font-size=\"13\">\n<rect width=\"" + size_x + "\" height=\"" +
                size_y + "\" fill=\"#fff\"/>\n" + text + "</svg>\n");
}

}  // namespace wedge::speed_error

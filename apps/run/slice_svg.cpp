// slice_svg.cpp: a picture of a slice through the bed, as scalable vector graphics.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "apps/run/slice_svg.hpp"
#include "io/files/atomic_file.hpp"
#include "io/scene/diagnostics.hpp"
#include "io/tables/csv.hpp"

namespace wedge {
namespace {

constexpr double plot_size = 900;                                        // pixels, the longer side of the plot
constexpr double margin_left = 80, margin_right = 130, margin_low = 60;  // pixels
constexpr double margin_top = 50;
constexpr int tick_count = 5;

/// A rectangle of the (x, z) plane [m].
struct Box {
  double left = 0, right = 0, low = 0, high = 0;
  double width() const { return right - left; }
  double height() const { return high - low; }
};

/// A grain cut or touched by the slice.
struct Disc {
  Vec3 centre;        // m
  double radius = 0;  // m
  double speed = 0;   // m/s
};

/// A number of pixels, two decimals.
std::string pixels(double value) { return number_text(std::round(100 * value) / 100); }

/// `value` with no more decimals than `step` needs.
std::string label(double value, double step) {
  const double digits = std::pow(10.0, std::max(0.0, 1 - std::floor(std::log10(step))));
  const double rounded = std::round(value * digits) / digits;
  return number_text(rounded == 0 ? 0 : rounded);
}

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (static_cast<unsigned char>(c) >= 0x20)
      out += c;
  }
  return out;
}

/// A round number (1, 2 or 5 times a power of ten) near range / parts.
double round_step(double range, int parts) {
  const double raw = range / parts, power = std::pow(10.0, std::floor(std::log10(raw)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (raw <= 1.0001 * factor * power) return factor * power;
  return 10 * power;
}

/// Colour of a share 0 .. 1: viridis (van der Walt, Smith, matplotlib 1.5, 2015, public domain) by ten anchors.
std::string colour(double share) {
  constexpr std::array<std::array<int, 3>, 10> anchors = {{{68, 1, 84},
                                                           {72, 40, 120},
                                                           {62, 74, 137},
                                                           {49, 104, 142},
                                                           {38, 130, 142},
                                                           {31, 158, 137},
                                                           {53, 183, 121},
                                                           {109, 205, 89},
                                                           {180, 222, 44},
                                                           {253, 231, 37}}};
  const double place = (share > 0 ? std::min(share, 1.0) : 0.0) * (anchors.size() - 1);
  const std::size_t below = std::min(static_cast<std::size_t>(place), anchors.size() - 2);
  const double rest = place - static_cast<double>(below);
  std::array<int, 3> rgb{};
  for (std::size_t k = 0; k < 3; ++k)
    rgb[k] = static_cast<int>(std::lround((1 - rest) * anchors[below][k] + rest * anchors[below + 1][k]));
  char text[8];
  std::snprintf(text, sizeof text, "#%02x%02x%02x", rgb[0] & 255, rgb[1] & 255, rgb[2] & 255);
  return text;
}

/// Grains of the whole vessel within two mean diameters of the plane y = 0, the farthest first.
std::vector<Disc> slice(const State& state) {
  const Particles& p = state.particles;
  const double half = 2 * state.mean_diameter;
  const bool shifted = state.symmetry.kind() == Symmetry::Kind::translation;
  const int first = shifted ? -1 : 0, last = shifted ? 1 : state.symmetry.order() - 1;
  std::vector<Disc> discs;
  for (int turn = first; turn <= last; ++turn) {
    for (std::size_t i = 0; i < static_cast<std::size_t>(p.count()); ++i) {
      const Vec3 centre = state.symmetry.turn_point(p.position.get(i), turn);
      if (std::abs(centre.y) <= half) discs.push_back({centre, p.radius[i], norm(p.velocity.get(i))});
    }
  }
  std::stable_sort(discs.begin(), discs.end(),
                   [](const Disc& a, const Disc& b) { return a.centre.y > b.centre.y; });
  return discs;
}

/// 99 % quantile of the speeds [m/s], and a positive number in any case.
double fastest(const std::vector<Disc>& discs) {
  std::vector<double> speeds;
  for (const Disc& disc : discs) speeds.push_back(disc.speed);
  if (speeds.empty()) return 1;
  const auto place = speeds.begin() + static_cast<std::ptrdiff_t>(0.99 * static_cast<double>(speeds.size() - 1));
  std::nth_element(speeds.begin(), place, speeds.end());
  return *place > 0 ? *place : 1;
}

/// What to show: all walls across; upwards the walls as far as a little above the grains.
Box view(const std::vector<Disc>& discs, const State& state, bool slot) {
  constexpr double huge = 1e300;
  Box walls{huge, -huge, huge, -huge}, grains = walls;
  const auto include = [](Box& box, double x, double z, double reach) {
    box.left = std::min(box.left, x - reach);
    box.right = std::max(box.right, x + reach);
    box.low = std::min(box.low, z - reach);
    box.high = std::max(box.high, z + reach);
  };
  for (int w = 0; w < state.vessel.wall_count(); ++w) {
    for (const Eigen::Vector2d& point : state.vessel.wall(w).profile) {
      include(walls, point.x(), point.y() + state.vessel.travel(w), 0);
      if (!slot) include(walls, -point.x(), point.y() + state.vessel.travel(w), 0);
    }
  }
  for (const Disc& disc : discs) include(grains, disc.centre.x, disc.centre.z, disc.radius);
  Box box{std::min(walls.left, grains.left), std::max(walls.right, grains.right), std::min(walls.low, grains.low),
          std::max(walls.high, grains.high)};
  if (!(box.width() > 0 && box.height() > 0)) return {-1, 1, -1, 1};
  const double rim = 0.03 * box.width();
  if (!discs.empty()) box.high = std::min(box.high, grains.high + 0.25 * box.width());
  return {box.left - rim, box.right + rim, box.low - rim, box.high + rim};
}

/// The drawing: metres to pixels, and the pieces of text it is made of.
class Drawing {
public:
  explicit Drawing(const Box& box)
      : box_(box),
        scale_(plot_size / std::max(box.width(), box.height())),
        right_(margin_left + scale_ * box.width()),
        bottom_(margin_top + scale_ * box.height()) {}

  double x(double metres) const { return margin_left + scale_ * (metres - box_.left); }
  double y(double metres) const { return bottom_ - scale_ * (metres - box_.low); }
  double scale() const { return scale_; }
  double right() const { return right_; }
  double bottom() const { return bottom_; }
  const Box& box() const { return box_; }

  void add(const std::string& piece) { text_ += piece + "\n"; }
  void line(double x1, double y1, double x2, double y2, const char* style) {
    add("<line x1=\"" + pixels(x1) + "\" y1=\"" + pixels(y1) + "\" x2=\"" + pixels(x2) + "\" y2=\"" + pixels(y2) +
        "\" " + style + "/>");
  }
  void rectangle(double x, double y, double width, double height, const std::string& style) {
    add("<rect x=\"" + pixels(x) + "\" y=\"" + pixels(y) + "\" width=\"" + pixels(width) + "\" height=\"" +
        pixels(height) + "\" " + style + "/>");
  }
  void words(double x, double y, const std::string& words, const char* style) {
    add("<text x=\"" + pixels(x) + "\" y=\"" + pixels(y) + "\" " + style + ">" + escaped(words) + "</text>");
  }
  /// The whole file.
  std::string svg() const {
    const std::string width = pixels(std::ceil(right_ + margin_right));
    const std::string height = pixels(std::ceil(bottom_ + margin_low));
    return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " +
           width + " " + height + "\" width=\"" + width + "\" height=\"" + height +
           "\" font-family=\"sans-serif\" font-size=\"14\">\n" + text_ + "</svg>\n";
  }

private:
  Box box_;
  double scale_;  // pixels per metre
  double right_, bottom_;
  std::string text_;
};

void draw_grains(Drawing& d, const std::vector<Disc>& discs, double top_speed) {
  double largest = 0;  // pixels
  for (const Disc& disc : discs) largest = std::max(largest, d.scale() * disc.radius);
  d.add("<g stroke=\"#222\" stroke-width=\"" + pixels(std::clamp(0.12 * largest, 0.1, 0.6)) + "\">");
  for (const Disc& disc : discs)
    d.add("<circle cx=\"" + pixels(d.x(disc.centre.x)) + "\" cy=\"" + pixels(d.y(disc.centre.z)) + "\" r=\"" +
          pixels(d.scale() * disc.radius) + "\" fill=\"" + colour(disc.speed / top_speed) + "\"/>");
  d.add("</g>");
}

/// Walls that are present, on both sides of the axis; in a slot as they are.
void draw_walls(Drawing& d, const Vessel& vessel, bool slot) {
  d.add("<g fill=\"none\" stroke=\"#b03a2e\" stroke-width=\"2.5\" stroke-linecap=\"round\">");
  for (int w = 0; w < vessel.wall_count(); ++w) {
    if (!vessel.present(w) || vessel.wall(w).profile.empty()) continue;
    for (const double side : {1.0, -1.0}) {
      if (slot && side < 0) continue;
      std::string points;
      for (const Eigen::Vector2d& point : vessel.wall(w).profile)
        points += pixels(d.x(side * point.x())) + "," + pixels(d.y(point.y() + vessel.travel(w))) + " ";
      points.pop_back();
      d.add("<polyline points=\"" + points + "\"/>");
    }
  }
  d.add("</g>");
}

void draw_frame(Drawing& d) {
  const Box& box = d.box();
  d.rectangle(margin_left, margin_top, d.right() - margin_left, d.bottom() - margin_top,
              "fill=\"none\" stroke=\"#444\" stroke-width=\"1\"");
  const double step = round_step(std::max(box.width(), box.height()), 2 * tick_count);
  const char* const tick = "stroke=\"#444\" stroke-width=\"1\"";
  const double across = round_step(45 / d.scale(), 1);  // labels have 45 pixels each
  for (double k = std::ceil(box.left / across); k * across <= box.right; ++k) {
    d.line(d.x(k * across), d.bottom(), d.x(k * across), d.bottom() + 5, tick);
    d.words(d.x(k * across), d.bottom() + 20, label(k * across, across), "text-anchor=\"middle\"");
  }
  for (double k = std::ceil(box.low / step); k * step <= box.high; ++k) {
    d.line(margin_left - 5, d.y(k * step), margin_left, d.y(k * step), tick);
    d.words(margin_left - 9, d.y(k * step) + 5, label(k * step, step), "text-anchor=\"end\"");
  }
  d.words(0.5 * (margin_left + d.right()), d.bottom() + 42, "x [m]", "text-anchor=\"middle\"");
  const std::string middle = pixels(0.5 * (margin_top + d.bottom()));
  d.add("<text x=\"20\" y=\"" + middle + "\" text-anchor=\"middle\" transform=\"rotate(-90 20 " + middle +
        ")\">z [m]</text>");
}

void draw_scale_bar(Drawing& d) {
  const double length = round_step(d.box().width(), 2 * tick_count);
  const double left = d.right() + 20, right = left + d.scale() * length, y = d.bottom() - 8;
  const char* const style = "stroke=\"#000\" stroke-width=\"3\"";
  d.line(left, y, right, y, style);
  d.words(left, y - 8, label(length, length) + " m", "");
}

void draw_colour_bar(Drawing& d, double top_speed) {
  constexpr int pieces = 64;
  const double height = std::min(240.0, 0.6 * (d.bottom() - margin_top)), left = d.right() + 20,
               top = margin_top + 24;
  for (int k = 0; k < pieces; ++k)  // a little taller than its share, so that no gap shows
    d.rectangle(left, top + height * (pieces - 1 - k) / pieces, 18, height / pieces + (k > 0 ? 0.6 : 0.0),
                "fill=\"" + colour((k + 0.5) / pieces) + "\"");
  d.rectangle(left, top, 18, height, "fill=\"none\" stroke=\"#444\" stroke-width=\"1\"");
  const double step = round_step(top_speed, tick_count);
  for (double k = 0; k * step <= 1.0001 * top_speed; ++k) {
    const double y = top + height * (1 - k * step / top_speed);
    d.line(left + 18, y, left + 23, y, "stroke=\"#444\" stroke-width=\"1\"");
    d.words(left + 27, y + 5, label(k * step, step), "");
  }
  d.words(left, margin_top + 10, "speed [m/s]", "");
}

std::string domain_text(const Domain& domain) {
  if (domain.kind == DomainKind::slot) return "slot";
  if (domain.kind == DomainKind::full) return "full vessel";
  return "sector of " + short_number(360.0 / domain.order) + " degrees";
}

}  // namespace

void write_slice_svg(const std::string& path, const State& state, const Scene& scene, const std::string& stage) {
  const bool slot = scene.domain.kind == DomainKind::slot;
  const std::vector<Disc> discs = slice(state);
  const double top_speed = fastest(discs);
  Drawing drawing(view(discs, state, slot));
  const std::string vessel = (scene.name.empty() ? "" : scene.name + ", ") + domain_text(scene.domain);
  const std::string moment = stage + ", t = " + short_number(state.time) + " s";
  drawing.add("<title>" + escaped(vessel + ", " + moment) + "</title>");
  drawing.rectangle(0, 0, drawing.right() + margin_right, drawing.bottom() + margin_low, "fill=\"#fff\"");
  drawing.words(margin_left, 20, vessel, "font-size=\"17\"");
  drawing.words(margin_left, 41, moment, "font-size=\"17\"");
  drawing.add("<clipPath id=\"plot\">");
  drawing.rectangle(margin_left, margin_top, drawing.right() - margin_left, drawing.bottom() - margin_top, "");
  drawing.add("</clipPath>\n<g clip-path=\"url(#plot)\">");
  draw_grains(drawing, discs, top_speed);
  draw_walls(drawing, state.vessel, slot);
  drawing.add("</g>");
  draw_frame(drawing);
  draw_scale_bar(drawing);
  draw_colour_bar(drawing, top_speed);
  write_text_file_atomically(path, drawing.svg());
}

}  // namespace wedge

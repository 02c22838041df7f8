// discharge.cpp: the record of crossings, its rate and interval.
#include "apps/measure/discharge.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string_view>

#include "core/random.hpp"
#include "core/time_scales.hpp"
#include "core/vec3.hpp"
#include "io/files/atomic_file.hpp"
#include "io/tables/csv.hpp"

namespace wedge {
namespace {

constexpr int blocks = 16, resamples = 1000;
constexpr std::uint32_t rate_stream = 0x72617465;  // of the random numbers of the bootstrap: "rate"

double number_at(const std::vector<CsvField>& fields, std::size_t column, const std::string& path) {
  double value = 0;
  if (column >= fields.size() || parse_number(fields[column].text, value) != NumberError::none)
    throw FileError(path + ": error: a row without its numbers");
  return value;
}

}  // namespace

std::vector<Crossing> read_crossings(const std::string& path, const MeasuredDomain& domain) {
  std::vector<Crossing> crossings;
  if (!std::filesystem::exists(path)) return crossings;
  const std::string text = read_text_file(path);
  std::size_t begin = text.find('\n');  // columns as the recorder writes them: time, crossed, id, layer, x, y, ...
  while (begin != std::string::npos && begin + 1 < text.size()) {
    const std::size_t end = std::min(text.find('\n', begin + 1), text.size());
    const std::vector<CsvField> fields = split_csv_line(std::string_view(text).substr(begin + 1, end - begin - 1));
    const double azimuth = std::atan2(number_at(fields, 5, path), number_at(fields, 4, path));
    crossings.push_back({number_at(fields, 1, path), azimuth < 0 ? azimuth + 2 * numbers::pi : azimuth,
                         static_cast<double>(domain.order)});
    begin = end;
  }
  std::sort(crossings.begin(), crossings.end(),
            [](const Crossing& a, const Crossing& b) { return a.time < b.time; });
  return crossings;
}

Estimate discharge_rate(const std::vector<Crossing>& crossings, const Part& part, double begin, double end) {
  Estimate rate;
  if (!(end > begin)) return rate;
  std::vector<double> counts(blocks, 0);
  for (const Crossing& c : crossings) {
    if (!(c.time > begin && c.time <= end) || !part.holds(c.azimuth)) continue;
    const auto block = static_cast<int>(blocks * (c.time - begin) / (end - begin));
    counts[static_cast<std::size_t>(std::min(block, blocks - 1))] += c.weight * part.pieces;
  }
  const auto mean_rate = [&](auto&& count_of) {
    double sum = 0;
    for (int b = 0; b < blocks; ++b) sum += count_of(b);
    return sum / (end - begin);
  };
  rate.value = mean_rate([&](int b) { return counts[static_cast<std::size_t>(b)]; });
  std::vector<double> rates;
  RandomStream stream(1, rate_stream);
  for (int k = 0; k < resamples; ++k)
    rates.push_back(mean_rate([&](int) { return counts[static_cast<std::size_t>(stream.uniform(0, blocks))]; }));
  std::sort(rates.begin(), rates.end());
  rate.low = rates[static_cast<std::size_t>(0.025 * resamples)];
  rate.high = rates[static_cast<std::size_t>(0.975 * resamples)];
  return rate;
}

bool arched(const std::vector<Crossing>& crossings, const Part& part, double begin, double end) {
  const double quiet = std::min(0.2, 0.5 * (end - begin));
  return std::none_of(crossings.begin(), crossings.end(), [&](const Crossing& c) {
    return c.time > end - quiet && c.time <= end && part.holds(c.azimuth);
  });
}

double orifice_diameter(const Scene& scene) {
  if (scene.domain.kind == DomainKind::slot) return 0;
  for (const Stage& stage : scene.stages) {
    for (const std::string& name : stage.remove) {
      for (const WallDescription& wall : scene.walls) {
        if (wall.name != name) continue;
        double rim = 0;
        bool axis = false, flat = true;
        for (const Eigen::Vector2d& point : wall.profile) {
          rim = std::max(rim, point.x());
          axis = axis || point.x() == 0;
          flat = flat && point.y() == wall.profile.front().y();
        }
        if (axis && flat) return 2 * rim;
      }
    }
  }
  return 0;
}

Estimate beverloo_rate(const MeasuredDomain& domain, double packing) {
  const double orifice = orifice_diameter(domain.scene), d = domain.diameter;
  const auto rate = [&](double c, double k) {
    return c * packing * std::sqrt(domain.gravity()) * std::pow(orifice - k * d, 2.5) /
           (numbers::pi / 6 * d * d * d);
  };
  Estimate expected;
  if (!(orifice > 1.5 * d)) return expected;
  expected.low = rate(0.55, 1.5);
  expected.high = rate(0.64, 1.4);
  return expected;
}

}  // namespace wedge

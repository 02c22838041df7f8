// grain_sizes.hpp: sizes of the grains a scene asks for: smallest, largest, moments of the distribution, materials
// in use.
#pragma once

#include <algorithm>
#include <cmath>
#include <set>
#include <variant>
#include <vector>

#include "core/scene.hpp"

namespace wedge {

/// Mean of diameter^power [m^power] by number; 0 when the scene does not know its sizes. Pre: 0 <= power <= 4.
double mean_power_of_diameter(const Source& source, int power);

namespace sizes {

inline double mean_power(const std::vector<SizeClass>& classes, int power) {
  double sum = 0, fractions = 0;
  for (const SizeClass& c : classes) {
    sum += c.fraction * std::pow(c.diameter, power);
    fractions += c.fraction;
  }
  return fractions > 0 ? sum / fractions : 0;
}

inline double mean_power(const UniformSizes& u, int power) {
  if (!(u.largest > u.smallest)) return std::pow(u.smallest, power);
  return (std::pow(u.largest, power + 1) - std::pow(u.smallest, power + 1)) /
         ((power + 1) * (u.largest - u.smallest));
}

/// Moments of a lognormal distribution cut at both ends: Johnson, Kotz, Balakrishnan, Continuous Univariate
/// Distributions vol. 1 (1994), ch. 14: with x = ln(diameter/median)/sigma the k-th moment is median^k
/// exp(k^2 sigma^2/2) [Phi(x_b - k sigma) - Phi(x_a - k sigma)] / [Phi(x_b) - Phi(x_a)].
inline double mean_power(const LognormalSizes& s, int power) {
  if (!(s.sigma > 0 && s.median > 0 && s.largest > s.smallest && s.smallest > 0)) return std::pow(s.median, power);
  const double a = std::log(s.smallest / s.median) / s.sigma, b = std::log(s.largest / s.median) / s.sigma;
  const auto between = [&](double shift) {
    return 0.5 * (std::erfc((a - shift) / std::sqrt(2.0)) - std::erfc((b - shift) / std::sqrt(2.0)));
  };
  return std::pow(s.median, power) * std::exp(0.5 * power * power * s.sigma * s.sigma) * between(power * s.sigma) /
         between(0);
}

inline double smallest(const std::vector<SizeClass>& classes) {
  double d = classes.empty() ? 0 : classes.front().diameter;
  for (const SizeClass& c : classes) d = std::min(d, c.diameter);
  return d;
}
inline double largest(const std::vector<SizeClass>& classes) {
  double d = 0;
  for (const SizeClass& c : classes) d = std::max(d, c.diameter);
  return d;
}
inline double smallest(const UniformSizes& u) { return u.smallest; }
inline double largest(const UniformSizes& u) { return u.largest; }
inline double smallest(const LognormalSizes& s) { return s.smallest; }
inline double largest(const LognormalSizes& s) { return s.largest; }

}  // namespace sizes

inline double mean_power_of_diameter(const Source& source, int power) {
  if (const auto* file = std::get_if<StateFile>(&source.grains))
    return file->diameter > 0 ? std::pow(file->diameter, power) : 0;
  return std::visit([&](const auto& s) { return sizes::mean_power(s, power); },
                    std::get<RandomFill>(source.grains).sizes);
}

/// Mean diameter [m] by number, the "d" of lengths such as "0.02 d"; 0 when the scene does not know it.
inline double mean_diameter(const Source& source) {
  if (const auto* fill = std::get_if<RandomFill>(&source.grains)) {
    const auto* classes = std::get_if<std::vector<SizeClass>>(&fill->sizes);
    if (classes && classes->size() == 1) return classes->front().diameter;  // exactly, no rounding
  }
  return mean_power_of_diameter(source, 1);
}

/// Smallest diameter [m]; 0 when the scene does not know it (a state file with its own radii).
inline double smallest_diameter(const Source& source) {
  if (const auto* file = std::get_if<StateFile>(&source.grains)) return file->diameter;
  return std::visit([](const auto& s) { return sizes::smallest(s); }, std::get<RandomFill>(source.grains).sizes);
}

/// Largest diameter [m]; 0 when the scene does not know it.
inline double largest_diameter(const Source& source) {
  if (const auto* file = std::get_if<StateFile>(&source.grains)) return file->diameter;
  return std::visit([](const auto& s) { return sizes::largest(s); }, std::get<RandomFill>(source.grains).sizes);
}

/// Indices of the materials the grains are made of. A state file with a material column may use others.
inline std::set<int> grain_materials(const Source& source) {
  std::set<int> used;
  if (const auto* file = std::get_if<StateFile>(&source.grains)) {
    used.insert(file->material);
  } else {
    const RandomFill& fill = std::get<RandomFill>(source.grains);
    if (const auto* classes = std::get_if<std::vector<SizeClass>>(&fill.sizes)) {
      for (const SizeClass& c : *classes) used.insert(c.material);
    } else if (const auto* uniform = std::get_if<UniformSizes>(&fill.sizes)) {
      used.insert(uniform->material);
    } else {
      used.insert(std::get<LognormalSizes>(fill.sizes).material);
    }
  }
  return used;
}

}  // namespace wedge

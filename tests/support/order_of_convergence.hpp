// order_of_convergence.hpp: the order at which the error of an experiment falls with the time step, measured and
// written down.
#pragma once

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "core/random.hpp"
#include "tests/support/known_answer.hpp"

namespace wedge::test {

/// What an experiment ends with, made dimensionless: positions, velocities, spins.
using Outcome = std::vector<double>;

/// Runs an experiment with the step coarse_step(...) * 2^-level; `offset` in [0, 1) also shifts its first touch by
/// this part of the coarsest step.
using Solve = std::function<Outcome(int level, double offset)>;

/// A coarsest step of about T / steps, different for each offset: where a step the sphere parts in ends, relative
/// to the one it touched in, must differ too, or the errors of touching and parting cancel at some levels.
inline double coarse_step(double T, int steps, double offset) {
  return T / steps * (0.85 + 0.3 * std::fmod(7.3 * offset, 1.0));
}

struct Order {
  std::vector<double> errors;  // at each level
  double fitted = 0;           // least squares over all levels: error = constant (dt / T)^fitted,
  double constant = 0;         // T being about `coarse_steps` coarsest steps
};

inline double distance(const Outcome& a, const Outcome& b) {
  double square = 0;
  REQUIRE(a.size() == b.size());
  for (std::size_t k = 0; k < a.size(); ++k) square += (a[k] - b[k]) * (a[k] - b[k]);
  return std::sqrt(square);
}

/// The line through log error against log dt.
inline void fit(Order& order, int coarse_steps) {
  const double count = static_cast<double>(order.errors.size());
  double x = 0, y = 0, xx = 0, xy = 0;
  for (std::size_t k = 0; k < order.errors.size(); ++k) {
    const double log_dt = -std::log(coarse_steps) - std::log(2) * static_cast<double>(k),
                 log_e = std::log(order.errors[k]);
    x += log_dt / count;
    y += log_e / count;
    xx += log_dt * log_dt / count;
    xy += log_dt * log_e / count;
  }
  order.fitted = (xy - x * y) / (xx - x * x);
  order.constant = std::exp(y - order.fitted * x);
}

/// Errors at five halvings against `exact` or, when there is none, against the same experiment with the finest step
/// divided by 16; root mean squares over many offsets, since where in a step the first touch falls changes the
/// error of a single run by its own size.
inline Order measure_order(const Solve& solve, int coarse_steps, const std::function<Outcome(double)>& exact = {}) {
  constexpr int levels = 5, offsets = 40;
  Order order;
  order.errors.assign(levels, 0);
  RandomStream random(11, 0);
  for (int o = 0; o < offsets; ++o) {
    const double offset = random.uniform(0, 1);
    const Outcome truth = exact ? exact(offset) : solve(levels + 3, offset);
    for (int level = 0; level < levels; ++level) {
      const double d = distance(solve(level, offset), truth);
      order.errors[static_cast<std::size_t>(level)] += d * d / offsets;
    }
  }
  for (double& e : order.errors) e = std::sqrt(e);
  fit(order, coarse_steps);
  return order;
}

/// Writes the row of a measured order; says whether the fitted order lies in [low, high]. `why` is the reason for
/// an order below 2.
inline bool order_within(const std::string& place, const std::string& subject, const Order& order, double low,
                         double high, const std::string& why = "") {
  std::string pairs;
  for (std::size_t k = 1; k < order.errors.size(); ++k)
    pairs += (k > 1 ? ", " : "") + text("%.2f", std::log2(order.errors[k - 1] / order.errors[k]));
  write_row("orders", place,
            {subject, text("%.2f", order.fitted), pairs, text("%.2g", order.constant),
             text("%.1e", order.errors.back()), text("%.2f", low) + " to " + text("%.2f", high), why});
  UNSCOPED_INFO(subject << ": order " << order.fitted << ", between halvings " << pairs << ", finest error "
                        << order.errors.back());
  return order.fitted >= low && order.fitted <= high;
}

}  // namespace wedge::test

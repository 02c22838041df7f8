// plan.hpp: which jobs there are, in which order, and their results, kept in files.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "perf/speed_error/speed_error.hpp"

namespace wedge::speed_error {

/// A column of a table of errors.
struct Column {
  std::string key;      // in Result
  std::string heading;  // in the page
};

/// One table of the page: variants of which one is the reference.
struct Table {
  std::string key, title;
  std::vector<Variant> variants;
  std::size_t reference = 0;
  int seeds = 0;
};

struct Job {
  std::string name;
  std::function<Result()> work;
};

class Plan {
public:
  explicit Plan(Size size);

  const std::vector<Table>& tables() const { return tables_; }
  const std::vector<double>& steps() const { return steps_; }
  /// Beds whose stability is tested.
  std::vector<Firmness> beds() const;
  /// What drift is measured of: "nudged" and the precisions other than double.
  const std::vector<std::string>& drifters() const { return drifters_; }
  Size size() const { return size_; }
  int seeds(const Variant& variant) const;
  /// All jobs; the first seed of everything comes first, so that a page can be had early.
  std::vector<Job> jobs() const;

  static std::string run_name(const std::string& scene, const Variant& variant, int seed);
  static std::string impact_name(const std::string& scene, double step, double speed);
  static std::string drift_name(const std::string& scene, const std::string& other, int seed);
  static std::string stability_name(const std::string& scene, Firmness firmness);
  static std::string race_name(const std::string& scene) { return scene + "_race"; }

  static constexpr double slow_impact = 0.1, fast_impact = 1.0;  // m/s
  static constexpr int drift_seeds = 3;
  static constexpr double reference_check =
      0.1;  // % of the Rayleigh time: what is left of the reference's own error

private:
  Size size_;
  std::vector<double> steps_;
  std::vector<Table> tables_;
  std::vector<std::string> drifters_{"nudged"};
};

/// Results in files of one line each, in a folder: "name value name value ...".
class Store {
public:
  explicit Store(std::string folder);
  std::optional<Result> find(const std::string& job) const;
  void keep(const std::string& job, const Result& result) const;

private:
  std::string folder_;
};

/// Writes BASE.md and BASE.svg from what the store has. `origin` says where it comes from.
void write_page(const std::string& base, const Plan& plan, const Store& store, const std::string& origin);
void write_plot(const std::string& path, const Plan& plan, const Store& store);

}  // namespace wedge::speed_error

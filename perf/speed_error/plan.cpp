// plan.cpp: the list of jobs, and the files of their results.
#include "perf/speed_error/plan.hpp"

#include <algorithm>
#include <filesystem>
#include <set>
#include <sstream>

#include "io/files/atomic_file.hpp"
#include "io/tables/csv.hpp"

namespace wedge::speed_error {
namespace {

// What [run] precision may be, the standard first. A new one needs no more than its name here.
const std::vector<std::string> precisions{"double", "mixed"};

Variant with(double Variant::*field, double value) {
  Variant v;
  v.*field = value;
  return v;
}

std::vector<Variant> sectors() {
  std::vector<Variant> all(1);
  for (const char* axis : {"clamp", "images"}) {
    for (const int angle : {90, 60, 45}) {
      all.emplace_back();
      all.back().angle = angle;
      all.back().axis = axis;
    }
  }
  return all;
}

}  // namespace

Plan::Plan(Size size) : size_(size) {
  const bool quick = size == Size::quick;
  steps_ = quick ? std::vector<double>{5, 10, 40} : std::vector<double>{2, 5, 10, 15, 20, 30, 40};
  Table step{"step", "Time step", {}, 0, quick ? 2 : 4}, young{"young", "Stiffness", {}, 0, quick ? 2 : 4};
  for (const double s : steps_) step.variants.push_back(with(&Variant::step, s));
  for (const double e : quick ? std::vector<double>{1e7, 1e6} : std::vector<double>{1e8, 1e7, 3e6, 1e6})
    young.variants.push_back(with(&Variant::young, e));
  Table skin{"skin", "Skin", {}, 0, quick ? 2 : 3};
  for (const double s : quick ? std::vector<double>{0, 0.1} : std::vector<double>{0, 0.05, 0.1, 0.2})
    skin.variants.push_back(with(&Variant::skin, s));
  Table sector{"sector", "Angle of a sector", sectors(), 0, quick ? 2 : 8};
  tables_ = {step, young, skin, sector};
  if (precisions.size() > 1) {
    Table precision{"precision", "Precision", {}, 0, quick ? 2 : 8};
    for (const std::string& p : precisions) {
      precision.variants.emplace_back();
      precision.variants.back().precision = p;
      if (p != "double") drifters_.push_back(p);
    }
    tables_.push_back(precision);
  }
}

std::vector<Firmness> Plan::beds() const {
  if (size_ == Size::quick) return {{1e7, 0.3}};
  return {{1e6, 0.3}, {1e7, 0.3}, {1e8, 0.3}, {1e7, 0.1}, {1e7, 0.6}};
}

int Plan::seeds(const Variant& variant) const {
  int most = 0;
  for (const Table& t : tables_)
    for (const Variant& v : t.variants)
      if (v.name() == variant.name()) most = std::max(most, t.seeds);
  return most;
}

std::vector<Job> Plan::jobs() const {
  std::vector<Job> all;
  const Size size = size_;
  std::vector<Variant> variants;
  std::set<std::string> known;
  int seeds_most = 0;
  variants.emplace_back();  // the standard comes first: races are relative to it
  known.insert(variants[0].name());
  for (const Table& t : tables_) {
    seeds_most = std::max(seeds_most, t.seeds);
    for (const Variant& v : t.variants)
      if (known.insert(v.name()).second) variants.push_back(v);
  }
  std::vector<double> impact_steps = steps_;
  impact_steps.push_back(reference_check);
  for (const std::string& scene : scenes) {
    for (const double step : impact_steps)
      for (const double speed : {slow_impact, fast_impact})
        all.push_back({impact_name(scene, step, speed), [=] { return impacts(scene, step, speed, size); }});
    for (const std::string& other : drifters_)
      for (int seed = 1; seed <= (size == Size::quick ? 1 : drift_seeds); ++seed)
        all.push_back({drift_name(scene, other, seed), [=] { return drift(scene, other, seed, size); }});
    for (const Firmness f : beds())
      all.push_back({stability_name(scene, f), [=] { return stability(scene, f, size); }});
    all.push_back({race_name(scene), [=] { return race(scene, variants, size); }});
  }
  for (int seed = 1; seed <= seeds_most; ++seed)
    for (const Variant& v : variants)
      for (const std::string& scene : scenes)
        if (seed <= seeds(v))
          all.push_back({run_name(scene, v, seed), [=] { return bed_run(scene, v, seed, size); }});
  return all;
}

std::string Plan::run_name(const std::string& scene, const Variant& variant, int seed) {
  return scene + "_" + variant.name() + "_seed" + std::to_string(seed);
}
std::string Plan::impact_name(const std::string& scene, double step, double speed) {
  return scene + "_impact_step" + number_text(step) + "_speed" + number_text(speed);
}
std::string Plan::stability_name(const std::string& scene, Firmness firmness) {
  return scene + "_stability_" + firmness.name();
}
std::string Plan::drift_name(const std::string& scene, const std::string& other, int seed) {
  return scene + "_drift_" + other + "_seed" + std::to_string(seed);
}

Store::Store(std::string folder) : folder_(std::move(folder)) { std::filesystem::create_directories(folder_); }

std::optional<Result> Store::find(const std::string& job) const {
  const std::string path = folder_ + "/" + job + ".txt";
  if (!std::filesystem::exists(path)) return std::nullopt;
  std::istringstream text(read_text_file(path));
  Result result;
  for (std::string name, value; text >> name >> value;) {
    double number = 0;
    if (parse_number(value, number) != NumberError::none) return std::nullopt;
    result[name] = number;
  }
  return result;
}

void Store::keep(const std::string& job, const Result& result) const {
  std::string line;
  for (const auto& [name, value] : result) line += name + " " + number_text(value) + " ";
  line.back() = '\n';
  write_text_file_atomically(folder_ + "/" + job + ".txt", line);
}

}  // namespace wedge::speed_error

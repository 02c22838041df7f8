// plan.cpp: the list of jobs, and the files of their results.
#include "perf/speed_error/plan.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "io/files/atomic_file.hpp"
#include "io/tables/csv.hpp"

namespace wedge::speed_error {
namespace {

// What [run] precision may be besides double. A new one needs no more than its name here.
const std::vector<std::string> other_precisions{"mixed"};

constexpr double slow_impact = 0.1, fast_impact = 1.0;  // m/s
constexpr double reference_check = 0.1;  // % of the Rayleigh time: what is left of the reference's own error
constexpr int drift_seeds = 3;

/// A choice to be run with some seeds.
struct Planned {
  Variant variant;
  int seeds;
};

std::vector<double> steps(Size size) {
  return size == Size::quick ? std::vector<double>{5, 10, 40} : std::vector<double>{2, 5, 10, 15, 20, 30, 40};
}

/// All choices, the standard first: races are relative to it.
std::vector<Planned> choices(Size size) {
  const bool quick = size == Size::quick;
  const auto seeds = [quick](int full) { return quick ? 2 : full; };
  std::vector<Planned> all{{Variant(), seeds(8)}};
  const auto add = [&](int full, auto Variant::*field, auto value) {
    Planned planned{Variant(), seeds(full)};
    planned.variant.*field = value;
    if (planned.variant.name() != all[0].variant.name()) all.push_back(planned);
  };
  for (const double step : steps(size)) add(4, &Variant::step, step);
  for (const double young : quick ? std::vector<double>{1e6} : std::vector<double>{1e8, 3e6, 1e6})
    add(4, &Variant::young, young);
  for (const double skin : quick ? std::vector<double>{0.1} : std::vector<double>{0.05, 0.1, 0.2})
    add(3, &Variant::skin, skin);
  for (const char* axis : {"clamp", "images"}) {
    for (const int angle : {90, 60, 45}) {
      add(8, &Variant::angle, angle);
      all.back().variant.axis = axis;
    }
  }
  for (const std::string& precision : other_precisions) add(8, &Variant::precision, precision);
  return all;
}

/// Beds whose stability is tested.
std::vector<Firmness> beds(Size size) {
  if (size == Size::quick) return {{1e7, 0.3}};
  return {{1e6, 0.3}, {1e7, 0.3}, {1e8, 0.3}, {1e7, 0.1}, {1e7, 0.6}};
}

Job impact_job(const std::string& scene, double step, double speed, Size size) {
  Subject subject{"impact", scene, Variant()};
  subject.variant.step = step;
  subject.speed = speed;
  return {scene + "_impact_step" + number_text(step) + "_speed" + number_text(speed), [=] {
            return std::vector{Measurement{subject, impacts(scene, step, speed, size)}};
          }};
}

Job drift_job(const std::string& scene, const std::string& other, int seed, Size size) {
  Subject subject{"drift", scene, Variant()};
  subject.variant.precision = other;
  subject.seed = seed;
  return {scene + "_drift_" + other + "_seed" + std::to_string(seed), [=] {
            return std::vector{Measurement{subject, drift(scene, other, seed, size)}};
          }};
}

Job stability_job(const std::string& scene, Firmness firmness, Size size) {
  Subject subject{"stability", scene, Variant()};
  subject.variant.young = firmness.young;
  subject.damping = firmness.damping;
  return {scene + "_stability_" + firmness.name(), [=] {
            return std::vector{Measurement{subject, stability(scene, firmness, size)}};
          }};
}

Job race_job(const std::string& scene, Size size) {
  return {scene + "_race", [=] {
            std::vector<Variant> variants;
            for (const Planned& planned : choices(size)) variants.push_back(planned.variant);
            const std::vector<Result> results = race(scene, variants, size);
            std::vector<Measurement> all;
            for (std::size_t k = 0; k < variants.size(); ++k)
              all.push_back({{"race", scene, variants[k]}, results[k]});
            return all;
          }};
}

Job bed_job(const std::string& scene, const Variant& variant, int seed, Size size) {
  Subject subject{"bed", scene, variant};
  subject.seed = seed;
  return {scene + "_" + variant.name() + "_seed" + std::to_string(seed), [=] {
            return std::vector{Measurement{subject, bed_run(scene, variant, seed, size)}};
          }};
}

std::string or_nothing(double value) { return std::isnan(value) ? "" : number_text(value); }

/// The choice as pairs of name and text.
std::vector<std::pair<std::string, std::string>> fields(const Variant& v) {
  return {{"step", number_text(v.step)},
          {"young", number_text(v.young)},
          {"skin", number_text(v.skin)},
          {"angle", number_text(v.angle)},
          {"axis", v.axis},
          {"precision", v.precision}};
}

std::string rows(const Measurement& m) {
  const Subject& s = m.subject;
  std::string start = s.kind + "," + s.scene + ",";
  for (const auto& [name, text] : fields(s.variant)) start += text + ",";
  start += or_nothing(s.damping) + "," + or_nothing(s.speed) + "," + std::to_string(s.seed) + ",";
  std::string text;
  for (const auto& [quantity, value] : m.result) text += start + quantity + "," + number_text(value) + "\n";
  return text;
}

}  // namespace

std::vector<Job> jobs(Size size) {
  std::vector<Job> all;
  const std::vector<Planned> planned = choices(size);
  std::vector<double> impact_steps = steps(size);
  impact_steps.push_back(reference_check);
  std::vector<std::string> drifters{"nudged"};
  drifters.insert(drifters.end(), other_precisions.begin(), other_precisions.end());
  for (const std::string& scene : scenes) {
    for (const double step : impact_steps)
      for (const double speed : {slow_impact, fast_impact}) all.push_back(impact_job(scene, step, speed, size));
    for (const std::string& other : drifters)
      for (int seed = 1; seed <= (size == Size::quick ? 1 : drift_seeds); ++seed)
        all.push_back(drift_job(scene, other, seed, size));
    for (const Firmness firmness : beds(size)) all.push_back(stability_job(scene, firmness, size));
    all.push_back(race_job(scene, size));
  }
  int most = 0;
  for (const Planned& p : planned) most = std::max(most, p.seeds);
  for (int seed = 1; seed <= most; ++seed)
    for (const Planned& p : planned)
      for (const std::string& scene : scenes)
        if (seed <= p.seeds) all.push_back(bed_job(scene, p.variant, seed, size));
  return all;
}

Store::Store(std::string folder, Size size) : folder_(std::move(folder)) {
  std::filesystem::create_directories(folder_);
  std::string text = "scene,item,value\n";
  const auto add = [&](const std::string& scene, const std::string& item, const std::string& value) {
    text += scene + "," + item + "," + csv_quoted(value) + "\n";
  };
  for (const auto& [name, value] : fields(Variant())) add("", name, value);
  add("", "impact_places", std::to_string(impact_places(size)));
  add("", "discharged", std::to_string(discharged_grains(size)));
  for (const std::string& scene : scenes) {
    add(scene, "file", scene_file(scene));
    for (const std::string& change : scaled_down(scene, size)) add(scene, "set", change);
  }
  write_text_file_atomically(folder_ + "/setup.csv", text);
}

bool Store::has(const Job& job) const { return std::filesystem::exists(path_of(job)); }

void Store::keep(const Job& job, const std::vector<Measurement>& measurements) const {
  std::string text = "kind,scene,";
  for (const auto& [name, value] : fields(Variant())) text += name + ",";
  text += "damping,speed,seed,quantity,value\n";
  for (const Measurement& m : measurements) text += rows(m);
  write_text_file_atomically(path_of(job), text);
}

}  // namespace wedge::speed_error

// plan.hpp: which jobs there are and in which order; the files of their results.
#pragma once

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "perf/speed_error/speed_error.hpp"

namespace wedge::speed_error {

/// What a result is of. Fields that a kind of job does not vary are the standard's, or empty in its file.
struct Subject {
  std::string kind;  // "bed", "impact", "drift", "stability", "race"
  std::string scene;
  Variant variant;
  double damping = std::numeric_limits<double>::quiet_NaN();  // ratio
  double speed = std::numeric_limits<double>::quiet_NaN();    // m/s
  int seed = 1;
};

struct Measurement {
  Subject subject;
  Result result;
};

struct Job {
  std::string name;
  std::function<std::vector<Measurement>()> work;
};

/// All jobs; the first seed of everything comes first, so that a page can be had early.
std::vector<Job> jobs(Size size);

/// Results in files of comma-separated values in a folder, one file a job, with a row for each quantity.
class Store {
public:
  /// Makes the folder, and in it setup.csv: how the scenes are set up and what the standard choice is.
  Store(std::string folder, Size size);
  bool has(const Job& job) const;
  /// Throws FileError. Post: has(job), or the file is not there at all.
  void keep(const Job& job, const std::vector<Measurement>& measurements) const;

private:
  std::string path_of(const Job& job) const { return folder_ + "/" + job.name + ".csv"; }
  std::string folder_;
};

}  // namespace wedge::speed_error

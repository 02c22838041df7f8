// discharge.hpp: who crossed the outlet when, how fast, and what Beverloo's law expects.
#pragma once

#include <optional>
#include <vector>

#include "apps/analysis/analysed_run.hpp"

namespace wedge {

struct Crossing {
  double time = 0;     // s
  double azimuth = 0;  // rad, in [0, 2 pi)
};

/// A number with its 95 % interval; nan where not known.
struct Estimate {
  double value = std::numeric_limits<double>::quiet_NaN();
  double low = std::numeric_limits<double>::quiet_NaN(), high = std::numeric_limits<double>::quiet_NaN();
};

/// From series/discharge.csv, by time; none where the run has no outlet. Throws FileError.
std::vector<Crossing> read_crossings(const AnalysedRun& run);

/// Moment [s] when the first stage that takes a wall away began; nothing when none has.
std::optional<double> opening_time(const AnalysedRun& run);

/// Crossings per second in begin < t <= end, of the whole vessel; interval by bootstrap over blocks of time.
Estimate discharge_rate(const std::vector<Crossing>& crossings, const Part& part, double begin, double end);

/// Whether none crossed in the last 0.2 s (half of the span, if that is shorter) before `end`.
bool arched(const std::vector<Crossing>& crossings, const Part& part, double begin, double end);

/// Diameter [m] of the hole in the middle of the floor that a stage opened by taking away a flat wall; 0: there is
/// none.
double orifice_diameter(const Scene& scene);

/// Grains per second through a round orifice: C packing sqrt(g) (D0 - k d)^(5/2) / grain volume, with C 0.55, k 1.5
/// and with C 0.64, k 1.4 (Beverloo, Leniger, van de Velde, Chem. Eng. Sci. 15, 1961). Nan without an orifice.
Estimate beverloo_rate(const AnalysedRun& run, double packing);

}  // namespace wedge

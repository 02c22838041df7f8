// discharge.hpp: who crossed the outlet when, how fast, and what Beverloo's law expects.
#pragma once

#include <string>
#include <vector>

#include "apps/measure/part.hpp"
#include "apps/results/scalar.hpp"

namespace wedge {

struct Crossing {
  double time = 0;     // s
  double azimuth = 0;  // rad, in [0, 2 pi)
  double weight = 1;   // grains of the whole vessel that it stands for
};

/// From series/discharge.csv at `path`, by time; none where there is no such file. Throws FileError.
std::vector<Crossing> read_crossings(const std::string& path, const MeasuredDomain& domain);

/// Grains of the whole vessel per second [1/s] that cross in begin < t <= end; interval by bootstrap over blocks of
/// time. Nan where the span has no length.
Estimate discharge_rate(const std::vector<Crossing>& crossings, const Part& part, double begin, double end);

/// Whether none crossed in the last 0.2 s (half of the span, if that is shorter) before `end`.
bool arched(const std::vector<Crossing>& crossings, const Part& part, double begin, double end);

/// Diameter [m] of the hole in the middle of the floor that a stage opened by taking away a flat wall; 0: there is
/// none.
double orifice_diameter(const Scene& scene);

/// Grains per second through a round orifice: C packing sqrt(g) (D0 - k d)^(5/2) / grain volume, with C 0.55, k 1.5
/// and with C 0.64, k 1.4 (Beverloo, Leniger, van de Velde, Chem. Eng. Sci. 15, 1961). Nan without an orifice.
Estimate beverloo_rate(const MeasuredDomain& domain, double packing);

}  // namespace wedge

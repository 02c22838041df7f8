// speed_error.hpp: the runs behind speed_error.md: what is varied, what one run measures. The question: how do
// error and speed trade in the time step, the stiffness, the skin, the precision and the angle of a sector?
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "core/scene.hpp"

namespace wedge::speed_error {

/// What one job measured: numbers by name, SI units; not-a-number where there is nothing to measure.
using Result = std::map<std::string, double>;

/// One choice of all that is varied; the defaults are the standard choice, to which all others are compared.
struct Variant {
  double step = 10;                  // time step, % of the Rayleigh time
  double young = 1e7;                // Pa
  double skin = 0;                   // mean diameters; 0: the program's own
  int angle = 360;                   // degrees
  std::string axis = "clamp";        // of a sector
  std::string precision = "double";  // of [run]

  /// Name of the variant: what differs from the standard; "standard" when nothing does.
  std::string name() const;
};

/// Full size, or a smoke test of about a minute.
enum class Size { full, quick };

inline const std::vector<std::string> scenes{"hopper", "pile"};

/// The scene of a variant: those of apps/scenes, scaled down.
Scene make_scene(const std::string& scene, const Variant& variant, int seed, Size size);
/// How `scene` differs from the file it is made of, as overrides.
std::string scene_file(const std::string& scene);
std::vector<std::string> scaled_down(const std::string& scene, Size size);

/// Grains after which a discharge has been seen, counted for the whole vessel.
constexpr int discharged_grains(Size size) { return size == Size::full ? 600 : 200; }

/// Fills, settles, opens, measures. `broke` is 1 when the physics guard stopped the run.
Result bed_run(const std::string& scene, const Variant& variant, int seed, Size size);

/// Simulated time per second of computing of each variant over that of the first, in turn, settled ("speed_rest")
/// and with the outlet open ("speed_flow"): median of the rounds, and with "_low" and "_high" least and most.
std::vector<Result> race(const std::string& scene, const std::vector<Variant>& variants, Size size);

/// A bed to be tested for stability.
struct Firmness {
  double young;    // Pa
  double damping;  // ratio, normal and tangential, of grains and walls

  std::string name() const;
};

/// Whether a bed that came to rest at a small step stays at rest at longer ones [% of the Rayleigh time]: "heatN"
/// is the mean kinetic energy of a grain in m g d after 1000 times the Rayleigh time at N %, infinite when a guard
/// stopped it; "overlap" as in bed_run.
inline const std::vector<double> long_steps{10, 15, 20, 25, 30, 35, 40, 50};
Result stability(const std::string& scene, Firmness firmness, Size size);

/// Distance of equal grains after 10, 100, 1000 steps from one moment of the flow, in double precision and as
/// `other`; "nudged" is double precision with each coordinate moved by its last bit: what chaos makes of round-off.
Result drift(const std::string& scene, const std::string& other, int seed, Size size);

/// Places within a time step at which the grains of an impact first touch.
constexpr int impact_places(Size size) { return size == Size::full ? 16 : 3; }

/// Oblique impacts of two grains at `speed` [m/s] with this step [% of the Rayleigh time], against a very fine
/// step: root mean square error of restitution and spin as parts of their own size, and its uncertainty by
/// sampling.
Result impacts(const std::string& scene, double step, double speed, Size size);

}  // namespace wedge::speed_error

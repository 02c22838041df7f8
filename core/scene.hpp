// scene.hpp: the typed description of a run. io fills it from a TOML file and checks it; everything else reads it.
// SI units; angles in radians; a default here is the default of the scene file.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <Eigen/Core>

#include "core/axis.hpp"
#include "core/contact_laws.hpp"
#include "core/material.hpp"
#include "core/precision.hpp"

namespace wedge {

enum class DomainKind { full, sector, slot };
enum class Sides { periodic, rigid, frictionless };

struct Domain {
  DomainKind kind = DomainKind::full;
  int order = 1;          // sector: 360 degrees / angle
  double slot_width = 0;  // m, slot only, along y
  Sides sides = Sides::periodic;
  AxisRule axis = AxisRule::clamp;
  double inner_radius = 0;               // m: of the cylinder around the axis, where the rule has one
  int axis_material = 0;                 // of what stands around the axis
  Eigen::Vector3d gravity{0, 0, -9.81};  // m/s2
  std::optional<double> outlet_height;   // m: a grain whose centre falls below counts as discharged
};

/// The wall around the axis of this domain. A full vessel has the cylinder too, so that it can be compared with its
/// sectors; a line stands for what only a sector lacks.
inline AxisWall wall_around_axis(const Domain& domain) {
  const AxisWall wall = traits_of(domain.axis).wall;
  const bool stands = wall == AxisWall::line ? domain.kind == DomainKind::sector : domain.kind != DomainKind::slot;
  return stands ? wall : AxisWall::none;
}
/// Radius [m] of what the wall around the axis cuts out of the vessel.
inline double cut_out_radius(const Domain& domain) { return is_cylinder(domain.axis) ? domain.inner_radius : 0.0; }

/// Copies of the domain that make the whole vessel: n of a sector, whatever its sides; a slot is all there is.
inline double copies_in_vessel(const Domain& domain) {
  return domain.kind == DomainKind::sector ? domain.order : 1;
}

/// A wall: a polyline in the (r, z) half plane turned about z, or, in a slot, in the (x, z) plane drawn out along
/// y.
struct WallDescription {
  std::string name;
  std::vector<Eigen::Vector2d> profile;  // m, at least two points
  int material = 0;
  double spin = 0;      // rad/s about z
  double speed = 0;     // m/s upwards
  bool present = true;  // false: waits until a stage adds it
};

enum class RollingModel { none, constant_torque, elastic_plastic_spring };
enum class RollingVelocity {
  own,
  relative
};                                      // what a constant torque acts against: a grain's own spin or the pair's
enum class Tension { full, none };      // may the total normal force pull at separation?
enum class Coulomb { printed, total };  // is elastic plus viscous tangential force limited to mu_s |f_cn|?

struct ContactModel {
  ContactLaw law = ContactLaw::mindlin_deresiewicz;
  RollingModel rolling = RollingModel::constant_torque;
  RollingVelocity rolling_velocity = RollingVelocity::own;
  double rolling_damping = 0.3;  // ratio of critical, of the rolling spring
  Tension tension = Tension::full;
  Coulomb coulomb = Coulomb::printed;
  // Laws whose stiffness the scene gives: k_n, or the contact time from which it follows; k_t = tangential_ratio *
  // k_n
  double normal_stiffness = 0;  // N/m
  double contact_time = 0;      // s
  double tangential_ratio = 2.0 / 7.0;
};

struct SizeClass {
  double diameter = 0;  // m
  double fraction = 1;  // by number
  int material = 0;
};
struct UniformSizes {
  double smallest = 0, largest = 0;  // diameter, m
  int material = 0;
};
struct LognormalSizes {
  double median = 0;                 // diameter, m
  double sigma = 0;                  // standard deviation of ln(diameter)
  double smallest = 0, largest = 0;  // cut, m
  int material = 0;
};

/// Random fill: grains without overlap at random places in a region of revolution (or of the slot).
struct RandomFill {
  std::variant<std::vector<SizeClass>, UniformSizes, LognormalSizes> sizes;
  std::int64_t count = 0;        // for the FULL vessel; a sector takes count / order
  double r_low = 0, r_high = 0;  // m; in a slot x_low, x_high
  double z_low = 0, z_high = 0;  // m; grains lie within, surfaces included
  double speed = 0;              // m/s: each velocity component is uniform in [-speed, speed]
};
struct StateFile {
  std::string path;
  double diameter = 0;  // m, for files without a radius column
  int material = 0;     // for files without a material column
};
struct Source {
  std::variant<RandomFill, StateFile> grains;
  std::uint64_t seed = 1;
};

struct UntilTime {
  double duration = 0;
};                      // s, since the stage began
struct UntilAtRest {};  // see apps/scenes/README.md, "At rest"
struct UntilEmpty {};   // no grain is left
struct UntilDischarged {
  std::int64_t count = 0;
};  // grains out since the stage began, in this domain

struct Stage {
  std::string name;
  std::vector<std::string> remove, add;  // walls
  std::variant<UntilTime, UntilAtRest, UntilEmpty, UntilDischarged> until;
  double at_most = 0;               // s: stop the stage after this time in any case; 0: no bound
  std::optional<double> time_step;  // s
};

/// At rest: no grain was discharged and the mean kinetic energy per grain, translation and rotation, stayed below
/// that of a grain moving at `speed` during `duration`.
struct RestCriterion {
  double speed = 0;     // m/s; 0: 1e-3 sqrt(|g| d)
  double duration = 0;  // s;   0: 5 sqrt(d / |g|)
};

enum class FramePrecision { single_precision, double_precision };

struct Output {
  double frames_every = 0;        // s of simulated time; 0: only at stage ends
  bool contacts = true;           // write a contacts frame with each frame
  std::vector<double> frames_at;  // s of simulated time
  FramePrecision precision = FramePrecision::single_precision;
  double series_every = 0;        // s; 0: 200 rows per simulated second
  double checkpoint_every = 600;  // s of wall time
  bool energy_budget = true;      // book dissipation step by step, so that energies.csv has a residual
};

struct RunOptions {
  Precision precision = Precision::double_precision;
  double skin = 0;  // m; 0: chosen
  int threads = 0;  // 0: what the container may use
};

struct Scene {
  std::string name;                    // of the scene's file, without folder and extension: for titles
  std::string text;                    // the TOML text with --set applied to it listed below
  std::vector<std::string> overrides;  // key=value
  Domain domain;
  std::vector<WallDescription> walls;
  std::vector<Material> materials;
  ContactModel contact;
  PairTable<Interaction> interactions;
  Source particles;
  std::vector<Stage> stages;
  RestCriterion rest;
  double time_step = 0;  // s; 0: auto, 10 % of the Rayleigh time of the smallest grain
  Output output;
  std::string start_from;  // run folder or checkpoint to start from, with histories; empty: from `particles`
  RunOptions run;
};

}  // namespace wedge

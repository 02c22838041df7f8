// measured_domain.hpp: what every measure needs to know of a domain: its shape, its size, and d.
#pragma once

#include <limits>

#include "core/scene.hpp"
#include "core/symmetry.hpp"

namespace wedge {

struct MeasuredDomain {
  Scene scene;
  Symmetry symmetry = Symmetry::none();  // none where the sides are solid
  double diameter = 0;                   // m, d: mean of the grains at the start
  double radius =
      std::numeric_limits<double>::quiet_NaN();  // m, of the widest wall; of a slot half its width along x
  double left = 0;                               // m: of a slot its lowest x, else 0
  double lowest_wall = -std::numeric_limits<double>::infinity();  // m
  double theta = 0;  // rad, sector angle; 2 pi of a full vessel and a slot
  int order = 1;     // domains that make the vessel
  bool slot = false;

  /// Of the whole vessel [m2], at its widest place; nan without walls.
  double cross_section() const;
  double gravity() const { return scene.domain.gravity.norm(); }
};

/// `diameter` [m]: mean of the grains at the start. Without walls the radius is not known.
MeasuredDomain describe_domain(Scene scene, const Symmetry& symmetry, double diameter);

}  // namespace wedge

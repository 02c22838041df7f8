// bed_numbers.hpp: the numbers of a bed at one moment: packing, height, coordination, speeds, mass at the axis,
// slope.
#pragma once

#include <vector>

#include "apps/measure/bed.hpp"
#include "apps/measure/part.hpp"
#include "apps/results/scalar.hpp"

namespace wedge {

/// A grain with fewer contacts is a rattler.
inline constexpr int rattles_below = 2;

double volume_of(const BedGrain& grain);  // m3

/// By the definitions of the vocabulary, in the order in which files have them. Extensive numbers are those of the
/// whole vessel.
std::vector<Scalar> bed_numbers(const MeasuredDomain& domain, const Bed& bed, const Part& part);

/// The value of one of them; nan where it is not among them.
double value_of(const std::vector<Scalar>& numbers, std::string_view name);

}  // namespace wedge

// precision.hpp: in which width the work on contacts is done.
#pragma once

namespace wedge {

/// `mixed`: what contacts see beside places and radii, the contact law and the sums of forces are single precision
/// numbers. All that lasts from step to step, and the squares whose difference is an overlap, stay double.
enum class Precision { double_precision, mixed };

}  // namespace wedge

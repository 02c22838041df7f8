// threads.hpp: how many threads a run may use.
#pragma once

namespace wedge {

/// Processors this process may run on, and no more than the container's quota of processor time allows; at least 1.
int usable_threads();

}  // namespace wedge

// threads.hpp: how many threads a run may use.
#pragma once

namespace wedge {

/// Processors this process may run on, and no more than the container's quota of processor time allows; at least 1.
int usable_threads();

/// Bounds how long a thread spins at the end of a loop while it waits for the others. With the runtime's default
/// (seconds) a run on a busy machine burns its share of the processor in waiting: a tenth of the speed. The runtime
/// reads its settings when the program is loaded, so the program sets them and starts itself anew, once. What the
/// user has set stands.
void bound_spinning(char** argv);

}  // namespace wedge

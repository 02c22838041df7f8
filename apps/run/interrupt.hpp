// interrupt.hpp: Ctrl-C and SIGTERM as a question the run asks between steps.
#pragma once

namespace wedge {

/// From now on the first SIGINT, SIGTERM or SIGHUP is only remembered; a second one ends the program at once.
void catch_interrupts();
bool interrupted();

}  // namespace wedge

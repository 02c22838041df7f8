// command_line.hpp: from the words of the command line to a command.
#pragma once

namespace wedge {

/// Does what the command line says. Returns the exit code; a command line that makes no sense is told on standard
/// error. Throws what the commands throw.
int run_command_line(int argc, const char* const* argv);

}  // namespace wedge

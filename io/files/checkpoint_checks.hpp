// checkpoint_checks.hpp: whether what a checkpoint holds can be a state at all.
#pragma once

#include <string>

#include "core/state.hpp"

namespace wedge {

/// Throws FileError unless all arrays of the state have lengths that belong together and all that is used as an
/// index lies within what it is an index of: whoever runs the state on then reads no memory that is not its own. A
/// checksum tells a file that was changed, not one that was written wrongly. Pre: state.symmetry and state.vessel
/// are those of the scene; what belongs to its materials is for the caller to check.
void check_consistency(const State& state, const std::string& path);

}  // namespace wedge

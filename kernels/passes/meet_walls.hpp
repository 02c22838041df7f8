// meet_walls.hpp: which of the wall features near a grain touch it now.
#pragma once

#include "core/state.hpp"

namespace wedge {

/// What became of a row of the wall contact table in this step.
enum Touch : std::int32_t { apart = 0, held = 1, fresh = 2, left = 3 };

/// Rows [begin, end) are those of the grain in slot i. Post: `touching` holds a Touch, `overlap` is that of now,
/// and `force` holds the new normal until the wall pass puts the force there. A contact that is fresh on one
/// feature while the grain leaves the feature beside it is the same contact: it has taken history and normal along,
/// and the moment of a rolling spring if rows have `couples`.
void meet_walls(State& state, Index i, Index begin, Index end, bool couples);

/// Throws PhysicsError: the centre of the grain in slot i went through a wall.
[[noreturn]] void report_crossing(const State& state, Index i);

}  // namespace wedge

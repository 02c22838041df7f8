// meet_walls.hpp: which of the wall features near a grain touch it now.
#pragma once

#include <vector>

#include "core/state.hpp"

namespace wedge {

/// What became of a row of the wall contact table in this step.
enum class Touch { apart, held, fresh, left };

struct WallMeeting {
  Touch touch = Touch::apart;
  Vec3 normal;  // unit vector grain -> wall, now
};

/// Rows [begin, end) are those of the grain in slot i. Post: `met` says of each row what became of it, `overlap` in
/// the table is that of now. A contact that is fresh on one feature while the grain leaves the feature beside it is
/// the same contact: it has taken history and normal along, and the moment of a rolling spring if rows have
/// `couples`.
void meet_walls(State& state, Index i, Index begin, Index end, bool couples, std::vector<WallMeeting>& met);

/// Throws PhysicsError: the centre of the grain in slot i went through a wall.
[[noreturn]] void report_crossing(const State& state, Index i);

}  // namespace wedge

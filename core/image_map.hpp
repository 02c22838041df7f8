// image_map.hpp: which grain each image copies and by how many turns: remembered, never guessed from a distance.
#pragma once

#include <cstdint>

#include "core/array.hpp"

namespace wedge {

/// Image m stands in slot particles.count() + m and is grain owner[m] turned by turn[m].
/// Images of one owner are consecutive; owners ascend.
struct ImageMap {
  Array<Index> owner;
  Array<std::int32_t> turn;

  Index count() const { return static_cast<Index>(owner.size()); }
  void clear() {
    owner.clear();
    turn.clear();
  }
};

}  // namespace wedge

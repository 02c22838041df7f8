// grain_columns.hpp: a slab of grains as columns, to be turned into records, or out of them.
#pragma once

#include "kernels/passes/force_sums.hpp"
#include "kernels/passes/slab.hpp"

namespace wedge {

struct GrainColumns {
  Column number[seen_size];

  /// Writes what contacts will see of `count` grains from slot `first` on, in the width of the table.
  void write(SeenTable& seen, Index first, Index count) const;
  /// Reads the sums of `count` grains from slot `first` on.
  void read(const ForceSums& sums, Index first, Index count);
};

}  // namespace wedge

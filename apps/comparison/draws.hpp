// draws.hpp: whole random numbers the same on every machine.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/random.hpp"

namespace wedge {

class Draws {
public:
  /// Streams of different numbers are independent.
  explicit Draws(std::uint32_t stream) : random_(seed, stream) {}

  /// Uniform in 0 ... n - 1.
  std::size_t below(std::size_t n) { return static_cast<std::size_t>(random_.uniform() * static_cast<double>(n)); }

private:
  static constexpr std::uint64_t seed = 2014;  // any, but always this one: equal files give equal numbers
  RandomStream random_;
};

}  // namespace wedge

// random.hpp: counter-based random numbers: the k-th number of a stream is a pure function of (seed, stream, k).
//
// Philox4x32-10, Salmon, Moraes, Dror, Shaw (2011), "Parallel random numbers: as easy as 1, 2, 3", SC'11.
#pragma once

#include <array>
#include <cstdint>

namespace wedge {

/// One Philox4x32-10 block: four 32-bit numbers from a 128-bit counter and a 64-bit key.
inline std::array<std::uint32_t, 4> philox(std::array<std::uint32_t, 4> counter, std::array<std::uint32_t, 2> key) {
  for (int round = 0; round < 10; ++round) {
    const std::uint64_t p0 = std::uint64_t{0xD2511F53u} * counter[0];
    const std::uint64_t p1 = std::uint64_t{0xCD9E8D57u} * counter[2];
    counter = {static_cast<std::uint32_t>(p1 >> 32) ^ counter[1] ^ key[0], static_cast<std::uint32_t>(p1),
               static_cast<std::uint32_t>(p0 >> 32) ^ counter[3] ^ key[1], static_cast<std::uint32_t>(p0)};
    key[0] += 0x9E3779B9u;
    key[1] += 0xBB67AE85u;
  }
  return counter;
}

/// A stream of uniform numbers that remembers only how many it gave.
class RandomStream {
public:
  RandomStream(std::uint64_t seed, std::uint32_t stream, std::uint64_t given = 0)
      : seed_(seed), stream_(stream), given_(given) {}

  /// Next number, uniform in [0, 1), 53 bits.
  double uniform() {
    const auto b =
        philox({static_cast<std::uint32_t>(given_), static_cast<std::uint32_t>(given_ >> 32), stream_, 0},
               {static_cast<std::uint32_t>(seed_), static_cast<std::uint32_t>(seed_ >> 32)});
    ++given_;
    const std::uint64_t bits = (std::uint64_t{b[0]} << 32 | b[1]) >> 11;
    return static_cast<double>(bits) * 0x1p-53;
  }
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  std::uint64_t given() const { return given_; }

private:
  std::uint64_t seed_;
  std::uint32_t stream_;
  std::uint64_t given_;
};

}  // namespace wedge

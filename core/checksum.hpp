// checksum.hpp: FNV-1a, 64 bits: whether two runs of bytes are the same.
// http://www.isthe.com/chongo/tech/comp/fnv/
#pragma once

#include <cstddef>
#include <cstdint>

namespace wedge {

/// The checksum of nothing: what the first call of fnv1a goes on from.
constexpr std::uint64_t fnv_start = 0xcbf29ce484222325u;

/// Goes on with the checksum `hash` over `size` further bytes.
inline std::uint64_t fnv1a(std::uint64_t hash, const unsigned char* data, std::size_t size) {
  for (std::size_t k = 0; k < size; ++k) hash = (hash ^ data[k]) * 0x100000001b3u;
  return hash;
}

}  // namespace wedge

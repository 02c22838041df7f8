// target.cpp: the entry of libFuzzer; WEDGE_FUZZ_READER is one of the functions of fuzz_readers.hpp.
#include <cstddef>
#include <cstdint>

#include "tests/fuzz/fuzz_readers.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  wedge::fuzz::WEDGE_FUZZ_READER(std::string(reinterpret_cast<const char*>(data), size));
  return 0;
}

// test_finds.cpp: finds of the fuzzers, and their seeds, read again: every reader must return.
#include <algorithm>
#include <filesystem>
#include <vector>

#include "io/files/atomic_file.hpp"
#include "tests/fuzz/fuzz_readers.hpp"
#include "tests/support/catch.hpp"

using namespace wedge;

namespace {

template <class Reader>
void replay(const std::string& reader, Reader&& read) {
  std::size_t files = 0;
  for (const char* kind : {"seeds", "finds"}) {
    const std::filesystem::path folder = std::filesystem::path(WEDGE_SOURCE_DIR) / "tests" / "fuzz" / kind / reader;
    if (!std::filesystem::is_directory(folder)) continue;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
      INFO(entry.path());
      CHECK_NOTHROW(read(read_text_file(entry.path().string())));
      ++files;
    }
  }
  CHECK(files > 0);
}

}  // namespace

TEST_CASE("scenes that fuzzing found", "[fuzz]") { replay("scene", fuzz::scene); }
TEST_CASE("tables that fuzzing found", "[fuzz]") { replay("csv", fuzz::csv); }
TEST_CASE("checkpoints that fuzzing found", "[fuzz]") {
  replay("checkpoint", fuzz::checkpoint);
  replay("checkpoint_bytes", fuzz::checkpoint_bytes);
}

// test_checksum.cpp: the checksum against the published known answers.
#include "core/checksum.hpp"

#include <string>

#include "tests/support/catch.hpp"

using namespace wedge;

TEST_CASE("FNV-1a gives the known answers of its authors, in one piece and in two") {
  const auto of = [](const std::string& text, std::uint64_t hash = fnv_start) {
    return fnv1a(hash, reinterpret_cast<const unsigned char*>(text.data()), text.size());
  };
  CHECK(of("") == 0xcbf29ce484222325u);
  CHECK(of("a") == 0xaf63dc4c8601ec8cu);
  CHECK(of("foobar") == 0x85944171f73967e8u);
  CHECK(of("bar", of("foo")) == of("foobar"));
}

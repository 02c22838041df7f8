// test_json.cpp: JSON reads back to the bit, and damaged files are errors that name their place.
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/require.hpp"
#include "io/files/atomic_file.hpp"
#include "io/tables/file_series.hpp"
#include "io/tables/json.hpp"
#include "io/tables/provenance.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/scratch_folder.hpp"

using namespace wedge;
using Catch::Matchers::Contains;

namespace {

Json read_back(const Json& value) { return parse_json(json_text(value), "x.json"); }

/// What read_progress says of a file with this text.
std::string complaint(const std::string& text) {
  const ScratchFolder folder;
  write_text_file_atomically(folder / "progress.json", text);
  try {
    (void)read_progress(folder / "progress.json");
  } catch (const FileError& error) {
    return std::string(error.what()).substr(folder.path().size() + 1);
  }
  return "";
}

Progress sample_progress() {
  Progress progress;
  progress.state = "running";
  progress.stage = "dis\"charge\" \\ \xC3\xA9\n\x01";
  progress.step = 12345678901;
  progress.time = 0.1 + 0.2;
  progress.wall_seconds = 12.3;
  return progress;
}

}  // namespace

TEST_CASE("JSON reads back texts of any kind") {
  for (const std::string text :
       {"", "a\"b\\c/\b\f\n\r\t", "\x01\x1F\x7F", "\xC3\xA9 \xE2\x82\xAC \xF0\x9F\x8C\xBE", "{\"a\": [1]}"})
    CHECK(read_back({{"text", text}})["text"] == text);
  CHECK(read_back(std::string("zero\0inside", 11)) == std::string("zero\0inside", 11));
  CHECK(read_back({{"odd \"key\"\n", 1}})["odd \"key\"\n"] == 1);
}

TEST_CASE("JSON has U+FFFD for bytes that are not UTF-8") {
  CHECK(read_back("\xFF"
                  "a"
                  "\xC3") ==
        "\xEF\xBF\xBD"
        "a"
        "\xEF\xBF\xBD");
  for (const char* bad :
       {"\xED\xA0\x80", "\xC0\xAF", "\xF5\x80\x80\x80"})  // a surrogate, too long, beyond U+10FFFF
    CHECK_THAT(read_back(bad).get<std::string>(), Contains("\xEF\xBF\xBD"));
}

TEST_CASE("JSON reads back numbers to the bit, and has null where they are not finite") {
  using Limits = std::numeric_limits<double>;
  for (const double number :
       {0.1, 0.1 + 0.2, 1.0 / 3, -0.0, 1e22, 5e-324, Limits::min(), Limits::max(), 12.3, 9007199254740993.0}) {
    const auto read = read_back(number).get<double>();
    CHECK(read == number);
    CHECK(std::signbit(read) == std::signbit(number));
  }
  CHECK(json_text(0.1) == "0.1\n");
  CHECK(read_back(std::numeric_limits<std::int64_t>::min()) == std::numeric_limits<std::int64_t>::min());
  CHECK(read_back(std::numeric_limits<std::uint64_t>::max()) == std::numeric_limits<std::uint64_t>::max());
  for (const double number : {Limits::quiet_NaN(), Limits::infinity(), -Limits::infinity()})
    CHECK(json_text(number) == "null\n");
}

TEST_CASE("JSON keeps the order of its keys, one a line") {
  CHECK(json_text({{"b", 1}, {"a", "x"}, {"c", {{"z", nullptr}, {"y", true}}}}) ==
        "{\n  \"b\": 1,\n  \"a\": \"x\",\n  \"c\": {\n    \"z\": null,\n    \"y\": true\n  }\n}\n");
}

TEST_CASE("Text that is no JSON is a file error with line, column and what was expected") {
  CHECK_THROWS_WITH(parse_json("{\n\"a\": tru }", "x.json"),
                    Contains("x.json:2:9: is not JSON") && Contains("invalid literal"));
  CHECK_THROWS_WITH(parse_json("{\"a\" 1}", "x.json"), Contains("x.json:1:6: ") && Contains("expected ':'"));
  CHECK_THROWS_WITH(parse_json("", "x.json"), Contains("x.json:1:1: ") && Contains("unexpected end of input"));
  CHECK_THROWS_WITH(parse_json("[1e999]", "x.json"),
                    Contains("x.json") && Contains("1e999") && !Contains("json.exception"));
  for (const char* bad :
       {"", "{", "{\"a\"", "{\"a\":", "{\"a\": 1", "{\"a\": \"x", "{\"a\": \"\\u12\"}", "{} 1", "{\"a\": nan}",
        "{\"a\": \"\xFF\"}", "{\"a\": \"\n\"}", "\"\\ud800\"", "[1,]", "// remark\n1"})
    CHECK_THROWS_AS(parse_json(bad, "x.json"), FileError);
  const std::string deep(200000, '[');
  CHECK_THROWS_AS(parse_json(deep, "x.json"), FileError);
}

TEST_CASE("Progress reads back, one key a line for scripts") {
  const ScratchFolder folder;
  const Progress progress = sample_progress();
  write_progress(folder / "progress.json", progress);
  const std::string text = read_text_file(folder / "progress.json");
  CHECK_THAT(text, Contains("{\n  \"state\": \"running\",\n") && Contains("\n  \"wall_seconds\": 12.3,\n"));
  const Progress read = read_progress(folder / "progress.json");
  CHECK(read.state == progress.state);
  CHECK(read.stage == progress.stage);
  CHECK(read.step == progress.step);
  CHECK(read.time == progress.time);
  CHECK(read.eta_seconds == -1);
}

TEST_CASE("A damaged progress file is a file error") {
  const ScratchFolder folder;
  write_progress(folder / "progress.json", sample_progress());
  const std::string whole = read_text_file(folder / "progress.json");
  REQUIRE(complaint(whole).empty());
  for (std::size_t length = 0; length + 2 < whole.size(); ++length) {
    INFO(length);
    CHECK_THAT(complaint(whole.substr(0, length)), Contains("progress.json:") && Contains("is not JSON"));
  }
  CHECK_THAT(complaint("[1, 2]"), Contains("progress.json: is no progress file: expected a JSON object"));
  CHECK_THAT(complaint(std::string(64, '\0')), Contains("progress.json:1:1: is not JSON"));
  CHECK_THAT(complaint(R"({"state": 3})"), Contains("'state': expected a text"));
  CHECK_THAT(complaint(R"({"time": "soon"})"), Contains("'time': expected a number"));
  CHECK_THAT(complaint(R"({"grains": 1.5})"), Contains("'grains': expected a whole number"));
  CHECK_THAT(complaint(R"({"grains": 18446744073709551615})"), Contains("'grains': expected a whole number"));
  CHECK_THAT(complaint(R"({"stage_count": 2147483648})"), Contains("'stage_count': expected a whole number"));
  CHECK_THAT(complaint(R"({"step": null})"), Contains("'step': expected a whole number"));
  CHECK(complaint(R"({"time": null, "grains": -2147483649})").empty());
}

TEST_CASE("Provenance tells the program and not the user") {
  const ScratchFolder folder;
  write_provenance(folder / "provenance.json", {"/home/someone/bin/wedge", "run", "a \"b\".toml"}, 4, "mixed");
  const std::string text = read_text_file(folder / "provenance.json");
  CHECK_THAT(text, !Contains("someone"));
  const Json read = parse_json(text, "provenance.json");
  CHECK(read.at("threads") == 4);
  CHECK(read.at("command_line") == Json({"wedge", "run", "a \"b\".toml"}));
  CHECK(read.begin().key() == "program");
}

TEST_CASE("The series file lists names and times") {
  const ScratchFolder folder;
  write_file_series(folder / "particles.hdf.series", {{"particles_000000.hdf", 0}, {"particles_000001.hdf", 0.1}});
  const Json series = parse_json(read_text_file(folder / "particles.hdf.series"), "particles.hdf.series");
  CHECK(series == Json{{"file-series-version", "1.0"},
                       {"files",
                        {{{"name", "particles_000000.hdf"}, {"time", 0.0}},
                         {{"name", "particles_000001.hdf"}, {"time", 0.1}}}}});
  write_file_series(folder / "contacts.hdf.series", {});
  CHECK(parse_json(read_text_file(folder / "contacts.hdf.series"), "contacts.hdf.series").at("files") ==
        Json::array());
}

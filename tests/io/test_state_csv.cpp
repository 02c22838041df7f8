// test_state_csv.cpp: tables of grains read back to the bit; what is wrong is named by line and column.
#include <cstring>
#include <locale>

#include "core/require.hpp"
#include "io/files/atomic_file.hpp"
#include "io/tables/csv.hpp"
#include "io/tables/state_csv.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/sample_state.hpp"
#include "tests/support/scratch_folder.hpp"

using namespace wedge;
using Catch::Matchers::Contains;

namespace {

const std::vector<std::string> materials = {"glass", "steel, \"hard\""};
const std::string header = "id,x,y,z,vx,vy,vz,wx,wy,wz,radius,material\n";

Particles read_text(const ScratchFolder& folder, const std::string& text, StateCsvDefaults defaults = {}) {
  write_text_file_atomically(folder / "s.csv", text);
  return read_state_csv(folder / "s.csv", defaults, materials);
}

/// The message with which the text is refused.
std::string complaint(const ScratchFolder& folder, const std::string& text, StateCsvDefaults defaults = {}) {
  try {
    read_text(folder, text, defaults);
  } catch (const FileError& error) {
    return error.what();
  }
  return "accepted";
}

}  // namespace

TEST_CASE("numbers are written in the shortest form that reads back to the bit") {
  CHECK(number_text(0.1) == "0.1");
  CHECK(number_text(100000) == "100000");
  CHECK(number_text(-0.0) == "-0");
  CHECK(number_text(1e300) == "1e+300");
  for (const double value : {0.1 + 0.2, -0.0, 5e-324, 1.7976931348623157e308, 9007199254740991.0, 1e22, -1.0 / 3}) {
    double read = 7;
    REQUIRE(parse_number(number_text(value), read) == NumberError::none);
    CHECK(std::memcmp(&read, &value, sizeof value) == 0);
  }
  double value = 0;
  CHECK(parse_number("+1.5", value) == NumberError::none);
  CHECK(value == 1.5);
  for (const char* bad : {"", "+", "+-1", "1 ", " 1", "1,5", "0x1", "1e", "one"}) {
    CHECK(parse_number(bad, value) == NumberError::malformed);
  }
  CHECK(parse_number("1e999", value) == NumberError::out_of_range);
}

TEST_CASE("fields of a line keep commas and quotes inside quotes") {
  const auto fields = split_csv_line("a, \"b, \"\"c\"\"\" ,,d ");
  REQUIRE(fields.size() == 4);
  CHECK(fields[0].text == "a");
  CHECK(fields[1].text == "b, \"c\"");
  CHECK(fields[1].column == 4);
  CHECK(fields[2].text.empty());
  CHECK(fields[3].text == "d");
  CHECK(split_csv_line("").size() == 1);
  CHECK(split_csv_line("\"").size() == 1);
  CHECK(split_csv_line("a,").size() == 2);
  for (const char* text : {"plain", "a,b", "\"", " x ", ""})
    CHECK(split_csv_line(csv_quoted(text))[0].text == text);
}

TEST_CASE("a state file reads back to the bit") {
  const ScratchFolder folder;
  Particles p = sample_state().particles;
  for (std::size_t i = 0; i < 5; ++i) p.material[i] = static_cast<int>(i % 2);
  p.velocity.x[0] = -0.0;
  p.velocity.y[0] = 5e-324;
  write_state_csv(folder / "s.csv", p, materials);
  const Particles q = read_state_csv(folder / "s.csv", {}, materials);
  REQUIRE(q.count() == 5);
  const auto same = [](const auto& a, const auto& b) {
    return std::memcmp(a.data(), b.data(), 5 * sizeof(a[0])) == 0;
  };
  CHECK(same(q.position.x, p.position.x));
  CHECK(same(q.position.y, p.position.y));
  CHECK(same(q.position.z, p.position.z));
  CHECK(same(q.velocity.x, p.velocity.x));
  CHECK(same(q.velocity.y, p.velocity.y));
  CHECK(same(q.velocity.z, p.velocity.z));
  CHECK(same(q.angular_velocity.x, p.angular_velocity.x));
  CHECK(same(q.angular_velocity.y, p.angular_velocity.y));
  CHECK(same(q.angular_velocity.z, p.angular_velocity.z));
  CHECK(same(q.radius, p.radius));
  CHECK(same(q.material, p.material));
  CHECK(same(q.id, p.id));
  CHECK(q.mass == Array<double>(5, 0.0));
  CHECK(q.turns == Array<std::int32_t>(5, 0));
}

TEST_CASE("columns may come in any order, and some may be missing") {
  const ScratchFolder folder;
  const Particles p = read_text(folder,
                                "\xEF\xBB\xBF# a note\r\n\r\nz,y,x,vz,vy,vx,wz,wy,wx\r\n"
                                " 3, +2 ,1,6,5,4,9,8,7\r\n\r\n3e0,2,1,6,5,4,9,8,7",
                                {0.5, 1});
  REQUIRE(p.count() == 2);
  CHECK(p.position.x[0] == 1);
  CHECK(p.position.y[0] == 2);
  CHECK(p.velocity.z[1] == 6);
  CHECK(p.angular_velocity.x[1] == 7);
  CHECK(p.id == Array<std::int32_t>{0, 1});
  CHECK(p.radius == Array<double>{0.5, 0.5});
  CHECK(p.material == Array<std::int32_t>{1, 1});
  CHECK(read_text(folder, header).count() == 0);
}

TEST_CASE("each wrong value is named by line and column") {
  const ScratchFolder folder;
  const std::string path = folder / "s.csv";
  CHECK(complaint(folder, header + "1,2,3,4,5,6,7,8,9,10,0.1,glass\n1,2,3,x4,5,6,7,8,9,10,0.1,glass\n") ==
        path + ":3:7: error: expected a finite number for 'z', found 'x4'\n" + path +
            ":3:1: error: id 1 stands in line 2 already");
  const std::string start = header + "1,2,3,4,5,6,7,8,9,";
  CHECK_THAT(complaint(folder, start + "nan,0.1,glass\n"),
             Contains("2:19: error: expected a finite number for 'wz'"));
  CHECK_THAT(complaint(folder, start + "-inf,0.1,glass\n"), Contains("2:19"));
  CHECK_THAT(complaint(folder, start + "1e999,0.1,glass\n"), Contains("beyond the range of a double"));
  CHECK_THAT(complaint(folder, start + "1,0,glass\n"), Contains("2:21: error: expected a radius greater than 0"));
  CHECK_THAT(complaint(folder, start + "1,-0.1,glass\n"), Contains("greater than 0"));
  CHECK_THAT(complaint(folder, start + "1,,glass\n"), Contains("for 'radius', found ''"));
  CHECK_THAT(complaint(folder, start + "1,0.1,Glass\n"),
             Contains("2:25: error: unknown material 'Glass'; the scene has glass, steel, \"hard\""));
  CHECK_THAT(complaint(folder, start + "1,0.1\n"), Contains("expected 12 values, as in the header, found 11"));
  CHECK_THAT(complaint(folder, start + "1,0.1,glass,7\n"), Contains("2:31: error: expected 12 values"));
  CHECK_THAT(complaint(folder, header + "-1,2,3,4,5,6,7,8,9,10,0.1,glass\n"),
             Contains("2:1: error: expected a whole number"));
  CHECK_THAT(complaint(folder, header + "1.5,2,3,4,5,6,7,8,9,10,0.1,glass\n"), Contains("found '1.5'"));
  CHECK_THAT(complaint(folder, header + "4294967296,2,3,4,5,6,7,8,9,10,0.1,glass\n"), Contains("2147483647"));
}

TEST_CASE("a wrong header names every column that is wrong") {
  const ScratchFolder folder;
  const std::string message = complaint(folder, "x,y,z,vx,vy,vz,wx,wy,speed,x\n1,1,1,1,1,1,1,1,1,1\n");
  CHECK_THAT(message, Contains("1:22: error: unknown column 'speed'"));
  CHECK_THAT(message, Contains("1:28: error: column 'x' stands here a second time"));
  CHECK_THAT(message, Contains("column 'wz' is missing"));
  CHECK_THAT(message, Contains("column 'radius' is missing"));
  CHECK_THAT(message, Contains("column 'material' is missing"));
  CHECK_THAT(complaint(folder, ""),
             Contains("s.csv:1:1: error: the file is empty; expected the header line id,x,y,z"));
}

TEST_CASE("errors come ten at a time") {
  const ScratchFolder folder;
  std::string text = header;
  for (int k = 0; k < 50; ++k) text += "a,2,3,4,5,6,7,8,9,10,0.1,glass\n";
  const std::string message = complaint(folder, text);
  CHECK(std::count(message.begin(), message.end(), '\n') == 10);
  CHECK_THAT(message, Contains(":11:1: error") && !Contains(":12:1: error") && Contains("more errors follow"));
}

TEST_CASE("state files that cannot be read or written are refused by cause") {
  const ScratchFolder folder;
  CHECK_THROWS_WITH(read_state_csv(folder / "none.csv", {}, materials),
                    Contains("none.csv: cannot open: No such file"));
  CHECK_THROWS_WITH(read_state_csv(folder.path(), {}, materials), Contains("Is a directory"));
  CHECK_THROWS_AS(write_state_csv(folder / "no/s.csv", Particles(), materials), FileError);
  CHECK_THROWS_AS(write_state_csv(folder / "s.csv", Particles(), {"two\nlines"}), FileError);
}

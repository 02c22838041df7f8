// test_layering.cpp: the direction of dependency between the folders, read from the sources themselves.
#include <filesystem>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "io/files/atomic_file.hpp"
#include "tests/support/catch.hpp"

namespace {

struct Source {
  std::string path, text;  // path from the top of the sources: "core/vec3.hpp"
};

/// All C++ files of a top-level folder.
std::vector<Source> sources(const std::string& folder) {
  const std::filesystem::path top = WEDGE_SOURCE_DIR;
  std::vector<Source> found;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(top / folder)) {
    const std::string extension = entry.path().extension().string();
    if (extension == ".hpp" || extension == ".cpp" || extension == ".h")
      found.push_back(
          {entry.path().lexically_relative(top).string(), wedge::read_text_file(entry.path().string())});
  }
  return found;
}

/// Files of `folder` that include a file below one of the folders `above`, an expression.
std::vector<std::string> trespassers(const std::string& folder, const std::string& above) {
  const std::regex include("(^|\\n)[ \\t]*#[ \\t]*include[ \\t]*[\"<](\\.\\./)*(" + above + ")/");
  std::vector<std::string> found;
  for (const Source& source : sources(folder))
    if (std::regex_search(source.text, include)) found.push_back(source.path);
  return found;
}

/// Folders within `folder` that hold C++ files.
std::set<std::string> rooms(const std::string& folder) {
  std::set<std::string> found;
  for (const Source& source : sources(folder)) {
    const std::string rest = source.path.substr(folder.size() + 1);
    if (rest.find('/') != std::string::npos) found.insert(rest.substr(0, rest.find('/')));
  }
  return found;
}

/// Files in the rooms of `folder` that include one that stands beside the rooms.
std::vector<std::string> includers_of_top(const std::string& folder) {
  const std::regex include("(^|\\n)[ \\t]*#[ \\t]*include[ \\t]*[\"<](\\.\\./)*" + folder + "/[^/\">]*[\">]");
  std::vector<std::string> found;
  for (const Source& source : sources(folder))
    if (source.path.find('/', folder.size() + 1) != std::string::npos && std::regex_search(source.text, include))
      found.push_back(source.path);
  return found;
}

/// Checks that the rooms of `folder` are these, from the lowest floor to the highest, and that none of them
/// includes a file of one above it.
void check_floors(const std::string& folder, const std::vector<std::string>& from_below) {
  INFO(folder);
  CHECK(rooms(folder) == std::set<std::string>(from_below.begin(), from_below.end()));
  for (std::size_t floor = 0; floor + 1 < from_below.size(); ++floor) {
    std::string above;
    for (std::size_t k = floor + 1; k < from_below.size(); ++k)
      above += (above.empty() ? "" : "|") + folder + "/" + from_below[k];
    INFO(from_below[floor]);
    CHECK(trespassers(folder + "/" + from_below[floor], above) == std::vector<std::string>{});
  }
}

using Paths = std::vector<std::string>;

}  // namespace

TEST_CASE("No folder includes one above it") {
  CHECK(trespassers("core", "kernels|io|apps|tests|perf") == Paths{});
  CHECK(trespassers("kernels", "io|apps|tests|perf") == Paths{});
  CHECK(trespassers("io", "kernels|apps|tests|perf") == Paths{});
  CHECK(trespassers("apps", "tests|perf") == Paths{});
  CHECK_FALSE(trespassers("apps", "io").empty());  // the search does find what is there
}

TEST_CASE("No room includes one on a floor above it") {
  check_floors("kernels", {"laws", "neighbours", "passes"});
  check_floors("io", {"files", "tables", "scene"});
  check_floors("apps", {"results", "measure", "setup", "run", "analysis", "comparison", "commands"});
}

TEST_CASE("The rooms of kernels do not know what stands above them: the step, energies, the choice of passes") {
  CHECK(includers_of_top("kernels") == Paths{});
}

TEST_CASE("Only core/parallel.hpp knows OpenMP") {
  const std::regex openmp("#[ \\t]*pragma[ \\t]+omp|_Pragma\\(\"omp|<omp\\.h>|\\bomp_[a-z]+_");
  Paths found;
  for (const char* folder : {"core", "kernels", "io", "apps"})
    for (const Source& source : sources(folder))
      if (std::regex_search(source.text, openmp)) found.push_back(source.path);
  CHECK(found == Paths{"core/parallel.hpp"});
}

TEST_CASE("No file is called util, and every file says what it is in its first line") {
  for (const char* folder : {"core", "kernels", "io", "apps", "tests", "perf"}) {
    for (const Source& source : sources(folder)) {
      INFO(source.path);
      const std::string name = std::filesystem::path(source.path).filename().string();
      CHECK(name.find("util") == std::string::npos);
      CHECK(source.text.compare(0, name.size() + 5, "// " + name + ": ") == 0);
    }
  }
}

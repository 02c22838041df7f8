// test_layering.cpp: the direction of dependency between the folders, read from the sources themselves.
#include <filesystem>
#include <regex>
#include <string>
#include <vector>

#include "io/atomic_file.hpp"
#include "tests/catch.hpp"

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

/// Files of `folder` that include a file of one of the folders `above`.
std::vector<std::string> trespassers(const std::string& folder, const std::string& above) {
  const std::regex include("(^|\\n)[ \\t]*#[ \\t]*include[ \\t]*[\"<](\\.\\./)*(" + above + ")/");
  std::vector<std::string> found;
  for (const Source& source : sources(folder))
    if (std::regex_search(source.text, include)) found.push_back(source.path);
  return found;
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

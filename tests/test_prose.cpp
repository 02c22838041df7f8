// test_prose.cpp: the READMEs keep to their lengths, and name only files that are there.
#include <algorithm>
#include <filesystem>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "io/files/atomic_file.hpp"
#include "tests/support/catch.hpp"

namespace {

namespace fs = std::filesystem;

constexpr std::size_t longest_line = 120;                            // characters
constexpr int longest_front_page = 1199, longest_tests_page = 2499;  // words

const fs::path top = WEDGE_SOURCE_DIR;

/// Paths from the top of the sources of all Markdown files but those in folders that hold what was built or run.
std::vector<std::string> markdown_files() {
  std::vector<std::string> found;
  const auto gather = [&](const fs::directory_entry& entry) {
    if (entry.path().extension() == ".md") found.push_back(entry.path().lexically_relative(top).string());
  };
  for (const auto& entry : fs::directory_iterator(top)) gather(entry);
  for (const char* folder : {"core", "kernels", "io", "apps", "tests", "perf"})
    for (const auto& entry : fs::recursive_directory_iterator(top / folder)) gather(entry);
  std::sort(found.begin(), found.end());
  return found;
}

std::vector<std::string> lines_of(const std::string& file) {
  std::istringstream text(wedge::read_text_file((top / file).string()));
  std::vector<std::string> lines;
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  return lines;
}

bool is_table(const std::string& line) { return !line.empty() && line[0] == '|'; }
bool is_code(const std::string& line) { return line.compare(0, 4, "    ") == 0; }

/// Characters, not bytes: those of UTF-8 that continue a character do not count.
std::size_t characters(const std::string& line) {
  return static_cast<std::size_t>(std::count_if(
      line.begin(), line.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

/// Words of a file, without the tables that `bash tests/run.sh --validate` writes between its markers.
int written_words(const std::string& file) {
  int words = 0;
  bool generated = false;
  for (const std::string& line : lines_of(file)) {
    if (line.compare(0, 12, "<!-- end of ") == 0) generated = false;
    std::istringstream text(line);
    for (std::string word; !generated && text >> word;) ++words;
    if (line.find(": written by ") != std::string::npos && line.compare(0, 5, "<!-- ") == 0) generated = true;
  }
  return words;
}

/// Where links of the text lead within the repository, as the text has them.
std::vector<std::string> links(const std::string& line) {
  static const std::regex link("\\]\\(([^)#]+)[^)]*\\)");
  std::vector<std::string> found;
  for (std::sregex_iterator m(line.begin(), line.end(), link), end; m != end; ++m)
    if ((*m)[1].str().find("://") == std::string::npos) found.push_back((*m)[1]);
  return found;
}

/// What looks like a source file of a folder of the repository: "kernels/time_step.cpp", "tests/README.md".
std::vector<std::string> named_files(const std::string& line) {
  static const std::regex path(
      "(^|[^A-Za-z0-9_./-])((core|kernels|io|apps|tests|perf)/[A-Za-z0-9_./-]*[A-Za-z0-9_-]\\."
      "(cpp|hpp|py|sh|md|toml|txt|awk|png|svg|dat))(?![A-Za-z0-9_/*-])");
  std::vector<std::string> found;
  for (std::sregex_iterator m(line.begin(), line.end(), path), end; m != end; ++m) found.push_back((*m)[2]);
  return found;
}

/// Folders in `code`: `apps/results/`.
std::vector<std::string> named_folders(const std::string& line) {
  static const std::regex path("`((core|kernels|io|apps|tests|perf)/([A-Za-z0-9_-]+/)*)`");
  std::vector<std::string> found;
  for (std::sregex_iterator m(line.begin(), line.end(), path), end; m != end; ++m) found.push_back((*m)[1]);
  return found;
}

}  // namespace

TEST_CASE("Lines of Markdown are short, but in tables and code") {
  REQUIRE(markdown_files().size() > 10);
  for (const std::string& file : markdown_files()) {
    int number = 0;
    for (const std::string& line : lines_of(file)) {
      ++number;
      INFO(file << ":" << number << ": " << line);
      if (!is_table(line) && !is_code(line)) CHECK(characters(line) <= longest_line);
    }
  }
}

TEST_CASE("The front page and the tests' page are no longer than they may be") {
  CHECK(written_words("README.md") <= longest_front_page);
  CHECK(written_words("tests/README.md") <= longest_tests_page);
  CHECK(written_words("tests/README.md") > 500);  // the generated tables end where they say
}

TEST_CASE("Links and paths of the READMEs lead to what is there") {
  int links_seen = 0, files_seen = 0;
  for (const std::string& file : markdown_files()) {
    int number = 0;
    for (const std::string& line : lines_of(file)) {
      INFO(file << ":" << ++number);
      for (const std::string& target : links(line)) {
        CAPTURE(target);
        CHECK(fs::exists((top / file).parent_path() / target));
        ++links_seen;
      }
      for (const std::string& target : named_files(line)) {
        CAPTURE(target);
        CHECK(fs::exists(top / target));
        ++files_seen;
      }
      for (const std::string& target : named_folders(line)) {
        CAPTURE(target);
        CHECK(fs::is_directory(top / target));
      }
    }
  }
  CHECK(links_seen > 20);
  CHECK(files_seen > 40);
}

TEST_CASE("Licence, citation and the guide for contributors are there") {
  CHECK(wedge::read_text_file((top / "LICENSE").string()).find("Copyright (c) 2026, the wedge authors") !=
        std::string::npos);
  CHECK(wedge::read_text_file((top / "CITATION.cff").string()).find("cff-version: 1.2.0") == 0);
  CHECK(fs::exists(top / "CONTRIBUTING.md"));
}

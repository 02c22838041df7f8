// report.cpp: wedge report: runs the scripts of apps/report, which draw the figures of runs and write one
// page.
#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>

#include "apps/commands/commands.hpp"
#include "apps/commands/embedded_files.hpp"
#include "apps/results/vocabulary.hpp"
#include "core/require.hpp"
#include "io/tables/provenance.hpp"

extern char** environ;

namespace wedge {
namespace {

namespace fs = std::filesystem;

/// A folder with the scripts and the vocabulary, which goes when the page is made.
class Scripts {
public:
  Scripts() {
    std::string name = (fs::temp_directory_path() / "wedge_report_XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw FileError(name + ": cannot make it: " + std::strerror(errno));
    folder_ = name;
    for (const EmbeddedFile& file : embedded_report()) write(file.name, file.text);
    write("vocabulary.json", vocabulary_json());
  }
  Scripts(const Scripts&) = delete;
  Scripts& operator=(const Scripts&) = delete;
  ~Scripts() {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }
  std::string folder() const { return folder_.string(); }

private:
  void write(const std::string& name, const std::string& text) const {
    std::ofstream out(folder_ / name, std::ios::binary);
    if (!(out << text) || !out.flush()) throw FileError((folder_ / name).string() + ": cannot write it");
  }

  fs::path folder_;
};

enum class Terminal { ours, none };

/// Runs a program found by PATH and waits for it. Returns its exit code, 128 + signal when one ended it, 127 when
/// there is no such program.
int run_program(const std::vector<std::string>& words, Terminal output) {
  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  if (output == Terminal::none)
    for (const int stream : {STDOUT_FILENO, STDERR_FILENO})
      posix_spawn_file_actions_addopen(&actions, stream, "/dev/null", O_WRONLY, 0);
  pid_t process = 0;
  const int failure = posix_spawnp(&process, arguments[0], &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failure != 0) return 127;
  const auto before = std::signal(SIGINT, SIG_IGN);  // the script gets it too and ends; we then clean up
  int status = 0;
  while (waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  std::signal(SIGINT, before);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

/// A Python that has numpy and matplotlib, or "": WEDGE_PYTHON if it is set, else that of PATH or that of the
/// system.
std::string python() {
  std::vector<std::string> candidates{"python3", "/usr/bin/python3"};
  if (const char* wish = std::getenv("WEDGE_PYTHON")) candidates = {wish};
  for (const std::string& candidate : candidates)
    if (run_program({candidate, "-B", "-c", "import numpy, matplotlib"}, Terminal::none) == 0) return candidate;
  return "";
}

std::string page_of(const ReportArguments& arguments) {
  if (!arguments.output.empty()) return arguments.output;
  if (arguments.folders.size() > 1) return "report.html";
  const fs::path folder = fs::path(arguments.folders.front()) / "report";
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw FileError(folder.string() + ": cannot make it: " + error.message());
  return (folder / "index.html").string();
}

}  // namespace

int command_report(const ReportArguments& arguments) {
  for (const std::string& folder : arguments.folders)
    if (!fs::is_directory(folder)) throw FileError(folder + ": no such folder");
  for (const std::string& file : arguments.comparisons)
    if (!fs::is_regular_file(file)) throw FileError(file + ": no such file");
  const std::string interpreter = python();
  if (interpreter.empty()) {
    std::cerr << "wedge: report needs Python with numpy and matplotlib: "
                 "apt-get install python3-matplotlib python3-numpy\n";
    return exit_code::file;
  }
  const Scripts scripts;
  std::vector<std::string> words{interpreter, "-B", scripts.folder(), "--version-text=" + version_text(),
                                 "--output=" + page_of(arguments)};
  if (!arguments.title.empty()) words.push_back("--title=" + arguments.title);
  for (const std::string& file : arguments.comparisons) words.push_back("--compare=" + file);
  words.emplace_back("--");
  words.insert(words.end(), arguments.folders.begin(), arguments.folders.end());
  std::cout.flush();
  const int code = run_program(words, Terminal::ours);
  if (code == 128 + SIGINT || code == exit_code::interrupted) return exit_code::interrupted;
  return code == exit_code::ok || code == exit_code::file ? code : exit_code::internal;
}

}  // namespace wedge

// real_program.hpp: the real `wedge`, run as a program of its own, so that it can be stopped, killed and refused;
// and whether two folders hold the same run to the byte.
#pragma once

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "io/files/atomic_file.hpp"
#include "tests/support/scratch_folder.hpp"

namespace wedge::test {

/// How a program ended: its exit code (128 + signal when one killed it) and what it said.
struct Ended {
  int code = 0;
  std::string output, errors;
};

/// A program that runs.
class Program {
public:
  /// `output`: a file for its standard output instead of our own.
  Program(const std::vector<std::string>& words, std::string output)
      : output_(output.empty() ? scratch_ / "output" : std::move(output)) {
    std::vector<char*> arguments;
    for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    const std::string errors = scratch_ / "errors";
    process_ = fork();
    if (process_ < 0) throw std::runtime_error("cannot start a program");  // and never send a signal to -1
    if (process_ > 0) return;
    const int out = ::open(output_.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
    const int err = ::open(errors.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
    ::dup2(out, STDOUT_FILENO);
    ::dup2(err, STDERR_FILENO);
    ::execv(arguments[0], arguments.data());
    ::_exit(127);
  }
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;
  ~Program() {
    if (process_ <= 0) return;
    ::kill(process_, SIGKILL);
    ::waitpid(process_, nullptr, 0);
  }

  void send(int signal) const { ::kill(process_, signal); }
  Ended wait() {
    int status = 0;
    ::waitpid(process_, &status, 0);
    process_ = 0;
    Ended ended;
    ended.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    if (std::filesystem::is_regular_file(output_)) ended.output = read_text_file(output_);
    ended.errors = read_text_file(scratch_ / "errors");
    return ended;
  }
  /// Waits for a condition, a minute at most. Returns whether it came true.
  bool wait_until(const std::function<bool()>& condition) const {
    for (int k = 0; k < 60000; ++k) {
      if (condition()) return true;
      ::usleep(1000);
    }
    return false;
  }
  /// Waits until it has ended, `seconds` at most. Returns whether it has.
  bool ends_within(double seconds) const {
    const auto start = std::chrono::steady_clock::now();
    siginfo_t info{};
    for (;;) {
      if (::waitid(P_PID, static_cast<id_t>(process_), &info, WEXITED | WNOHANG | WNOWAIT) == 0 && info.si_pid != 0)
        return true;
      if (std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() > seconds) return false;
      ::usleep(200);
    }
  }

private:
  ScratchFolder scratch_;
  std::string output_;
  pid_t process_ = 0;
};

/// The `wedge` of this build with these words.
inline Program wedge_program(std::vector<std::string> words, const std::string& output = "") {
  words.insert(words.begin(), WEDGE_PROGRAM);
  return Program(words, output);
}

}  // namespace wedge::test

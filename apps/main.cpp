// main.cpp: runs the command line and turns what goes wrong into one message and an exit code.
#include <cstdio>
#include <exception>
#include <filesystem>
#include <iostream>
#include <new>
#include <stdexcept>
#include <string>

#include "apps/commands/command_line.hpp"
#include "apps/commands/commands.hpp"
#include "apps/run/threads.hpp"
#include "core/require.hpp"

namespace {

int failed(int code, const std::string& message) {
  std::cerr << message << (message.empty() || message.back() != '\n' ? "\n" : "") << std::flush;
  return code;
}

int internal_error(std::string what) {
  const std::string prefix = "internal error: ";
  if (what.compare(0, prefix.size(), prefix) != 0) what.insert(0, prefix);
  return failed(wedge::exit_code::internal, what);
}

}  // namespace

int main(int argc, char** argv) {
  namespace code = wedge::exit_code;
  wedge::bound_spinning(argv);
  try {
    const int result = wedge::run_command_line(argc, argv);
    std::cout.flush();
    if (!std::cout || std::fflush(stdout) != 0) return failed(code::file, "standard output: cannot write");
    return result;
  } catch (const wedge::SceneError& e) {
    return failed(code::scene, e.what());
  } catch (const wedge::FileError& e) {
    return failed(code::file, e.what());
  } catch (const std::filesystem::filesystem_error& e) {
    const std::string path = e.path1().string();
    return failed(code::file, path + ": " + e.code().message());
  } catch (const wedge::PhysicsError& e) {
    return failed(code::physics, e.what());
  } catch (const std::bad_alloc&) {
    return internal_error("not enough memory");
  } catch (const std::exception& e) {
    return internal_error(e.what());
  }
}

// require.hpp: the ways to be wrong. assert: our bug, hot path, checked builds. require: our bug, always on.
// The exceptions are the user's or the world's fault; apps turns each into an exit code and a message.
#pragma once

#include <stdexcept>
#include <string>

namespace wedge {

/// Stops with std::logic_error when a condition that only a bug in wedge can break does not hold.
inline void require(bool condition, const char* what) {
  if (!condition) throw std::logic_error(std::string("internal error: ") + what);
}

/// The scene is wrong (exit code 3). The message is complete: place, cause, remedy.
struct SceneError : std::runtime_error {
  using std::runtime_error::runtime_error;
};
/// A file or the disk failed (exit code 4). The message names the path.
struct FileError : std::runtime_error {
  using std::runtime_error::runtime_error;
};
/// The simulated physics left the range in which it means something (exit code 5).
struct PhysicsError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace wedge

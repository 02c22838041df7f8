// stopwatch.hpp: wall time spent in named passes, measured from outside them.
#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <string>

namespace wedge {

struct PassTime {
  double seconds = 0;
  std::int64_t calls = 0;
};

/// Sums of wall time by pass name; keeps nothing but sums.
class Stopwatch {
public:
  template <class Body>
  auto time(const char* pass, Body&& body) {
    const Running running{times_[pass]};
    return body();
  }
  const std::map<std::string, PassTime>& times() const { return times_; }

private:
  struct Running {
    PassTime& sum;
    std::chrono::steady_clock::time_point begin = std::chrono::steady_clock::now();
    explicit Running(PassTime& s) : sum(s) {}
    Running(const Running&) = delete;
    Running& operator=(const Running&) = delete;
    ~Running() {
      sum.seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
      ++sum.calls;
    }
  };
  std::map<std::string, PassTime> times_;
};

}  // namespace wedge

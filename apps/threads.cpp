// threads.cpp: reads the processor affinity and the control group's quota.
#include "apps/threads.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>

#include "core/parallel.hpp"

namespace wedge {

int usable_threads() {
  int threads = processor_count();
  std::ifstream quota("/sys/fs/cgroup/cpu.max");  // "QUOTA PERIOD" in microseconds, or "max PERIOD"
  std::string allowed;
  double period = 0;
  if (quota >> allowed >> period && allowed != "max" && period > 0)
    threads = std::min(threads, static_cast<int>(std::ceil(std::stod(allowed) / period)));
  return std::max(1, threads);
}

}  // namespace wedge

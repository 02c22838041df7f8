// threads.cpp: reads the processor affinity and the control group's quota.
#include "apps/run/threads.hpp"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <string>

#include "core/parallel.hpp"

namespace wedge {

void bound_spinning(char** argv) {
#ifdef __linux__
  if (std::getenv("GOMP_SPINCOUNT") || std::getenv("KMP_BLOCKTIME") || std::getenv("OMP_WAIT_POLICY")) return;
  ::setenv("GOMP_SPINCOUNT", "1000", 0);  // gcc's runtime: rounds, a few microseconds (perf/README.md, "Waiting")
  ::setenv("KMP_BLOCKTIME", "1", 0);      // clang's runtime: milliseconds
  // By its own path, so that ps shows its name and not "exe". Comes back only when it failed: then go on as we are.
  char path[4096];
  const ssize_t length = ::readlink("/proc/self/exe", path, sizeof path - 1);
  if (length > 0) {
    path[length] = '\0';
    ::execv(path, argv);
  }
#else
  (void)argv;
#endif
}

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

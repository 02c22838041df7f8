// speed_error.cpp: runs what speed_error.md needs and is not yet there.
//
//   speed_error [--quick] FOLDER
//
// Each result is kept in FOLDER as a file of its own: a stopped command goes on where it was. One thread.
#include <chrono>
#include <cstdio>
#include <exception>
#include <string>

#include "core/parallel.hpp"
#include "perf/speed_error/plan.hpp"

namespace {

using namespace wedge::speed_error;

void run(const std::string& folder, Size size) {
  const Store store(folder, size);
  const std::vector<Job> all = jobs(size);
  const auto begin = std::chrono::steady_clock::now();
  int number = 0;
  for (const Job& job : all) {
    ++number;
    if (store.has(job)) continue;
    store.keep(job, job.work());
    const double passed = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    std::printf("%5.0f s  %3d of %zu  %s\n", passed, number, all.size(), job.name.c_str());
    std::fflush(stdout);
  }
}

}  // namespace

int main(int argc, char** argv) {
  const bool quick = argc > 1 && std::string(argv[1]) == "--quick";
  if (argc != (quick ? 3 : 2) || argv[argc - 1][0] == '-') {
    std::fprintf(stderr, "usage: speed_error [--quick] FOLDER\n");
    return 2;
  }
  try {
    wedge::set_thread_count(1);
    run(argv[argc - 1], quick ? Size::quick : Size::full);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "speed_error: %s\n", error.what());
    return 1;
  }
}

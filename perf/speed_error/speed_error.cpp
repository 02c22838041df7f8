// speed_error.cpp: runs what speed_error.md needs and is not yet there, then writes the page and the picture.
//
//   speed_error [--quick] [--page-only] --results FOLDER --page BASE --origin TEXT
//
// --page-only runs nothing: the page of what there is.
// Each result is kept in FOLDER as a file of one line: a stopped command goes on where it was. One thread.
#include <chrono>
#include <cstdio>
#include <exception>
#include <map>
#include <string>

#include "core/parallel.hpp"
#include "perf/speed_error/plan.hpp"

namespace {

using namespace wedge::speed_error;

int run(const std::map<std::string, std::string>& option, Size size, bool page_only) {
  const Plan plan(size);
  const Store store(option.at("--results"));
  const std::vector<Job> jobs = plan.jobs();
  const auto begin = std::chrono::steady_clock::now();
  int number = 0;
  for (const Job& job : jobs) {
    ++number;
    if (page_only || store.find(job.name)) continue;
    store.keep(job.name, job.work());
    const double passed = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    std::printf("%5.0f s  %3d of %zu  %s\n", passed, number, jobs.size(), job.name.c_str());
    std::fflush(stdout);
  }
  write_page(option.at("--page"), plan, store, option.at("--origin"));
  std::printf("%s.md and %s.svg written\n", option.at("--page").c_str(), option.at("--page").c_str());
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  std::map<std::string, std::string> option{{"--results", ""}, {"--page", ""}, {"--origin", ""}};
  Size size = Size::full;
  bool sound = true, page_only = false;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--quick")
      size = Size::quick;
    else if (word == "--page-only")
      page_only = true;
    else if (option.count(word) && i + 1 < argc)
      option[word] = argv[++i];
    else
      sound = false;
  }
  if (!sound || option["--results"].empty() || option["--page"].empty()) {
    std::fprintf(stderr,
                 "usage: speed_error [--quick] [--page-only] --results FOLDER --page BASE [--origin TEXT]\n");
    return 2;
  }
  try {
    wedge::set_thread_count(1);
    return run(option, size, page_only);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "speed_error: %s\n", error.what());
    return 1;
  }
}

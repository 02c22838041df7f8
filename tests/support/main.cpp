// main.cpp: the test runner's main, for Catch2 version 2 and 3.
#if __has_include(<catch2/catch_all.hpp>)
#include <catch2/catch_session.hpp>
#else
#define CATCH_CONFIG_RUNNER
#include <catch2/catch.hpp>
#endif

#include "core/parallel.hpp"

int main(int argc, char** argv) {
  wedge::set_thread_count(1);  // ctest runs tests side by side; those about threads ask for more themselves
  return Catch::Session().run(argc, argv);
}

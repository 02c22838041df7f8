// interrupt.cpp: the signal handler sets a flag and does nothing else.
#include "apps/run/interrupt.hpp"

#include <csignal>

namespace wedge {
namespace {
volatile std::sig_atomic_t flag = 0;

extern "C" void remember(int signal) {
  flag = 1;
  std::signal(signal, SIG_DFL);
}
}  // namespace

void catch_interrupts() {
  std::signal(SIGINT, remember);
  std::signal(SIGTERM, remember);
  std::signal(SIGHUP, remember);
  std::signal(SIGPIPE, SIG_IGN);  // a closed pipe of standard output must not end a run
}
bool interrupted() { return flag != 0; }

}  // namespace wedge

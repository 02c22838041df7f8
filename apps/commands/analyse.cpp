// analyse.cpp: wedge analyse: measures a run and says where the results are.
#include <charconv>
#include <iostream>
#include <string>

#include "apps/analysis/analyse.hpp"
#include "apps/commands/commands.hpp"
#include "apps/results/vocabulary.hpp"
#include "apps/run/threads.hpp"
#include "core/parallel.hpp"

namespace wedge {
namespace {

/// A time as people read it: 9 digits, without what rounding left behind them.
std::string time_text(double seconds) {
  char buffer[32];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, seconds, std::chars_format::general, 9);
  return std::string(buffer, end.ptr);
}

}  // namespace

int command_definitions() {
  std::cout << definitions_text();
  return exit_code::ok;
}

int command_analyse(const AnalyseArguments& arguments) {
  set_thread_count(arguments.threads > 0 ? arguments.threads : usable_threads());
  AnalysisRequest request;
  request.folder = arguments.folder;
  if (arguments.from || arguments.to)
    request.span = TimeSpan{arguments.from.value_or(0), arguments.to.value_or(1e300)};
  if (!arguments.orders.empty()) request.parts.orders = arguments.orders;
  request.parts.wedges = arguments.wedges;
  request.cut = arguments.cut;
  const AnalysisReport report = analyse(request);
  for (const Moment& m : report.moments) {
    std::cout << m.name << ": ";
    if (m.kind == MomentKind::mean)
      std::cout << m.frames.size() << (m.frames.size() == 1 ? " frame, " : " frames, ") << time_text(m.begin)
                << " to ";
    std::cout << time_text(m.end) << " s\n";
  }
  if (arguments.wedges > 0 && !report.full_vessel) std::cout << "no wedges: they are cut from full vessels only\n";
  for (const std::string& note : report.notes) std::cout << note << '\n';
  std::cout << report.frames << (report.frames == 1 ? " frame" : " frames") << " read; written:\n";
  for (const std::string& file : report.files) std::cout << "  " << file << '\n';
  return exit_code::ok;
}

}  // namespace wedge

// command_line.cpp: what the command line may say, with help and examples.
#include "apps/commands/command_line.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <functional>
#include <iostream>

#include "apps/commands/commands.hpp"
#include "apps/results/vocabulary.hpp"
#include "io/scene/diagnostics.hpp"
#include "io/tables/csv.hpp"
#include "io/tables/provenance.hpp"

namespace wedge {
namespace {

const char* const examples =
    "Examples:\n"
    "  wedge new hopper > hopper.toml\n"
    "  wedge check hopper.toml --set domain.angle=90\n"
    "  wedge run hopper.toml -o full -j 8\n"
    "  wedge run hopper.toml -o sector90 --set domain.angle=90 --set particles.seed=2\n"
    "  wedge status full\n"
    "  wedge resume full --wall-time 12:00:00\n"
    "  wedge analyse full --wedges 4\n"
    "  wedge compare full_1 full_2 --with sector90_1 sector90_2 --csv table.csv\n"
    "  wedge report full_1 full_2 sector90_1 sector90_2 --compare table.csv -o page.html\n"
    "  wedge export sector90 --last --to csv --unfold -o state.csv\n"
    "  wedge export full --frame 3 --to vtp --vessel\n"
    "Exit codes: 0 ok, 1 internal error, 2 usage, 3 scene, 4 file or disk, 5 physics, 6 outside tolerance,\n"
    "  75 stopped at the wall-time limit with a checkpoint, 130 interrupted with a checkpoint\n";

double number_of(const std::string& option, const std::string& text) {
  double value = 0;
  if (parse_number(text, value) != NumberError::none || !(value >= 0) || value > 1e12)
    throw CLI::ValidationError(option, "'" + text + "' is not a time in seconds");
  return value;
}

/// "90", "1.5e3" or "HH:MM:SS" in seconds.
double wall_time_of(const std::string& text) {
  if (text.find(':') == std::string::npos) return number_of("--wall-time", text);
  std::vector<int> parts;
  std::size_t begin = 0;
  for (;;) {
    const std::size_t end = std::min(text.find(':', begin), text.size());
    int part = 0;
    const std::string digits = text.substr(begin, end - begin);
    const bool plain = !digits.empty() && digits.find_first_not_of("0123456789") == std::string::npos;
    if (!plain || parse_number(digits, part) != NumberError::none || (!parts.empty() && part > 59)) break;
    parts.push_back(part);
    if (end == text.size()) {
      if (parts.size() != 3) break;
      return 3600.0 * parts[0] + 60.0 * parts[1] + parts[2];
    }
    begin = end + 1;
  }
  throw CLI::ValidationError("--wall-time", "'" + text + "' is neither seconds nor HH:MM:SS");
}

/// "90,60": the numbers of sectors of these angles in a vessel.
std::vector<int> orders_of(const std::string& text) {
  std::vector<int> orders;
  for (const CsvField& field : split_csv_line(text)) {
    const std::optional<int> sectors = sectors_of(field.text);
    if (!sectors)
      throw CLI::ValidationError(
          "--angles", "'" + field.text + "' is not an angle in degrees between 1 and 180 that divides 360");
    if (std::find(orders.begin(), orders.end(), *sectors) == orders.end()) orders.push_back(*sectors);
  }
  return orders;
}

/// The commands with their options; `todo` is what the chosen one does.
class CommandLine {
public:
  CommandLine(int argc, const char* const* argv) : words_(argv, argv + argc) {
    app_.set_version_flag("--version", "wedge " + version_text());
    app_.require_subcommand(0, 1);
    add_check();
    add_run();
    add_resume();
    add_looking();
    add_analyse();
    add_export();
    add_new();
    add_report();
    app_.footer(examples);  // last, or every command would inherit it
  }

  int run() {
    if (const std::string problem = unknown_command(); !problem.empty()) return usage(problem);
    try {
      app_.parse(static_cast<int>(words_.size()), pointers().data());
    } catch (const CLI::Success& wish) {  // --help, --version
      return app_.exit(wish, std::cout, std::cerr);
    } catch (const CLI::ParseError& error) {
      return usage(error.what());
    }
    if (!todo_) return usage("a command is needed");
    return todo_();
  }

private:
  std::vector<const char*> pointers() const {
    std::vector<const char*> all;
    for (const std::string& word : words_) all.push_back(word.c_str());
    return all;
  }
  static int usage(const std::string& problem) {
    std::cerr << "wedge: " << problem
              << "\n`wedge --help` lists the commands, `wedge COMMAND --help` their options.\n";
    return exit_code::usage;
  }
  std::string unknown_command() const {
    if (words_.size() < 2 || words_[1].empty() || words_[1][0] == '-') return "";
    std::vector<std::string> names;
    for (const CLI::App* command : app_.get_subcommands([](const CLI::App*) { return true; }))
      names.push_back(command->get_name());
    if (std::find(names.begin(), names.end(), words_[1]) != names.end()) return "";
    return "there is no command '" + words_[1] + "'; " + suggestion(words_[1], names);
  }

  CLI::App* command(const std::string& name, const std::string& purpose, std::function<int()> todo) {
    CLI::App* added = app_.add_subcommand(name, purpose);
    added->callback([this, todo = std::move(todo)] { todo_ = todo; });
    return added;
  }
  void scene_options(CLI::App* command) {
    command->add_option("SCENE", run_.scene, "scene file (TOML)")->required();
    command
        ->add_option(
            "--set", run_.overrides,
            "use this value instead of the scene's; may be repeated (particles.file replaces the keys of a fill)")
        ->allow_extra_args(false)
        ->expected(1)
        ->take_all()
        ->type_name("KEY=VALUE");
  }
  void thread_option(CLI::App* command) {
    command->add_option("-j,--threads", run_.threads, "number of threads (default: all this process may use)")
        ->check(CLI::Range(1, 4096))
        ->type_name("N");
  }
  void limit_options(CLI::App* command) {
    command->add_flag("--timings", run_.timings, "print the time of each pass at the end");
    command
        ->add_option_function<std::string>(
            "--wall-time",
            [this](const std::string& text) {
              run_.wall_time = wall_time_of(text);
              if (!(run_.wall_time > 0)) throw CLI::ValidationError("--wall-time", "it must be above 0");
            },
            "stop with a checkpoint after this time (exit code 75)")
        ->type_name("SECONDS|HH:MM:SS");
  }
  void folder_option(CLI::App* command, std::string& folder) {
    command->add_option("DIR", folder, "folder of the run")->required();
  }

  void add_check() {
    CLI::App* check = command("check", "Check a scene, explain it, and estimate what running it will cost",
                              [this] { return command_check(run_.scene, run_.overrides, run_.threads); });
    scene_options(check);
    thread_option(check);
  }
  void add_run() {
    CLI::App* run = command("run", "Run a scene", [this] { return command_run(completed()); });
    scene_options(run);
    thread_option(run);
    run->add_option("-o,--output", run_.folder, "folder to create for the run")
        ->required()
        ->type_name("DIR")
        ->option_text("DIR REQUIRED");
    limit_options(run);
  }
  void add_resume() {
    CLI::App* resume =
        command("resume", "Continue from the newest valid checkpoint, as if the run had never stopped",
                [this] { return command_resume(completed()); });
    folder_option(resume, run_.folder);
    thread_option(resume);
    limit_options(resume);
    resume
        ->add_option_function<std::string>(
            "--until", [this](const std::string& text) { run_.until = number_of("--until", text); },
            "stop with a checkpoint at this simulated time")
        ->type_name("SECONDS");
  }
  void add_looking() {
    folder_option(command("status", "Report in one line how far a run has got, even while it is running",
                          [this] { return command_status(run_.folder); }),
                  run_.folder);
    CLI::App* compare = command("compare", "Compare two sets of runs: their beds and their analyses",
                                [this] { return command_compare(reference_, with_, compare_); });
    compare->add_option("REF", reference_, "folders of the reference runs")->required();
    compare->add_option("--with", with_, "folders of the runs to compare")->required()->type_name("RUN");
    compare->add_option("--csv", compare_.csv, "write every row of the comparison to this file")->type_name("FILE");
    compare
        ->add_option("--tolerance", compare_.tolerance,
                     "file of tolerances (TOML); exit code 6 if a row is outside them")
        ->type_name("FILE");
    compare->add_option("--moment", compare_.moment, "compare this moment only")->type_name("NAME");
  }
  void add_analyse() {
    CLI::App* analyse = command("analyse", "Measure a run into DIR/results (--definitions says what)", [this] {
      if (definitions_) return command_definitions();
      if (analyse_.folder.empty()) return usage("analyse needs DIR, or --definitions");
      if (analyse_.from && analyse_.to && *analyse_.from > *analyse_.to) return usage("--from is later than --to");
      return command_analyse(analyse_);
    });
    analyse->add_option("DIR", analyse_.folder, "folder of the run");
    analyse->add_flag("--definitions", definitions_, "print what every quantity means, and nothing else");
    const auto time_option = [&](const char* name, std::optional<double>& time, const char* meaning) {
      analyse
          ->add_option_function<std::string>(
              name, [name, &time](const std::string& text) { time = number_of(name, text); }, meaning)
          ->type_name("SECONDS");
    };
    time_option("--from", analyse_.from,
                "also average the frames from this simulated time on (moment window_mean)");
    time_option("--to", analyse_.to, "... and up to this one");
    analyse
        ->add_option_function<std::string>(
            "--angles", [this](const std::string& text) { analyse_.orders = orders_of(text); },
            "sector angles whose axis zones, and wedges, are wanted of a full vessel (default 90,60,45,30)")
        ->type_name("DEGREES,...");
    analyse
        ->add_option("--wedges", analyse_.wedges,
                     "cut this many wedges of each angle from a full vessel (default 0)")
        ->check(CLI::Range(0, 360))
        ->type_name("N");
    analyse->add_option("--cut", analyse_.cut, "height of the horizontal cut [m] (default 5 d above the ground)")
        ->type_name("Z");
    analyse->add_option("-j,--threads", analyse_.threads, "number of threads (default: all this process may use)")
        ->check(CLI::Range(1, 4096))
        ->type_name("N");
  }
  void add_export() {
    CLI::App* out = command("export", "Write a frame as a table (csv) or for a viewer (vtp), or write the walls",
                            [this] { return export_checked(); });
    folder_option(out, export_.folder);
    auto* frame =
        out->add_option("--frame", frame_, "number of the frame")->check(CLI::Range(0, 999999))->type_name("K");
    out->add_flag("--last", "the last frame (the default)")->excludes(frame);
    out->add_option("--to", export_.format, "csv (readable back as a starting state) or vtp")
        ->check(CLI::IsMember({"csv", "vtp"}))
        ->type_name("FORMAT");
    out->add_option("-o,--output", export_.output, "file (default: csv to standard output, vtp beside the frame)")
        ->type_name("FILE");
    out->add_flag("--unfold", export_.unfold, "all copies of a sector: the whole vessel");
    out->add_flag("--vessel", export_.vessel, "the walls, as .vtp");
  }
  void add_new() {
    command("new", "Print a commented scene: hopper or sandpile", [this] { return command_new(name_); })
        ->add_option("SCENE", name_, "hopper or sandpile")
        ->required();
  }
  void add_report() {
    CLI::App* report =
        command("report", "Draw the figures of analysed runs on one HTML page (needs python3-matplotlib)",
                [this] { return command_report(report_); });
    report->add_option("DIR", report_.folders, "folders of runs, or folders that hold runs up to three levels down")
        ->required();
    report
        ->add_option("-o,--output", report_.output,
                     "page to write (default: DIR/report/index.html; for several DIRs, ./report.html)")
        ->type_name("FILE");
    report->add_option("--compare", report_.comparisons, "files of `wedge compare --csv`")->type_name("FILE");
    report->add_option("--title", report_.title, "title of the page")->type_name("TEXT");
  }

  int export_checked() {
    if (export_.format.empty() && !export_.vessel) return usage("export needs --to csv, --to vtp or --vessel");
    if (frame_ >= 0) export_.frame = frame_;
    return command_export(export_);
  }
  /// The arguments of run and resume with what is not a plain option.
  RunArguments completed() {
    run_.command_line = words_;
    return run_;
  }

  CLI::App app_{"wedge: discrete-element simulation of grains in cylindrical vessels, whole or by the slice",
                "wedge"};
  std::vector<std::string> words_;
  std::function<int()> todo_;
  RunArguments run_;
  ExportArguments export_;
  AnalyseArguments analyse_;
  ReportArguments report_;
  std::string name_;
  std::vector<std::string> reference_, with_;
  CompareOptions compare_;
  long frame_ = -1;
  bool definitions_ = false;
};

}  // namespace

int run_command_line(int argc, const char* const* argv) { return CommandLine(argc, argv).run(); }

}  // namespace wedge

// test_analyse.cpp: wedge analyse on whole runs: moments, files, threads, and what it refuses.
#include <filesystem>
#include <iostream>
#include <sstream>

#include "apps/analysis/analyse.hpp"
#include "apps/results/bed_table.hpp"
#include "core/parallel.hpp"
#include "io/files/atomic_file.hpp"
#include "io/tables/csv.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/little_hopper.hpp"
#include "tests/support/scratch_folder.hpp"

using namespace wedge;
using namespace wedge::test;

namespace {

/// Value of a number in scalars.csv.
double scalar(const std::string& run, const std::string& moment, const std::string& part, const std::string& name) {
  const std::string text = read_text_file(run + "/results/scalars.csv");
  const std::string row = "\n" + moment + "," + part + "," + name + ",";
  const std::size_t at = text.find(row);
  REQUIRE(at != std::string::npos);
  const auto fields = split_csv_line(std::string_view(text).substr(at + 1, text.find('\n', at + 1) - at - 1));
  double value = 0;
  REQUIRE(parse_number(fields[4].text, value) == NumberError::none);
  return value;
}

AnalysisReport analysed(const std::string& run, PartRequest parts = {}, std::optional<TimeSpan> span = {}) {
  AnalysisRequest request;
  request.folder = run;
  request.parts = std::move(parts);
  request.span = span;
  return analyse(request);
}

/// What the command prints.
std::string printed(const AnalyseArguments& arguments) {
  std::ostringstream out;
  struct Restore {
    std::streambuf* screen;
    ~Restore() { std::cout.rdbuf(screen); }
  } const restore{std::cout.rdbuf(out.rdbuf())};
  command_analyse(arguments);
  return out.str();
}

}  // namespace

TEST_CASE(
    "wedge analyse: a sector's moments and numbers are those of its run, the same for any number of threads") {
  const ScratchFolder folder;
  const std::string run = folder / "run";
  REQUIRE(command_run(arguments_for(run, 2)) == exit_code::ok);
  const AnalysisReport report = analysed(run);
  REQUIRE(report.moments.size() == 4);
  CHECK(report.moments[0].name == "settle");
  CHECK(report.moments[1].name == "settle_mean");
  CHECK(report.moments[1].kind == MomentKind::mean);
  CHECK(report.moments[1].begin == 0);
  CHECK(report.moments[2].name == "discharge");
  CHECK(report.moments[3].frames.size() == 8);
  // The ends of stages were measured from the state itself, by the same definitions: in a frame numbers are
  // rounded.
  for (const StageResult& stage : read_bed_table(RunFolder(run).beds())) {
    int same = 0;
    for (const BedQuantity& q : stage.quantities) {
      const ResultQuantity* known = find_quantity(q.name);
      if (known == nullptr || !known->is_in(in_scalars)) continue;
      INFO(stage.stage << " " << q.name);
      if (q.name != "discharge_rate") {
        const double analysed = scalar(run, stage.stage, "whole", q.name);
        CHECK((analysed == Approx(q.value).epsilon(1e-4) || (std::isnan(analysed) && std::isnan(q.value))));
      } else if (stage.stage == "discharge") {
        CHECK(scalar(run, "discharge_mean", "whole", q.name) == Approx(q.value).epsilon(1e-4));
      }
      ++same;
    }
    CHECK(same == 6);
  }
  // One record tells when stages began and ended, and what stood.
  const std::vector<StageRecord> stages = read_stages(RunFolder(run));
  REQUIRE(stages.size() == 2);
  CHECK(stages[0].walls == std::vector<std::string>{"shell", "floor", "plug"});
  CHECK(stages[1].walls == std::vector<std::string>{"shell", "floor"});
  CHECK(stages[1].begin == stages[0].end);
  CHECK(stages[1].how == StageEnd::time);
  CHECK(report.moments[0].role == MomentRole::other);  // it ended by the clock, at rest or not
  CHECK(report.moments[2].role == MomentRole::flow);
  CHECK(report.moments[3].stage == "discharge");
  // All that left, six times, over the stage's 0.4 s; the last row of the flow is that of its end.
  const std::string ledger = read_text_file(run + "/series/ledger.csv");
  const auto last = split_csv_line(ledger.substr(ledger.rfind('\n', ledger.size() - 2) + 1));
  double out = 0;
  REQUIRE(parse_number(last[3].text.substr(0, last[3].text.find('\n')), out) == NumberError::none);
  CHECK(scalar(run, "discharge_mean", "whole", "discharge_rate") == Approx(6 * out / 0.4).epsilon(0.03));
  const std::string flow = read_text_file(run + "/results/flow.csv");
  CHECK(flow.rfind("\n0.4," + std::to_string(6 * static_cast<int>(out)) + ",") != std::string::npos);
  CHECK(read_text_file(run + "/results/summary.json").find("\"angle_deg\": 60") != std::string::npos);
  std::vector<std::string> texts;
  for (const std::string& file : report.files) texts.push_back(read_text_file(file));
  for (const int threads : {1, 3}) {
    set_thread_count(threads);
    const AnalysisReport again = analysed(run);
    REQUIRE(again.files == report.files);
    for (std::size_t k = 0; k < texts.size(); ++k) CHECK(read_text_file(again.files[k]) == texts[k]);
  }
  // A span of time besides the stages, whose numbers stay what they are.
  CHECK(analysed(run, {}, TimeSpan{0.5, 1e300}).moments[5].frames.size() == 2);  // from 0.5 s to the end
  const double settled = scalar(run, "settle", "whole", "cn"),
               line = scalar(run, "discharge_mean", "whole", "beverloo_low");
  analysed(run, {}, TimeSpan{0, 0.05});  // a bed that is still falling is not the one at the opening
  CHECK(scalar(run, "discharge_mean", "whole", "beverloo_low") == line);
  const AnalysisReport window = analysed(run, {}, TimeSpan{0.2, 0.3});
  REQUIRE(window.moments.size() == 6);
  CHECK(window.moments[5].name == "window_mean");
  CHECK(window.moments[5].frames.size() == 3);
  CHECK(scalar(run, "settle", "whole", "cn") == settled);
  CHECK(scalar(run, "discharge_mean", "whole", "beverloo_low") == line);
  CHECK_THROWS_AS(analysed(run, {}, TimeSpan{7, 8}), FileError);
  // Without frames of contacts the overlaps count; forces are not known.
  for (int k = 0; k < 13; ++k) std::filesystem::remove(RunFolder(run).frame("contacts", k));
  const double with_contacts = scalar(run, "window", "whole", "cn");
  analysed(run, {}, TimeSpan{0.2, 0.3});
  CHECK(scalar(run, "window", "whole", "cn") == Approx(with_contacts).epsilon(1e-3));
  CHECK(std::isnan(scalar(run, "window", "whole", "load")));
}

TEST_CASE("wedge analyse: the wedges of a full vessel make up the whole") {
  const ScratchFolder folder;
  const std::string run = folder / "run";
  REQUIRE(command_run(arguments_for(run, 2, {"domain.angle=360", "stage.discharge.until=0.1"})) == exit_code::ok);
  analysed(run, {{3}, 3});
  for (const char* moment : {"settle", "discharge_mean"}) {
    double grains = 0, weighted = 0;
    for (const char* part : {"wedge_n3_0", "wedge_n3_1", "wedge_n3_2"}) {
      const double held = scalar(run, moment, part, "grains");
      grains += held / 3;
      weighted += held / 3 * scalar(run, moment, part, "cn");
    }
    CHECK(grains == Approx(scalar(run, moment, "whole", "grains")).epsilon(1e-4));
    CHECK(weighted / grains == Approx(scalar(run, moment, "whole", "cn")).epsilon(0.01));
  }
  // What does not come out as it was asked for is said; times are told to nine digits.
  AnalyseArguments asked;
  asked.folder = run;
  asked.orders = {3, 4};
  asked.wedges = 9;
  asked.cut = 5;
  asked.threads = 2;
  const std::string text = printed(asked);
  CHECK_THAT(text,
             Catch::Contains(" m of the height 5 m at settle, discharge; centres of the bed's grains lie between"));
  CHECK_THAT(text, Catch::Contains("cut.csv: no grain lies within 0.0044") && Catch::Contains(" and 0.1"));
  CHECK_THAT(text, Catch::Contains("wedges: of the 9 asked for a vessel has room for 3 of 120, 4 of 90 degrees\n"));
  CHECK_THAT(text, Catch::Contains("settle: 0.15 s\n"));
  CHECK_THAT(text, Catch::Contains(" to 0.25 s\n"));
  asked.cut = 0.01;
  asked.wedges = 3;
  const std::string plain = printed(asked);
  CHECK_THAT(plain, !Catch::Contains("no grain lies"));
  CHECK_THAT(plain, !Catch::Contains("wedges:"));
}

TEST_CASE("wedge analyse: refuses what is no run, and one that has not got to the end of a stage") {
  const ScratchFolder folder;
  CHECK_THROWS_AS(analysed(folder / "none"), FileError);
  const std::string run = folder / "run";
  REQUIRE(command_run(arguments_for(run, 2, {"stage.settle.until=0.1", "stage.discharge.until=0.02"})) ==
          exit_code::ok);
  std::vector<StageRecord> stages = read_stages(RunFolder(run));
  std::filesystem::remove(RunFolder(run).stages());
  CHECK_THROWS_WITH(analysed(run), Catch::Contains("stages.csv: is missing"));
  stages.resize(1);
  stages[0].how = StageEnd::running;  // as in a run that goes on
  write_stages(RunFolder(run).stages(), stages);
  CHECK_THROWS_WITH(analysed(run), Catch::Contains("no stage has ended yet"));
  CHECK(analysed(run, {}, TimeSpan{0, 1}).frames > 1);
  std::filesystem::remove(
      RunFolder(run).frame("particles", 1));  // a gap would shift what is taken for a stage's end
  CHECK_THROWS_WITH(analysed(run, {}, TimeSpan{0, 1}), Catch::Contains("particles_000001.hdf: is missing"));
  std::filesystem::remove_all(RunFolder(run).frames());
  CHECK_THROWS_AS(analysed(run, {}, TimeSpan{0, 1}), FileError);
}

// test_compare_vocabulary.cpp: wedge compare compares what the vocabulary names, and by its kind.
#include <map>
#include <tuple>

#include "apps/results/vocabulary.hpp"
#include "tests/support/compare_command.hpp"
#include "tests/support/synthetic_study.hpp"

using namespace wedge;
using namespace wedge::test;

TEST_CASE("What is compared of scalars, distributions, profiles and maps is what the vocabulary says",
          "[compare]") {
  Study study;
  const auto full = study.full(1), sector = study.sectors(1, 0);
  std::string scalars = "moment,part,quantity,unit,value,low,high\n";
  std::string distributions = "moment,part,region,quantity,unit,scale,step,first,counts\n";
  std::map<std::string, std::vector<std::string>> expected, found;
  for (const ResultQuantity* q : quantities_in(in_scalars)) {
    scalars += std::string("settle,whole,") + q->name + "," + q->unit + ",1,nan,nan\n";
    if (q->compared()) expected["scalar"].push_back(q->name);
  }
  for (const ResultQuantity* q : quantities_in(in_distributions)) {
    distributions += std::string("settle,whole,all,") + q->name + "," + q->unit + ",1,0,0,1 2\n";
    if (q->compared()) expected["distribution"].push_back(q->name);
  }
  for (const auto& [kind, file, table] :
       {std::tuple{"profile", "radial.csv", in_profile}, std::tuple{"map", "map.csv", in_map}}) {
    std::string head = "moment,part", row = "settle,whole";
    for (const ResultQuantity* q : quantities_in(table)) {
      head += "," + heading(q->name);
      row += ",1";
      if (q->compared() && q->name != std::string(row_weight)) expected[kind].push_back(q->name);
    }
    for (const std::string& folder : {full[0], sector[0]})
      write_text_file_atomically(folder + "/results/" + file, head + "\n" + row + "\n");
  }
  for (const std::string& folder : {full[0], sector[0]}) {
    write_text_file_atomically(folder + "/results/scalars.csv", scalars);
    write_text_file_atomically(folder + "/results/distributions.csv", distributions);
  }
  CompareOptions options;
  options.csv = study.path("rows.csv");
  compare(full, sector, options);
  for (const Row& row : rows_of(options.csv))
    if (row.at("region") == "all" && row.at("measure") != "ks") {
      found[row.at("kind")].push_back(row.at("quantity"));
      CHECK(row.at("unit") == quantity(row.at("quantity")).unit);
    }
  CHECK(found == expected);

  // Sums over a vessel and over a slot have nothing to do with each other.
  rewrite(sector[0] + "/scene.resolved.toml", "angle = 90", "kind = \"slot\"\nwidth = 0.02");
  rewrite(sector[0] + "/scene.resolved.toml", "r = [0, \"20 d\"]", "x = [0, \"20 d\"]");
  compare(full, sector, options);
  int rows = 0;
  for (const Row& row : rows_of(options.csv)) {
    const QuantityKind kind = quantity(row.at("quantity")).kind;
    CHECK((kind != QuantityKind::extensive && kind != QuantityKind::per_height));
    ++rows;
  }
  CHECK(rows > 20);
}

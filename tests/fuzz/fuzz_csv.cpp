// fuzz_csv.cpp: any text as a table of grains, of beds, a series to go on with, or a progress file.
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "apps/results/bed_table.hpp"
#include "core/require.hpp"
#include "io/files/atomic_file.hpp"
#include "io/tables/csv.hpp"
#include "io/tables/provenance.hpp"
#include "io/tables/series.hpp"
#include "io/tables/state_csv.hpp"
#include "tests/fuzz/fuzz_readers.hpp"
#include "tests/support/scratch_folder.hpp"

namespace wedge::fuzz {
namespace {

void grains(const std::string& path, const std::string& copy) {
  const std::vector<std::string> materials = {"grain", "wall, \"rough\""};
  const Particles read = read_state_csv(path, {0.0025, 0}, materials);
  write_state_csv(copy, read, materials);
  const Particles again = read_state_csv(copy, {}, materials);
  bool same = again.count() == read.count();
  Particles::for_each_field(read, [&](const FieldInfo& info, const auto& field) {
    Particles::for_each_field(again, [&](const FieldInfo& other, const auto& copied) {
      if constexpr (std::is_same_v<decltype(field), decltype(copied)>)
        if (std::string(info.name) == other.name) same = same && field == copied;
    });
  });
  if (!same) throw std::logic_error("a table of grains does not read back to itself");
}

void progress(const std::string& path, const std::string& copy) {
  const auto texts = [](const Progress& p) { return p.state + '\n' + p.stage + '\n' + p.message; };
  const Progress read = read_progress(path);
  write_progress(copy, read);
  const Progress again = read_progress(copy);
  if (texts(again) != texts(read) || again.step != read.step || again.time != read.time)
    throw std::logic_error("a progress file does not read back to itself");
}

}  // namespace

void csv(const std::string& bytes) {
  static const ScratchFolder scratch;
  if (bytes.empty()) return;
  const std::string path = scratch / "table.csv", text = bytes.substr(1);
  std::ofstream(path, std::ios::binary | std::ios::trunc) << text;
  try {
    switch (bytes[0]) {
      case 'b':
        (void)read_bed_table(path);
        return;
      case 's':
        SeriesFile::reopen(path, {{"time", "s"}, {"n, all", ""}}, 1.0).append({1.5, 2});
        if (read_text_file(path).back() != '\n') throw std::logic_error("a series ends within a row");
        return;
      case 'j':
        progress(path, scratch / "copy.json");
        return;
      default:
        grains(path, scratch / "copy.csv");
    }
  } catch (const FileError&) {
  }
}

}  // namespace wedge::fuzz

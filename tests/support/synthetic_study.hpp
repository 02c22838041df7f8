// synthetic_study.hpp: folders of runs of a known law, as `wedge analyse` leaves them.
#pragma once

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "core/random.hpp"
#include "io/files/atomic_file.hpp"
#include "io/tables/csv.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/sound_scene.hpp"

namespace wedge::test {

inline constexpr double d = 0.002;  // m, of the sound scene

/// What a wedge of a synthetic vessel is like; parts add up to wholes.
struct Part {
  std::vector<double> counts;  // of vz, bins of one unit from -10 on
  std::vector<double> cn;      // of 12 rings
};

inline Part operator+(const Part& a, const Part& b) {
  Part sum = a;
  for (std::size_t k = 0; k < sum.counts.size(); ++k) sum.counts[k] += b.counts[k];
  for (std::size_t k = 0; k < sum.cn.size(); ++k) sum.cn[k] += b.cn[k];
  return sum;
}

inline double normal(RandomStream& random) {
  double sum = -6;
  for (int k = 0; k < 12; ++k) sum += random.uniform();
  return sum;
}

inline Part random_part(RandomStream& random, double shift) {
  Part part{std::vector<double>(20, 0), {}};
  for (int k = 0; k < 200; ++k) {
    const double value = std::min(19.0, std::max(0.0, std::floor(10 + shift + 2 * normal(random))));
    part.counts[static_cast<std::size_t>(value)] += 1;
  }
  for (int ring = 0; ring < 12; ++ring) part.cn.push_back(5 + shift + 0.1 * normal(random));
  return part;
}

/// The files of one run as text, part by part. `wedges`: of how many wedges the part is the sum.
class Files {
public:
  void add(const std::string& part, const Part& content, int wedges) {
    for (const char* moment : {"settle", "flow_mean"}) {
      const std::string head = std::string(moment) + "," + part + ",";
      double grains = 0, sum = 0, cn = 0;
      std::string counts;
      for (std::size_t k = 0; k < content.counts.size(); ++k) {
        grains += content.counts[k];
        sum += (static_cast<double>(k) - 9.5) * content.counts[k];
        counts += (k > 0 ? " " : "") + number_text(content.counts[k]);
      }
      for (const double of_ring : content.cn) cn += of_ring / 12 / wedges;
      scalars += head + "vz,m/s," + number_text(sum / grains) + ",nan,nan\n";
      scalars += head + "cn,-," + number_text(cn) + ",nan,nan\n";
      // sinh(k asinh(1)) would stretch the bins; a step so small leaves them even.
      for (const char* region : {"all", "axis_zone_n4", "rest_n4"})
        distributions += head + region + ",vz,m/s,1000000,1e-6,-10," + counts + "\n";
      for (int ring = 0; ring < 12; ++ring) {
        const std::string r = number_text((ring + 0.5) * d / 2),
                          value = number_text(content.cn[static_cast<std::size_t>(ring)] / wedges);
        radial += head + r + ",1," + number_text(ring + 1) + "," + value + "\n";
        map += head + r + "," + number_text(d) + "," + number_text(ring + 1) + "," + value + ",3\n";
      }
    }
  }
  void write(const std::string& folder, double angle) const {
    std::filesystem::create_directories(folder + "/results");
    write_text_file_atomically(folder + "/scene.resolved.toml",
                               replaced(sound, "angle = 90", "angle = " + number_text(angle)));
    write_text_file_atomically(folder + "/results/scalars.csv", scalars);
    write_text_file_atomically(folder + "/results/distributions.csv", distributions);
    write_text_file_atomically(folder + "/results/radial.csv", radial);
    write_text_file_atomically(folder + "/results/map.csv", map);
    write_text_file_atomically(folder + "/results/summary.json",
                               "{\"domain\": {\"diameter_m\": " + number_text(d) + "}}\n");
  }

  std::string scalars = "moment,part,quantity,unit,value,low,high\n",
              distributions = "moment,part,region,quantity,unit,scale,step,first,counts\n",
              radial = "moment,part,r [m],arc [d],grains,cn\n", map = "moment,part,r [m],z [m],grains,cn,zone\n";
};

/// Folders of synthetic runs: full vessels of four wedges, and sectors of 90 degrees whose law may be shifted.
class Study {
public:
  std::vector<std::string> full(int runs) {
    std::vector<std::string> folders;
    for (int run = 0; run < runs; ++run) {
      Files files;
      Part whole = random_part(random_, 0);
      files.add("wedge_n4_0", whole, 1);
      for (int k = 1; k < 4; ++k) {
        const Part wedge = random_part(random_, 0);
        files.add("wedge_n4_" + std::to_string(k), wedge, 1);
        whole = whole + wedge;
      }
      files.add("whole", whole, 4);
      folders.push_back(scratch_ / ("full" + std::to_string(made_++)));
      files.write(folders.back(), 360);
    }
    return folders;
  }
  std::vector<std::string> sectors(int runs, double shift, double angle = 90) {
    std::vector<std::string> folders;
    for (int run = 0; run < runs; ++run) {
      Files files;
      files.add("whole", random_part(random_, shift), 1);
      folders.push_back(scratch_ / ("sector" + std::to_string(made_++)));
      files.write(folders.back(), angle);
    }
    return folders;
  }
  std::string file(const std::string& name, const std::string& text) {
    write_text_file_atomically(scratch_ / name, text);
    return scratch_ / name;
  }
  std::string path(const std::string& name) const { return scratch_ / name; }

private:
  ScratchFolder scratch_;
  RandomStream random_{5, 1};
  int made_ = 0;
};

}  // namespace wedge::test

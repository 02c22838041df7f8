// test_slice_svg.cpp: the picture of a slice through a bed.
#include "apps/run/slice_svg.hpp"
#include "io/files/atomic_file.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/experiment.hpp"
#include "tests/support/scratch_folder.hpp"

using namespace wedge;
using namespace wedge::test;

namespace {

constexpr double R = 0.0025, d = 2 * R;

/// nx x ny x nz grains at distance `spacing`, the first at the origin.
std::vector<Grain> lattice(int nx, int ny, int nz, double spacing) {
  std::vector<Grain> grains;
  for (int k = 0; k < nz; ++k)
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i) grains.push_back({R, {i * spacing, j * spacing, k * spacing}, {}, {}});
  return grains;
}

}  // namespace

TEST_CASE("The picture of a slice is small, scales and is closed") {
  const ScratchFolder folder;
  Scene scene = hopper_material();
  add_wall(scene, "shell", {{20 * d, 0}, {20 * d, 30 * d}});
  std::vector<Grain> grains = lattice(30, 5, 30, d);
  for (Grain& g : grains) g.x = g.x + Vec3{-15 * d, -2 * d, R}, g.x.y *= 0.9, g.v = {0, 0, g.x.z};
  scene.name = "pile";
  write_slice_svg(folder / "slice.svg", make_state(scene, grains), scene, "a <small> & simple \"bed\"");
  const std::string svg = read_text_file(folder / "slice.svg");
  CHECK(svg.size() < 66 * grains.size() + 12000);
  CHECK(svg.find("viewBox=") != std::string::npos);
  CHECK(svg.find("<title>pile, full vessel, a &lt;small&gt; &amp; simple \"bed\", t = 0 s</title>") !=
        std::string::npos);
  CHECK(svg.substr(svg.size() - 7) == "</svg>\n");
  std::size_t circles = 0;
  for (std::size_t at = svg.find("<circle"); at != std::string::npos; at = svg.find("<circle", at + 1)) ++circles;
  CHECK(circles == grains.size());
}

// test_frame.cpp: frames read back to the bit, hold what VTK needs, and fail in one clear line.
#include <cstring>

#include "core/require.hpp"
#include "io/files/atomic_file.hpp"
#include "io/files/frame.hpp"
#include "io/files/hdf5_file.hpp"
#include "io/files/vtp.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/sample_state.hpp"
#include "tests/support/scratch_folder.hpp"

using namespace wedge;
using Catch::Matchers::Contains;

namespace {

FrameInfo info_of(FramePrecision precision) { return {"[domain]\nkind = \"sector\" # \xC3\xA9\n", precision, 7}; }

template <class T>
bool same_bits(const Array<T>& a, const T* b, std::size_t n) {
  return a.size() >= n && std::memcmp(a.data(), b, n * sizeof(T)) == 0;
}
bool same_bits(const Vec3Array& a, const Vec3Array& b, std::size_t n) {
  return same_bits(a.x, b.x.data(), n) && same_bits(a.y, b.y.data(), n) && same_bits(a.z, b.z.data(), n);
}

}  // namespace

TEST_CASE("a particle frame in doubles reads back to the bit") {
  const ScratchFolder folder;
  const State state = sample_state();
  const std::string path = folder / "particles_000007.hdf";
  write_particle_frame(path, state, info_of(FramePrecision::double_precision));
  const ParticleFrame frame = read_particle_frame(path);
  CHECK(frame.header.time == state.time);
  CHECK(frame.header.step == state.step);
  CHECK(frame.header.info.number == 7);
  CHECK(frame.header.info.precision == FramePrecision::double_precision);
  CHECK(frame.header.info.scene_text == info_of(FramePrecision::double_precision).scene_text);
  const Particles &p = state.particles, &q = frame.particles;
  REQUIRE(q.count() == 5);
  CHECK(q.position.size() == 5);  // no images
  CHECK(same_bits(q.position, p.position, 5));
  CHECK(same_bits(q.velocity, p.velocity, 5));
  CHECK(same_bits(q.angular_velocity, p.angular_velocity, 5));
  CHECK(same_bits(q.force, p.force, 5));
  CHECK(same_bits(q.torque, p.torque, 5));
  CHECK(same_bits(q.radius, p.radius.data(), 5));
  CHECK(same_bits(q.mass, p.mass.data(), 5));
  CHECK(same_bits(q.material, p.material.data(), 5));
  CHECK(same_bits(q.id, p.id.data(), 5));
  CHECK(same_bits(q.layer, p.layer.data(), 5));
  CHECK(same_bits(q.turns, p.turns.data(), 5));
  CHECK(folder.files() == 1);
}

TEST_CASE("a particle frame in single precision is the nearest float of each number") {
  const ScratchFolder folder;
  const State state = sample_state();
  write_particle_frame(folder / "f.hdf", state, info_of(FramePrecision::single_precision));
  const ParticleFrame frame = read_particle_frame(folder / "f.hdf");
  for (std::size_t i = 0; i < 5; ++i) {
    CHECK(frame.particles.velocity.y[i] == static_cast<double>(static_cast<float>(state.particles.velocity.y[i])));
    CHECK(frame.particles.radius[i] == static_cast<double>(static_cast<float>(state.particles.radius[i])));
  }
  CHECK(frame.header.time == state.time);
}

TEST_CASE("a frame of more grains than a chunk holds reads back") {
  const ScratchFolder folder;
  const State state = sample_state(200000);
  write_particle_frame(folder / "f.hdf", state, info_of(FramePrecision::double_precision));
  const ParticleFrame frame = read_particle_frame(folder / "f.hdf");
  CHECK(same_bits(frame.particles.position, state.particles.position, 200000));
  CHECK(same_bits(frame.particles.id, state.particles.id.data(), 200000));
}

TEST_CASE("every field of a frame says its name, unit and meaning") {
  const ScratchFolder folder;
  const State state = sample_state();
  write_particle_frame(folder / "p.hdf", state, info_of(FramePrecision::single_precision));
  const Hdf5Reader file(folder / "p.hdf");
  CHECK(file.text_attribute("particles/angular_velocity", "unit") == "rad/s");
  CHECK(file.text_attribute("particles/torque", "meaning") == "sum of contact torques");
  CHECK(file.text_attribute("particles/layer", "name") == "layer");
  CHECK(file.text_attribute("particles/layer", "unit").empty());
}

TEST_CASE("a contact frame holds the touching rows with their forces taken apart") {
  const ScratchFolder folder;
  const State state = sample_state();
  const Vec3Array forces = sample_forces(state);
  write_contact_frame(folder / "c.hdf", state, forces, info_of(FramePrecision::double_precision));
  const ContactFrame frame = read_contact_frame(folder / "c.hdf");
  REQUIRE(frame.size() == 2);  // the middle row is apart
  const std::size_t rows[2] = {0, 2};
  for (std::size_t c = 0; c < 2; ++c) {
    const std::size_t k = rows[c];
    const Vec3 force = forces.get(k), normal = row_normal(state, k);
    const auto first = static_cast<std::size_t>(state.contacts.first[k]);
    CHECK(frame.first_id[c] == state.particles.id[first]);
    CHECK(frame.second_id[c] == state.particles.id[static_cast<std::size_t>(row_partner(state, k).grain)]);
    CHECK(frame.turn[c] == row_partner(state, k).turn);
    CHECK(norm(frame.normal_force.get(c) + frame.tangential_force.get(c) - force) < 1e-15);
    CHECK(std::abs(dot(frame.tangential_force.get(c), normal)) < 1e-15);
    CHECK(norm(cross(frame.normal_force.get(c), normal)) < 1e-15);
    CHECK(frame.normal_load[c] == Approx(-dot(force, normal)));
    CHECK(frame.tangential_load[c] == Approx(norm(cross(force, normal))));
    CHECK(frame.overlap[c] == row_overlap(state, k));
    CHECK(frame.first_position.x[c] == state.particles.position.x[first]);
  }
  // Across the face the line ends at the image, slot 6 of 5 grains and 2 images.
  CHECK(frame.second_position.z[1] == state.particles.position.z[6]);
}

TEST_CASE("the VTKHDF group describes vertices and lines") {
  const ScratchFolder folder;
  const State state = sample_state();
  write_particle_frame(folder / "p.hdf", state, info_of(FramePrecision::single_precision));
  write_contact_frame(folder / "c.hdf", state, sample_forces(state), info_of(FramePrecision::single_precision));
  const Hdf5Reader grains(folder / "p.hdf"), contacts(folder / "c.hdf");
  CHECK(grains.text_attribute("VTKHDF", "Type") == "UnstructuredGrid");
  Array<std::int64_t> numbers;
  grains.read("VTKHDF/Offsets", numbers);
  CHECK(numbers == Array<std::int64_t>{0, 1, 2, 3, 4, 5});
  contacts.read("VTKHDF/Offsets", numbers);
  CHECK(numbers == Array<std::int64_t>{0, 2, 4});
  contacts.read("VTKHDF/Connectivity", numbers);
  CHECK(numbers == Array<std::int64_t>{0, 1, 2, 3});
  contacts.read("VTKHDF/NumberOfPoints", numbers);
  CHECK(numbers == Array<std::int64_t>{4});
  Array<std::uint8_t> types;
  contacts.read("VTKHDF/Types", types);
  CHECK(types == Array<std::uint8_t>{3, 3});
  CHECK(grains.shape("VTKHDF/Points").columns == 3);
  CHECK(grains.shape("VTKHDF/PointData/velocity").rows == 5);
  CHECK(contacts.shape("VTKHDF/CellData/normal_force").rows == 2);
}

TEST_CASE("frames without grains and without contacts read back") {
  const ScratchFolder folder;
  State state;
  write_particle_frame(folder / "p.hdf", state, {});
  write_contact_frame(folder / "c.hdf", state, sample_forces(state), {});
  CHECK(read_particle_frame(folder / "p.hdf").particles.count() == 0);
  CHECK(read_contact_frame(folder / "c.hdf").size() == 0);
}

TEST_CASE("what is no frame is refused by path and cause") {
  const ScratchFolder folder;
  const State state = sample_state();
  const std::string path = folder / "c.hdf";
  CHECK_THROWS_WITH(read_particle_frame(folder / "none.hdf"), Contains("none.hdf") && Contains("No such file"));
  write_contact_frame(path, state, sample_forces(state), {});
  CHECK_THROWS_WITH(read_particle_frame(path), Contains("c.hdf: is not a wedge particle frame"));
  write_text_file_atomically(folder / "text.hdf", "not HDF5");
  CHECK_THROWS_AS(read_particle_frame(folder / "text.hdf"), FileError);
  const std::string bytes = read_text_file(path);
  for (const std::size_t size : {std::size_t{0}, std::size_t{100}, bytes.size() / 2, bytes.size() - 1}) {
    write_text_file_atomically(folder / "cut.hdf", std::string_view(bytes).substr(0, size));
    CHECK_THROWS_AS(read_contact_frame(folder / "cut.hdf"), FileError);
  }
  CHECK_THROWS_WITH(write_particle_frame(folder / "no/such/folder.hdf", state, {}),
                    Contains("folder.hdf: cannot write: No such file or directory"));
  CHECK_THROWS_AS(write_particle_frame("/proc/frame.hdf", state, {}), FileError);
  CHECK_THROWS_AS(write_particle_frame("/dev/full/frame.hdf", state, {}), FileError);
}

TEST_CASE("a folder without write permission is refused by cause") {
  const ScratchFolder folder;
  std::filesystem::create_directory(folder / "locked");
  const SmallDisk disk(folder / "locked", "size=64k,mode=0500");
  std::filesystem::permissions(folder / "locked",
                               std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec);
  if (geteuid() == 0) {  // permissions do not stop root; a disk mounted read-only does
    if (!disk.mounted() ||
        mount(nullptr, (folder / "locked").c_str(), nullptr, MS_REMOUNT | MS_RDONLY, nullptr) != 0) {
      WARN("skipped: root may write everywhere, and no read-only disk can be mounted here");
      return;
    }
  }
  CHECK_THROWS_WITH(write_particle_frame(folder / "locked/p.hdf", sample_state(), {}),
                    Contains("Permission denied") || Contains("Read-only file system"));
}

TEST_CASE("a frame that does not fit leaves the old one and no litter") {
  const ScratchFolder folder;
  const std::string path = folder / "p.hdf";
  write_particle_frame(path, sample_state(), {});
  const std::string before = read_text_file(path);
  {
    const FileSizeLimit limit(4096);
    CHECK_THROWS_WITH(write_particle_frame(path, sample_state(50000), {}),
                      Contains("p.hdf: cannot write: File too large"));
  }
  CHECK(read_text_file(path) == before);
  CHECK(folder.files() == 1);
  write_particle_frame(path, sample_state(50000), {});  // and the library goes on
  CHECK(read_particle_frame(path).particles.count() == 50000);
}

TEST_CASE("a full disk is an error of its own name, frame after frame") {
  const ScratchFolder folder;
  const SmallDisk disk(folder.path(), "size=64k");
  if (!disk.mounted()) {
    WARN("skipped: no small disk can be mounted here (needs root)");
    return;
  }
  write_particle_frame(folder / "small.hdf", sample_state(), {});
  for (int attempt = 0; attempt < 3; ++attempt) {
    CHECK_THROWS_WITH(write_particle_frame(folder / "big.hdf", sample_state(50000), {}),
                      Contains("big.hdf: cannot write: No space left on device"));
  }
  CHECK(read_particle_frame(folder / "small.hdf").particles.count() == 5);
  CHECK(folder.files() == 1);
}

TEST_CASE("exports to VTK name their arrays and count their cells") {
  const ScratchFolder folder;
  const State state = sample_state();
  write_particles_vtp(folder / "p.vtp", state.particles);
  CHECK_THAT(read_text_file(folder / "p.vtp"),
             Contains("NumberOfPoints=\"5\" NumberOfVerts=\"5\"") && Contains("Name=\"angular_velocity\""));
  const Scene scene = sample_scene();
  write_vessel_vtp(folder / "w.vtp", Vessel(scene), scene.domain);  // two cone pieces, a quarter of 96 strips each
  CHECK_THAT(read_text_file(folder / "w.vtp"), Contains("NumberOfPolys=\"48\""));
  write_vessel_vtp(folder / "lid.vtp", state.vessel, scene.domain);  // the lid alone: triangles from the axis
  CHECK_THAT(read_text_file(folder / "lid.vtp"), Contains("NumberOfPolys=\"24\""));
}

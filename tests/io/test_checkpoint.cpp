// test_checkpoint.cpp: a checkpoint gives back the state to the bit, or is refused.
#include <cstring>
#include <ctime>
#include <fstream>

#include "core/require.hpp"
#include "io/files/atomic_file.hpp"
#include "io/files/checkpoint.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/sample_state.hpp"
#include "tests/support/scratch_folder.hpp"

using namespace wedge;
using Catch::Matchers::Contains;

namespace {

const CheckpointExtra extra{"a = 1 # \xC3\xA9\n", "", {{"stage", "2"}, {"empty", ""}, {"text", "x = y\nz"}}};

/// Symmetry and vessel as the scene makes them; all else empty.
State bare_state() {
  State s;
  s.symmetry = Symmetry::rotation(4);
  s.vessel = Vessel(sample_scene());
  return s;
}

template <class T>
void append_bytes(std::string& bytes, const Array<T>& array, std::size_t n) {
  bytes += std::to_string(array.size()) + ":";
  bytes.append(reinterpret_cast<const char*>(array.data()), n * sizeof(T));
}
template <class T>
void append_bytes(std::string& bytes, const Array<T>& array) {
  append_bytes(bytes, array, array.size());
}

/// Every byte of a state that must survive.
std::string bytes_of(const State& s) {
  std::string bytes;
  const auto n = static_cast<std::size_t>(s.particles.count());
  Particles::for_each_field(s.particles,
                            [&](const FieldInfo&, const auto& field) { append_bytes(bytes, field, field.size()); });
  append_bytes(bytes, s.images.owner);
  append_bytes(bytes, s.images.turn);
  append_bytes(bytes, s.contacts.row_begin);
  Array<Seen> seen;
  for (std::size_t i = 0; i < s.particles.seen.size(); ++i) seen.push_back(s.particles.seen.get(i));
  append_bytes(bytes, seen);
  ContactTable::for_each_field(s.contacts,
                               [&](const FieldInfo&, const auto& field) { append_bytes(bytes, field); });
  append_bytes(bytes, s.wall_contacts.grain);
  append_bytes(bytes, s.wall_contacts.begin);
  WallContactTable::for_each_field(s.wall_contacts,
                                   [&](const FieldInfo&, const auto& field) { append_bytes(bytes, field); });
  const auto number = [&](auto value) { bytes.append(reinterpret_cast<const char*>(&value), sizeof value); };
  EnergyLedger::for_each_field(s.energy, [&](const char*, double value) { number(value); });
  number(s.time);
  number(s.history_ahead);
  number(s.wall_margin);
  number(s.mean_diameter);
  number(s.alike);
  number(s.wall_travel);
  number(s.list_expired);
  for (const std::int64_t whole : {s.step, s.list_builds, s.put_in, s.taken_out, s.next_id}) number(whole);
  for (int w = 0; w < s.vessel.wall_count(); ++w) {
    number(s.vessel.present(w));
    number(s.vessel.travel(w));
  }
  number(n);
  return bytes;
}

/// Puts bytes in a file as they come, as damage does.
void damage(const std::string& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

}  // namespace

TEST_CASE("a checkpoint reads back to the bit, and writing it changes nothing") {
  const ScratchFolder folder;
  const State state = sample_state();
  const std::string before = bytes_of(state);
  const std::string path = checkpoint_path(folder.path(), state.step);
  CHECK_THAT(path, Contains("/checkpoint_012345678901.hdf"));
  write_checkpoint(path, state, extra);
  CHECK(bytes_of(state) == before);
  State read = bare_state();
  const CheckpointExtra read_extra = read_checkpoint(path, read);
  CHECK(bytes_of(read) == before);
  CHECK(read_extra.scene_text == extra.scene_text);
  CHECK(read_extra.resolved_scene.empty());
  CHECK(read_extra.run_state == extra.run_state);
  CHECK(read_checkpoint_extra(path).run_state == extra.run_state);
  CHECK(read.particles.seen.size() == 7);  // grains and images
  CHECK(folder.files() == 1);
}

TEST_CASE("special numbers survive a checkpoint: signed zero, subnormals, infinity") {
  const ScratchFolder folder;
  State state = sample_state();
  state.particles.velocity.x = {-0.0, 5e-324, -1e308 * 10, 0.1, std::nan("7")};
  state.energy.rolling = -0.0;
  write_checkpoint(folder / "c.hdf", state, extra);
  State read = bare_state();
  read_checkpoint(folder / "c.hdf", read);
  CHECK(bytes_of(read) == bytes_of(state));
}

TEST_CASE("a state before its first neighbour list, and one without grains, read back") {
  const ScratchFolder folder;
  State state = sample_state();
  state.contacts = ContactTable();
  state.wall_contacts = WallContactTable();
  write_checkpoint(folder / "c.hdf", state, {});
  State read = bare_state();
  read_checkpoint(folder / "c.hdf", read);
  CHECK(bytes_of(read) == bytes_of(state));
  const State empty = bare_state();
  write_checkpoint(folder / "c.hdf", empty, {});
  read_checkpoint(folder / "c.hdf", read);
  CHECK(bytes_of(read) == bytes_of(empty));
}

TEST_CASE("two writes of one state, at different times of day, are the same file") {
  const ScratchFolder folder;
  write_checkpoint(folder / "a.hdf", sample_state(), extra);
  for (const std::time_t second = std::time(nullptr); std::time(nullptr) == second;) usleep(10000);
  write_checkpoint(folder / "b.hdf", sample_state(), extra);
  const bool same = read_text_file(folder / "a.hdf") == read_text_file(folder / "b.hdf");
  CHECK(same);
}

TEST_CASE("a checkpoint with one bit changed anywhere is refused") {
  const ScratchFolder folder;
  const std::string path = folder / "c.hdf";
  write_checkpoint(path, sample_state(), extra);
  const std::string good = read_text_file(path);
  REQUIRE(good.size() > 4000);
  int refused = 0, tried = 0;
  for (std::size_t place = 0; place < good.size(); place += place < 600 ? 1 : 23) {
    std::string bad = good;
    bad[place] = static_cast<char>(bad[place] ^ (1 << (place % 8)));
    damage(path, bad);
    State read = bare_state();
    ++tried;
    try {
      read_checkpoint(path, read);
    } catch (const FileError&) {
      ++refused;
    }
  }
  CHECK(refused == tried);
  damage(path, good);
  CHECK(checkpoint_is_valid(path));
}

TEST_CASE("a checkpoint cut short or made longer is refused") {
  const ScratchFolder folder;
  const std::string path = folder / "c.hdf";
  write_checkpoint(path, sample_state(), extra);
  const std::string good = read_text_file(path);
  State read = bare_state();
  for (std::size_t size = 0; size < good.size(); size += 1 + good.size() / 50) {
    damage(path, good.substr(0, size));
    CHECK_THROWS_WITH(read_checkpoint(path, read), Contains("c.hdf: the checkpoint is cut short"));
  }
  damage(path, good + "x");
  CHECK_THROWS_AS(read_checkpoint(path, read), FileError);
  damage(path, std::string(2000, 'x'));
  CHECK_THROWS_WITH(read_checkpoint(path, read), Contains("is not a wedge checkpoint"));
  CHECK_THROWS_WITH(read_checkpoint(folder / "none.hdf", read), Contains("none.hdf") && Contains("No such file"));
}

TEST_CASE("a checkpoint of another vessel or symmetry is refused") {
  const ScratchFolder folder;
  write_checkpoint(folder / "c.hdf", sample_state(), extra);
  State other = bare_state();
  other.symmetry = Symmetry::rotation(8);
  CHECK_THROWS_WITH(read_checkpoint(folder / "c.hdf", other), Contains("order 4") && Contains("order 8"));
  other = bare_state();
  Scene scene = sample_scene();
  scene.walls.pop_back();
  other.vessel = Vessel(scene);
  CHECK_THROWS_WITH(read_checkpoint(folder / "c.hdf", other), Contains("2 walls, the scene 1"));
}

TEST_CASE("the newest whole checkpoint is found, and old ones go") {
  const ScratchFolder folder;
  CHECK_FALSE(newest_valid_checkpoint(folder.path()).has_value());
  for (const std::int64_t step : std::vector<std::int64_t>{5, 900, 1000000000000, 30}) {
    write_checkpoint(checkpoint_path(folder.path(), step), sample_state(), extra);
  }
  write_text_file_atomically(folder / "checkpoint_note.hdf", "not one of ours");
  write_text_file_atomically(folder / "checkpoint_000000000044.hdf.part", "what a killed program left");
  CHECK(newest_valid_checkpoint(folder.path()) == checkpoint_path(folder.path(), 1000000000000));
  std::filesystem::resize_file(checkpoint_path(folder.path(), 1000000000000), 3000);
  CHECK(newest_valid_checkpoint(folder.path()) == checkpoint_path(folder.path(), 900));
  keep_last(folder.path(), 2);
  CHECK(folder.files() == 3);
  CHECK(std::filesystem::exists(checkpoint_path(folder.path(), 900)));
  CHECK(std::filesystem::exists(folder / "checkpoint_note.hdf"));
  keep_last(folder.path(), 2);
  CHECK(folder.files() == 3);
  CHECK_THROWS_WITH(newest_valid_checkpoint(folder / "none"), Contains("none: cannot read the folder"));
}

TEST_CASE("a checkpoint that does not fit leaves the old one and no litter") {
  const ScratchFolder folder;
  const std::string path = folder / "c.hdf";
  write_checkpoint(path, sample_state(500), extra);
  const auto size = std::filesystem::file_size(path);
  const std::string before = read_text_file(path);
  const std::uintmax_t limits = 50;  // wherever in the file the disk gets full: raw data, metadata, head
  for (std::uintmax_t part = 0; part < limits; ++part) {
    const FileSizeLimit limit(size * part / limits);
    CHECK_THROWS_WITH(write_checkpoint(path, sample_state(500), extra),
                      Contains("c.hdf: cannot write: File too large"));
    CHECK(folder.files() == 1);
  }
  CHECK(read_text_file(path) == before);
  const FileSizeLimit enough(size);
  write_checkpoint(path, sample_state(500), extra);
  CHECK(read_text_file(path) == before);
}

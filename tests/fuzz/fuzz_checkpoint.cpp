// fuzz_checkpoint.cpp: any bytes behind a head that fits, and good states with any of their numbers changed.
#include <cstdio>
#include <cstring>
#include <fstream>
#include <stdexcept>

#include <xxhash.h>

#include "core/require.hpp"
#include "io/files/atomic_file.hpp"
#include "io/files/checkpoint.hpp"
#include "tests/fuzz/fuzz_readers.hpp"
#include "tests/support/sample_state.hpp"
#include "tests/support/scratch_folder.hpp"

namespace wedge::fuzz {
namespace {

/// A checkpoint file whose head fits whatever follows it.
void write_with_head(const std::string& path, const std::string& content) {
  std::string head(512, '\0');
  const auto hash = XXH3_64bits(content.data(), content.size());
  std::snprintf(head.data(), head.size(), "wedge checkpoint %d\nbytes %020llu\nxxh3_64 %016llx\n",
                checkpoint_version, static_cast<unsigned long long>(content.size()),
                static_cast<unsigned long long>(hash));
  std::ofstream(path, std::ios::binary | std::ios::trunc) << head << content;
}

/// What stands behind the head of a good checkpoint.
std::string good_content(const std::string& path) {
  write_checkpoint(path, sample_state(), {"scene", "resolved", {{"stage", "0"}}});
  return read_text_file(path).substr(512);
}

/// Changes to single bytes of a good file: place (two bytes), new value.
std::string patched(std::string content, const std::string& bytes) {
  for (std::size_t at = 1; at + 3 <= bytes.size(); at += 3) {
    const auto byte = [&](std::size_t k) {
      return static_cast<std::size_t>(static_cast<unsigned char>(bytes[at + k]));
    };
    content[(256 * byte(0) + byte(1)) % content.size()] = bytes[at + 2];
  }
  return content;
}

/// Follows every index of a state, as the passes of a step do; a sanitizer sees a step outside.
double follow_indices(const State& s) {
  const Particles& p = s.particles;
  double sum = 0;
  for (std::size_t m = 0; m < s.images.owner.size(); ++m) {
    const auto owner = static_cast<std::size_t>(s.images.owner[m]);
    sum += s.symmetry.turn_point(p.position.get(owner), s.images.turn[m]).x + p.radius.at(owner);
  }
  for (std::size_t i = 0; i + 1 < s.contacts.row_begin.size(); ++i)
    for (Index k = s.contacts.row_begin[i]; k < s.contacts.row_begin[i + 1]; ++k) {
      const auto row = static_cast<std::size_t>(k);
      sum += p.mass.at(i) + p.radius.at(static_cast<std::size_t>(s.contacts.second.at(row)));
      sum += row_overlap(s, row) + s.contacts.history.x.at(row) + s.symmetry.residue(row_partner(s, row).turn);
    }
  const WallContactTable& w = s.wall_contacts;
  for (std::size_t g = 0; g < w.grain.size(); ++g)
    for (Index k = w.begin.at(g); k < w.begin.at(g + 1); ++k)
      sum += p.mass.at(static_cast<std::size_t>(w.grain[g])) +
             s.vessel.carrier(w.feature.at(static_cast<std::size_t>(k)));
  return sum;
}

/// Changes to a state: (which array, what to do, where, value) in six bytes each.
class Changes {
public:
  explicit Changes(const std::string& bytes) : bytes_(bytes) {}

  void apply(State& s) {
    while (at_ + 6 <= bytes_.size()) {
      target_ = byte() % 40;
      action_ = byte();
      place_ = byte();
      std::memcpy(&value_, bytes_.data() + at_, sizeof value_);
      at_ += sizeof value_;
      visited_ = 0;
      visit_all(s);
    }
  }

private:
  unsigned byte() { return static_cast<unsigned char>(bytes_[at_++]); }

  template <class T>
  void change(Array<T>& array, std::size_t least) {
    if (visited_++ != target_) return;
    if (action_ % 4 == 0 && least == 0) array.resize(place_ % 20);
    if (array.empty()) return;
    auto& number = array[place_ % array.size()];
    number = action_ % 4 == 1 ? static_cast<T>(65536.0 * value_) : static_cast<T>(value_ % 12);
  }

  void visit_all(State& s) {
    change(s.images.owner, 1);  // lengths of images stay: the writer needs them
    change(s.images.turn, 0);
    change(s.contacts.row_begin, 0);
    change(s.wall_contacts.grain, 0);
    change(s.wall_contacts.begin, 0);
    ContactTable::for_each_field(s.contacts, [&](const FieldInfo&, auto& field) { change(field, 0); });
    ContactTable::for_each_couple_field(s.contacts, [&](const FieldInfo&, auto& field) { change(field, 0); });
    change(s.wall_contacts.feature, 0);
    change(s.wall_contacts.touching, 0);
    change(s.wall_contacts.overlap, 0);
    change(s.particles.turns, 1);
    change(s.particles.radius, 1);
    change(s.particles.mass, 1);
  }

  const std::string& bytes_;
  std::size_t at_ = 0;
  unsigned target_ = 0, action_ = 0, place_ = 0, visited_ = 0;
  std::int16_t value_ = 0;
};

void read_and_follow(const std::string& folder, const std::string& path) {
  static volatile double sum = 0;
  State state;
  state.symmetry = Symmetry::rotation(4);
  state.vessel = Vessel(sample_scene());
  try {
    read_checkpoint(path, state);
    sum = sum + follow_indices(state);
    (void)checkpoint_of_step(folder, 1);
  } catch (const FileError&) {
  }
}

}  // namespace

void checkpoint(const std::string& bytes) {
  static const ScratchFolder scratch;
  const std::string path = scratch / "checkpoint_000000000001.hdf";
  State changed = sample_state();
  Changes(bytes).apply(changed);
  write_checkpoint(path, changed, {"scene", "resolved", {{"stage", "0"}}});
  read_and_follow(scratch.path(), path);
}

void checkpoint_bytes(const std::string& bytes) {
  static const ScratchFolder scratch;
  const std::string path = scratch / "checkpoint_000000000001.hdf";
  if (bytes.empty()) return;
  static const std::string good = good_content(path);
  write_with_head(path, bytes[0] == 'h' ? bytes.substr(1) : patched(good, bytes));
  read_and_follow(scratch.path(), path);
}

}  // namespace wedge::fuzz

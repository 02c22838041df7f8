// checkpoint.cpp: the state as datasets, behind a head with the checksum of every byte.
#include "io/files/checkpoint.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <limits>
#include <memory>
#include <new>
#include <string_view>

#include <xxhash.h>

#include "io/files/atomic_file.hpp"
#include "io/files/checkpoint_checks.hpp"
#include "io/files/hdf5_file.hpp"

namespace wedge {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t head_size = 512;  // bytes, the smallest user block of HDF5
using Head = std::array<char, head_size>;

// ---- the head

/// Head of a file with `bytes` bytes after the head that have the checksum `hash`.
Head make_head(std::uint64_t bytes, std::uint64_t hash) {
  Head head{};
  std::snprintf(head.data(), head.size(), "wedge checkpoint %d\nbytes %020llu\nxxh3_64 %016llx\n",
                checkpoint_version, static_cast<unsigned long long>(bytes), static_cast<unsigned long long>(hash));
  return head;
}

using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

/// The head of a file and what follows it. A file shorter than a head leaves head_read below head_size.
struct Content {
  Head head{};
  std::size_t head_read = 0;
  std::uint64_t bytes = 0, hash = 0;  // XXH3, 64 bits
};
/// Reads the file through; messages name `path`. Throws FileError.
Content read_content(const std::string& file_path, const std::string& path) {
  const File file(std::fopen(file_path.c_str(), "rbe"), &std::fclose);
  if (!file) throw_file_error(path, "cannot open the checkpoint", errno);
  Content c;
  c.head_read = std::fread(c.head.data(), 1, c.head.size(), file.get());
  const std::unique_ptr<XXH3_state_t, XXH_errorcode (*)(XXH3_state_t*)> hash(XXH3_createState(), &XXH3_freeState);
  if (!hash || XXH3_64bits_reset(hash.get()) != XXH_OK) throw std::bad_alloc();
  std::vector<unsigned char> buffer(std::size_t{1} << 20);
  while (const std::size_t got = std::fread(buffer.data(), 1, buffer.size(), file.get())) {
    XXH3_64bits_update(hash.get(), buffer.data(), got);
    c.bytes += got;
  }
  if (std::ferror(file.get()) != 0) throw_file_error(path, "cannot read the checkpoint", errno);
  c.hash = XXH3_64bits_digest(hash.get());
  return c;
}

/// Writes the head of a file that is otherwise complete.
void seal(const PartFile& part) {
  const Content content = read_content(part.part_path(), part.path());
  const Head head = make_head(content.bytes, content.hash);
  File file(std::fopen(part.part_path().c_str(), "r+be"), &std::fclose);
  if (!file || std::fwrite(head.data(), 1, head.size(), file.get()) != head.size() ||
      std::fclose(file.release()) != 0)
    throw_file_error(part.path(), "cannot write", errno);
}

/// Throws FileError unless the file is a checkpoint of this version, whole and unchanged.
void verify(const std::string& path) {
  const Content found = read_content(path, path);
  const Head wanted = make_head(found.bytes, found.hash);
  if (found.head_read == head_size && found.head == wanted) return;
  const auto line_end = static_cast<std::size_t>(std::strchr(wanted.data(), '\n') - wanted.data()) + 1;
  if (found.head_read < head_size) throw_file_error(path, "the checkpoint is cut short: it ends within its head");
  if (std::memcmp(found.head.data(), wanted.data(), line_end) != 0) {
    throw_file_error(path, "is not a wedge checkpoint of version " + std::to_string(checkpoint_version));
  }
  if (std::memcmp(found.head.data(), wanted.data(), line_end + std::strlen("bytes ") + 20) != 0) {
    throw_file_error(path, "the checkpoint is cut short or damaged: it holds " + std::to_string(found.bytes) +
                               " bytes, not as many as its head says");
  }
  throw_file_error(path, "the checkpoint is damaged: its content does not have the checksum written in its head");
}

// ---- what is in it

/// Arrays that are stored as they are: visit(name, array). One list for writing and reading.
template <class Self, class Visit>
void for_each_array(Self& s, Visit&& visit) {
  visit("images/owner", s.images.owner);
  visit("images/turn", s.images.turn);
  visit("contacts/row_begin", s.contacts.row_begin);
  ContactTable::for_each_field(
      s.contacts, [&](const FieldInfo& info, auto& field) { visit(std::string("contacts/") + info.name, field); });
  ContactTable::for_each_couple_field(
      s.contacts, [&](const FieldInfo& info, auto& field) { visit(std::string("contacts/") + info.name, field); });
  visit("wall_contacts/grain", s.wall_contacts.grain);
  visit("wall_contacts/begin", s.wall_contacts.begin);
  WallContactTable::for_each_field(s.wall_contacts, [&](const FieldInfo& info, auto& field) {
    visit(std::string("wall_contacts/") + info.name, field);
  });
}

/// Fields of the grains that have further slots for images: visit(name, array).
template <class Self, class Visit>
void for_each_image_field(Self& p, Visit&& visit) {
  visit("image_slots/x", p.position.x);
  visit("image_slots/y", p.position.y);
  visit("image_slots/z", p.position.z);
  visit("image_slots/radius", p.radius);
  visit("image_slots/mass", p.mass);
  visit("image_slots/material", p.material);
}

/// Single numbers of the state: visit(name, number).
template <class Self, class Visit>
void for_each_number(Self& s, Visit&& visit) {
  visit("time", s.time);
  visit("step", s.step);
  visit("wall_margin", s.wall_margin);
  visit("wall_travel", s.wall_travel);
  visit("list_builds", s.list_builds);
  visit("list_expired", s.list_expired);
  visit("mean_diameter", s.mean_diameter);
  visit("alike", s.alike);
  visit("history_ahead", s.history_ahead);
  visit("put_in", s.put_in);
  visit("taken_out", s.taken_out);
  visit("next_id", s.next_id);
}

std::string symmetry_text(const Symmetry& symmetry) {
  switch (symmetry.kind()) {
    case Symmetry::Kind::none:
      return "none";
    case Symmetry::Kind::rotation:
      return "rotation, order " + std::to_string(symmetry.order());
    case Symmetry::Kind::translation:
      break;
  }
  char width[64];
  std::snprintf(width, sizeof width, "translation, width %a m", symmetry.width());
  return width;
}

std::string wall_names(const Vessel& vessel) {
  std::string names;
  for (int w = 0; w < vessel.wall_count(); ++w) names += vessel.wall(w).name + '\n';
  return names;
}

void write_vessel(Hdf5Writer& file, const Vessel& vessel) {
  std::vector<std::int32_t> present;
  std::vector<double> travel;
  for (int w = 0; w < vessel.wall_count(); ++w) {
    present.push_back(vessel.present(w) ? 1 : 0);
    travel.push_back(vessel.travel(w));
  }
  file.group("vessel");
  file.text("vessel/names", wall_names(vessel));
  file.write("vessel/present", present.data(), Shape{present.size()});
  file.write("vessel/travel", travel.data(), Shape{travel.size()});
}

void read_vessel(const Hdf5Reader& file, Vessel& vessel) {
  Array<std::int32_t> present;
  Array<double> travel;
  file.read("vessel/present", present);
  file.read("vessel/travel", travel);
  if (present.size() != static_cast<std::size_t>(vessel.wall_count()) || travel.size() != present.size()) {
    throw_file_error(file.path(), "the checkpoint has " + std::to_string(present.size()) + " walls, the scene " +
                                      std::to_string(vessel.wall_count()));
  }
  if (file.text("vessel/names") != wall_names(vessel)) {
    throw_file_error(file.path(), "the checkpoint and the scene name their walls differently");
  }
  for (int w = 0; w < vessel.wall_count(); ++w) {
    vessel.set_present(w, present[static_cast<std::size_t>(w)] != 0);
    vessel.set_travel(w, travel[static_cast<std::size_t>(w)]);
  }
}

void write_extra(Hdf5Writer& file, const CheckpointExtra& extra) {
  file.group("extra");
  file.text("extra/scene", extra.scene_text);
  file.text("extra/resolved_scene", extra.resolved_scene);
  std::string pairs;  // key, '\0', value, '\0', ...
  for (const auto& [key, value] : extra.run_state) (pairs += key + '\0') += value + '\0';
  file.write("extra/run_state", reinterpret_cast<const std::uint8_t*>(pairs.data()), Shape{pairs.size()});
}

CheckpointExtra read_extra(const Hdf5Reader& file) {
  CheckpointExtra extra;
  extra.scene_text = file.text("extra/scene");
  extra.resolved_scene = file.text("extra/resolved_scene");
  Array<std::uint8_t> pairs;
  file.read("extra/run_state", pairs);
  std::vector<std::string> texts(1);
  for (const std::uint8_t byte : pairs) {
    if (byte == 0) {
      texts.emplace_back();
    } else {
      texts.back() += static_cast<char>(byte);
    }
  }
  for (std::size_t k = 0; k + 2 < texts.size(); k += 2) extra.run_state.emplace_back(texts[k], texts[k + 1]);
  return extra;
}

void write_particles(Hdf5Writer& file, const Particles& p, std::size_t images) {
  const auto n = static_cast<std::size_t>(p.count());
  file.group("particles");
  Particles::for_each_field(p, [&](const FieldInfo& info, const auto& field) {
    require(field.size() >= n, "a particle field is shorter than the list of particles");
    file.write(std::string("particles/") + info.name, field.data(), Shape{n});
  });
  file.group("image_slots");
  for_each_image_field(p, [&](const std::string& name, const auto& field) {
    require(field.size() >= n + images, "a particle field has no room for the images");
    file.write(name, field.data() + n, Shape{images});
  });
  require(p.seen.size() >= n + images, "what contacts see lacks grains or images");
  Array<Seen> seen(n + images);  // doubles in every precision: no wider than they need be, but of one kind
  for (std::size_t i = 0; i < seen.size(); ++i) seen[i] = p.seen.get(i);
  file.write("seen", reinterpret_cast<const double*>(seen.data()), Shape{seen_size * seen.size()});
}

void read_particles(const Hdf5Reader& file, Particles& p, std::size_t images) {
  const std::size_t n = file.shape("particles/id").size();
  if (n + images > static_cast<std::size_t>(std::numeric_limits<Index>::max()))
    throw_file_error(file.path(), "the checkpoint is damaged: it has more grains than can be counted");
  p.resize(static_cast<Index>(n));
  Particles::for_each_field(p, [&](const FieldInfo& info, auto& field) {
    file.read(std::string("particles/") + info.name, field.data(), n);
  });
  for_each_image_field(p, [&](const std::string& name, auto& field) {
    field.resize(n + images);
    file.read(name, field.data() + n, images);
  });
  Array<Seen> seen(n + images);
  file.read("seen", reinterpret_cast<double*>(seen.data()), seen_size * seen.size());
  p.seen.resize(seen.size());
  for (std::size_t i = 0; i < seen.size(); ++i) p.seen.set(i, seen[i]);
}

}  // namespace

void write_checkpoint(const std::string& path, const State& state, const CheckpointExtra& extra) {
  PartFile part(path);
  Hdf5Writer file(part, head_size);
  file.attribute("/", "format", "wedge checkpoint");
  file.attribute("/", "format_version", checkpoint_version);
  file.attribute("/", "symmetry", symmetry_text(state.symmetry));
  for_each_number(state, [&](const char* name, auto number) { file.attribute("/", name, number); });
  file.group("energy");
  EnergyLedger::for_each_field(state.energy,
                               [&](const char* name, double value) { file.attribute("energy", name, value); });
  write_extra(file, extra);
  write_vessel(file, state.vessel);
  write_particles(file, state.particles, static_cast<std::size_t>(state.images.count()));
  for (const char* group : {"images", "contacts", "wall_contacts"}) file.group(group);
  for_each_array(state, [&](const std::string& name, const auto& array) {
    file.write(name, array.data(), Shape{array.size()});
  });
  file.close();
  seal(part);
  part.commit();
}

CheckpointExtra read_checkpoint(const std::string& path, State& state) {
  verify(path);
  const Hdf5Reader file(path);
  const std::string symmetry = file.text_attribute("/", "symmetry");
  if (symmetry != symmetry_text(state.symmetry)) {
    throw_file_error(path, "the checkpoint is of another domain (copies: " + symmetry +
                               ") than the scene (copies: " + symmetry_text(state.symmetry) +
                               "); give [domain] the angle or width it was made with");
  }
  read_vessel(file, state.vessel);
  for_each_number(state, [&](const char* name, auto& number) {
    if constexpr (std::is_same_v<std::decay_t<decltype(number)>, double>) {
      number = file.number_attribute("/", name);
    } else {
      number = file.integer_attribute("/", name);
    }
  });
  EnergyLedger::for_each_field(
      state.energy, [&](const char* name, double& value) { value = file.number_attribute("energy", name); });
  for_each_array(state, [&](const std::string& name, auto& array) { file.read(name, array); });
  read_particles(file, state.particles, static_cast<std::size_t>(state.images.count()));
  check_consistency(state, path);
  return read_extra(file);
}

CheckpointExtra read_checkpoint_extra(const std::string& path) {
  verify(path);
  return read_extra(Hdf5Reader(path));
}

bool checkpoint_is_valid(const std::string& path) {
  try {
    verify(path);
    return true;
  } catch (const FileError&) {
    return false;
  }
}

}  // namespace wedge

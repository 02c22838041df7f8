// export.cpp: wedge export: a frame of a run as a table or for a viewer, unfolded if wanted, and the walls.
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <limits>

#include "apps/commands/commands.hpp"
#include "apps/commands/unfold.hpp"
#include "apps/results/run_folder.hpp"
#include "apps/results/stages.hpp"
#include "apps/setup/setup.hpp"
#include "core/require.hpp"
#include "io/files/atomic_file.hpp"
#include "io/files/checkpoint.hpp"
#include "io/files/frame.hpp"
#include "io/files/vtp.hpp"
#include "io/scene/scene_file.hpp"
#include "io/tables/state_csv.hpp"

namespace wedge {
namespace {

/// Number of the last frame of grains in a folder. Throws FileError when there is none.
long last_frame(const RunFolder& folder) {
  const std::string begin = "particles_", end = ".hdf";
  long last = -1;
  std::error_code error;
  for (std::filesystem::directory_iterator entry(folder.frames(), error), none; !error && entry != none;
       entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    if (name.size() <= begin.size() + end.size() || name.compare(0, begin.size(), begin) != 0 ||
        name.compare(name.size() - end.size(), end.size(), end) != 0)
      continue;
    long number = 0;
    const char* const stop = name.data() + name.size() - end.size();
    const auto [rest, problem] = std::from_chars(name.data() + begin.size(), stop, number);
    if (problem == std::errc{} && rest == stop) last = std::max(last, number);
  }
  if (error) throw_file_error(folder.frames(), "cannot read the folder", error.value());
  if (last < 0) throw FileError(folder.frames() + ": holds no frames of grains");
  return last;
}

/// A file for a moment, removed when it goes.
class PassingFile {
public:
  PassingFile() : path_((std::filesystem::temp_directory_path() / "wedge_export_XXXXXX").string()) {
    const int descriptor = mkstemp(path_.data());
    if (descriptor < 0) throw_file_error(path_, "cannot make a file", errno);
    ::close(descriptor);
  }
  PassingFile(const PassingFile&) = delete;
  PassingFile& operator=(const PassingFile&) = delete;
  ~PassingFile() { ::unlink(path_.c_str()); }
  const std::string& path() const { return path_; }

private:
  std::string path_;
};

/// Frames of single precision: takes the grains from a checkpoint of the same step, which has doubles, if there is
/// one, and says what it did.
void take_doubles(ParticleFrame& frame, const std::string& source, const Scene& scene, const RunFolder& folder) {
  if (frame.header.info.precision == FramePrecision::double_precision) return;
  const auto checkpoint = std::filesystem::is_directory(folder.checkpoints())
                              ? checkpoint_of_step(folder.checkpoints(), frame.header.step)
                              : std::nullopt;
  if (!checkpoint) {
    std::cerr << "note: " << source
              << " is in single precision, and so are these numbers; no checkpoint is of the same "
              << "step. For frames in full precision, set precision = \"double\" in [output]\n";
    return;
  }
  State state = make_domain(scene);
  read_checkpoint(*checkpoint, state);
  frame.particles = std::move(state.particles);
  std::cerr << "note: numbers in full precision from " << *checkpoint << ", which is of the same step as " << source
            << '\n';
}

void write_csv(const std::string& output, const ParticleFrame& frame, const Scene& scene) {
  const std::vector<std::string> materials = grain_material_names(scene.materials);
  if (!output.empty()) return write_state_csv(output, frame.particles, materials);
  const PassingFile file;
  write_state_csv(file.path(), frame.particles, materials);
  std::cout << read_text_file(file.path());
}

}  // namespace

Particles unfolded(const Particles& grains, const Symmetry& symmetry) {
  const int copies = symmetry.order();
  if (copies == 1) return grains;
  const auto count = static_cast<std::size_t>(grains.count());
  const std::int64_t largest = std::numeric_limits<std::int32_t>::max();
  for (std::size_t i = 0; i < count; ++i)
    if (std::int64_t{grains.id[i]} * copies + copies > largest) throw FileError("too many grains to unfold");
  Particles all;
  all.resize(static_cast<Index>(count) * copies);
  Particles::for_each_field(all, [&](const FieldInfo& info, auto& field) {
    Particles::for_each_field(grains, [&](const FieldInfo& source_info, const auto& source) {
      if constexpr (std::is_same_v<std::decay_t<decltype(field)>, std::decay_t<decltype(source)>>) {
        if (std::string(info.name) != source_info.name) return;
        for (std::size_t k = 0; k < field.size(); ++k) field[k] = source[k % count];
      }
    });
  });
  for (Vec3Array* vectors :
       {&all.position, &all.velocity, &all.angular_velocity, &all.force, &all.torque, &all.reference})
    for (std::size_t k = 0; k < vectors->size(); ++k)
      vectors->set(k, symmetry.turn_vector(vectors->get(k), static_cast<int>(k / count)));
  for (std::size_t k = 0; k < all.id.size(); ++k)
    all.id[k] = all.id[k] * copies + static_cast<std::int32_t>(k / count);
  return all;
}

int command_export(const ExportArguments& arguments) {
  const RunFolder folder(arguments.folder);
  folder.require_run();
  const Scene scene = read_scene(folder.resolved_scene(), {});
  const long number = arguments.frame ? *arguments.frame : last_frame(folder);
  const std::string source = folder.frame("particles", number);
  ParticleFrame frame = read_particle_frame(source);
  const auto beside = [&](const char* kind) {
    const std::string name = folder.frame(kind, number);
    return name.substr(0, name.size() - 4) + ".vtp";
  };
  const bool grains = !arguments.format.empty();
  if (arguments.format == "csv") take_doubles(frame, source, scene, folder);
  if (arguments.unfold) frame.particles = unfolded(frame.particles, make_domain(scene).symmetry);
  if (arguments.format == "csv") write_csv(arguments.output, frame, scene);
  if (arguments.format == "vtp") {
    const std::string path =
        !arguments.output.empty() ? arguments.output : beside(arguments.unfold ? "unfolded" : "particles");
    write_particles_vtp(path, frame.particles);
    std::cerr << path << '\n';
  }
  if (arguments.vessel) {
    std::string path = arguments.output;  // with grains in that file, the walls get one beside it
    if (path.empty())
      path = beside("vessel");
    else if (grains)
      path = path.substr(0, path.rfind('.')) + "_vessel.vtp";
    Domain domain = scene.domain;
    if (arguments.unfold && domain.kind == DomainKind::sector) domain.kind = DomainKind::full, domain.order = 1;
    write_vessel_vtp(path, vessel_at(scene, read_stages(folder), frame.header.time), domain);
    std::cerr << path << '\n';
  }
  return exit_code::ok;
}

}  // namespace wedge

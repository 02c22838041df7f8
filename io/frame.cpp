// frame.cpp: the fields of a frame once in our own groups, and once more as VTKHDF, by hard links.
#include "io/frame.hpp"

#include <algorithm>

#include "io/atomic_file.hpp"
#include "io/hdf5_file.hpp"
#include "io/json.hpp"

namespace wedge {
namespace {

constexpr int format_version = 1;
constexpr std::uint8_t vtk_vertex = 1, vtk_line = 3;  // vtkCellType.h

/// The grain fields of a frame: visit(name, field). One list for writing and reading.
template <class Self, class Visit>
void for_each_frame_field(Self& p, Visit&& visit) {
  visit("position", p.position);
  visit("velocity", p.velocity);
  visit("angular_velocity", p.angular_velocity);
  visit("force", p.force);
  visit("torque", p.torque);
  visit("radius", p.radius);
  visit("mass", p.mass);
  visit("material", p.material);
  visit("id", p.id);
  visit("layer", p.layer);
  visit("turns", p.turns);
}

const void* address_of(const Vec3Array& field) { return &field.x; }
template <class T>
const void* address_of(const Array<T>& field) {
  return &field;
}

/// Unit and meaning of a grain field, as Particles states them for it (for a vector: for its x component).
template <class Field>
FieldInfo info_of(const Particles& p, const char* name, const Field& field) {
  FieldInfo found{name, "", ""};
  Particles::for_each_field(p, [&](const FieldInfo& info, const auto& candidate) {
    if (static_cast<const void*>(&candidate) == address_of(field)) found = {name, info.unit, info.meaning};
  });
  return found;
}

/// Components of n vectors, row by row.
std::vector<double> interleaved(const Vec3Array& field, std::size_t n) {
  std::vector<double> rows(3 * n);
  for (std::size_t i = 0; i < n; ++i) {
    rows[3 * i] = field.x[i];
    rows[3 * i + 1] = field.y[i];
    rows[3 * i + 2] = field.z[i];
  }
  return rows;
}

/// Writes the datasets of a frame; knows the precision asked for.
class FrameWriter {
public:
  FrameWriter(const std::string& path, const State& state, const FrameInfo& info, const char* format)
      : file_(path),
        real_(info.precision == FramePrecision::single_precision ? NumberKind::float32 : NumberKind::float64) {
    file_.attribute("/", "format", format);
    file_.attribute("/", "format_version", format_version);
    file_.attribute("/", "time", state.time);
    file_.attribute("/", "time_unit", "s");
    file_.attribute("/", "step", state.step);
    file_.attribute("/", "number", info.number);
    file_.attribute("/", "precision", info.precision == FramePrecision::single_precision ? "single" : "double");
    file_.text("scene", info.scene_text);
  }

  Hdf5Writer& file() { return file_; }

  void field(const std::string& group, const FieldInfo& info, const Vec3Array& vectors, std::size_t n) {
    field(group, info, interleaved(vectors, n));
  }
  void field(const std::string& group, const FieldInfo& info, const std::vector<double>& rows) {
    file_.write(group + "/" + info.name, rows.data(), Shape{rows.size() / 3, 3}, Packing::shuffle_gzip, real_);
    describe(group, info);
  }
  void field(const std::string& group, const FieldInfo& info, const Array<double>& numbers, std::size_t n) {
    file_.write(group + "/" + info.name, numbers.data(), Shape{n}, Packing::shuffle_gzip, real_);
    describe(group, info);
  }
  void field(const std::string& group, const FieldInfo& info, const Array<std::int32_t>& numbers, std::size_t n) {
    file_.write(group + "/" + info.name, numbers.data(), Shape{n}, Packing::shuffle_gzip);
    describe(group, info);
  }

  /// Group VTKHDF: `cells` cells of one type, each with `points_per_cell` points of its own, in order.
  void vtk_grid(const std::string& points, std::size_t cells, std::size_t points_per_cell, std::uint8_t cell_type) {
    const std::int64_t version[2] = {1, 0};
    file_.group("VTKHDF");
    file_.attribute("VTKHDF", "Version", version, 2);
    file_.attribute("VTKHDF", "Type", "UnstructuredGrid");
    file_.link(points, "VTKHDF/Points");
    const std::size_t point_count = cells * points_per_cell;
    one_number("VTKHDF/NumberOfPoints", point_count);
    one_number("VTKHDF/NumberOfCells", cells);
    one_number("VTKHDF/NumberOfConnectivityIds", point_count);
    counting("VTKHDF/Connectivity", point_count, 1);
    counting("VTKHDF/Offsets", cells + 1, static_cast<std::int64_t>(points_per_cell));
    const std::vector<std::uint8_t> types(cells, cell_type);
    file_.write("VTKHDF/Types", types.data(), Shape{cells}, Packing::shuffle_gzip);
    file_.group("VTKHDF/PointData");
    file_.group("VTKHDF/CellData");
  }

private:
  void describe(const std::string& group, const FieldInfo& info) {
    const std::string dataset = group + "/" + info.name;
    file_.attribute(dataset, "name", info.name);
    file_.attribute(dataset, "unit", info.unit);
    file_.attribute(dataset, "meaning", info.meaning);
  }
  void one_number(const std::string& name, std::size_t number) {
    const auto value = static_cast<std::int64_t>(number);
    file_.write(name, &value, Shape{1});
  }
  /// 0, step, 2 step, ...
  void counting(const std::string& name, std::size_t n, std::int64_t step) {
    std::vector<std::int64_t> numbers(n);
    for (std::size_t i = 0; i < n; ++i) numbers[i] = static_cast<std::int64_t>(i) * step;
    file_.write(name, numbers.data(), Shape{n}, Packing::shuffle_gzip);
  }

  Hdf5Writer file_;
  NumberKind real_;
};

/// The touching rows of the contact table, with forces taken apart.
ContactFrame touching_contacts(const State& state) {
  const ContactTable& rows = state.contacts;
  ContactFrame frame;
  std::vector<std::size_t> touching;
  for (std::size_t k = 0; k < static_cast<std::size_t>(rows.rows()); ++k) {
    if (rows.half_overlap(k) > 0) touching.push_back(k);
  }
  const std::size_t n = touching.size();
  ContactFrame::for_each_field(frame, [&](const FieldInfo&, auto& field) { field.resize(n); });
  frame.first_position.resize(n);
  frame.second_position.resize(n);
  for (std::size_t c = 0; c < n; ++c) {
    const std::size_t k = touching[c];
    const auto first = static_cast<std::size_t>(rows.first[k]);
    const Vec3 normal = rows.normal.get(k), force = rows.force(k);
    const double along = dot(force, normal);
    const Vec3 tangential = force - along * normal;
    frame.first_id[c] = state.particles.id[first];
    frame.second_id[c] = rows.partner_id[k];
    frame.turn[c] = rows.turn[k];
    frame.first_position.set(c, state.particles.position.get(first));
    frame.second_position.set(c, state.particles.position.get(static_cast<std::size_t>(rows.second[k])));
    frame.normal.set(c, normal);
    frame.normal_force.set(c, along * normal);
    frame.tangential_force.set(c, tangential);
    frame.normal_load[c] = -along;
    frame.tangential_load[c] = norm(tangential);
    frame.overlap[c] = 2 * rows.half_overlap(k);
  }
  return frame;
}

/// End points of the contact lines: first, second, first, second, ...
std::vector<double> line_ends(const ContactFrame& frame) {
  std::vector<double> ends;
  ends.reserve(6 * frame.size());
  for (std::size_t c = 0; c < frame.size(); ++c) {
    for (const Vec3 p : {frame.first_position.get(c), frame.second_position.get(c)}) {
      ends.insert(ends.end(), {p.x, p.y, p.z});
    }
  }
  return ends;
}

FrameHeader read_header(const Hdf5Reader& file, const std::string& format) {
  if (file.text_attribute("/", "format") != format) throw_file_error(file.path(), "is not a " + format);
  const std::int64_t version = file.integer_attribute("/", "format_version");
  if (version != format_version) {
    throw_file_error(file.path(), "has format version " + std::to_string(version) + ", this wedge reads version " +
                                      std::to_string(format_version));
  }
  FrameHeader header;
  header.time = file.number_attribute("/", "time");
  header.step = file.integer_attribute("/", "step");
  header.info.number = file.integer_attribute("/", "number");
  header.info.precision = file.text_attribute("/", "precision") == "single" ? FramePrecision::single_precision
                                                                            : FramePrecision::double_precision;
  header.info.scene_text = file.text("scene");
  return header;
}

void read_field(const Hdf5Reader& file, const std::string& name, Vec3Array& vectors, std::size_t n) {
  std::vector<double> rows(3 * n);
  file.read(name, rows.data(), rows.size());
  vectors.resize(n);
  for (std::size_t i = 0; i < n; ++i) vectors.set(i, {rows[3 * i], rows[3 * i + 1], rows[3 * i + 2]});
}
template <class T>
void read_field(const Hdf5Reader& file, const std::string& name, Array<T>& numbers, std::size_t n) {
  numbers.resize(n);
  file.read(name, numbers.data(), n);
}

constexpr const char* particle_format = "wedge particle frame";
constexpr const char* contact_format = "wedge contact frame";

}  // namespace

void write_particle_frame(const std::string& path, const State& state, const FrameInfo& info) {
  FrameWriter writer(path, state, info, particle_format);
  const Particles& p = state.particles;
  const auto n = static_cast<std::size_t>(p.count());
  writer.file().group("particles");
  for_each_frame_field(p, [&](const char* name, const auto& field) {
    writer.field("particles", info_of(p, name, field), field, n);
  });
  writer.vtk_grid("particles/position", n, 1, vtk_vertex);
  for_each_frame_field(p, [&](const std::string& name, const auto&) {
    if (name != "position") writer.file().link("particles/" + name, "VTKHDF/PointData/" + name);
  });
  writer.file().save();
}

void write_contact_frame(const std::string& path, const State& state, const FrameInfo& info) {
  FrameWriter writer(path, state, info, contact_format);
  const ContactFrame frame = touching_contacts(state);
  const std::size_t n = frame.size();
  writer.file().group("contacts");
  writer.field("contacts", {"ends", "m", "centres of the two grains, two rows a contact"}, line_ends(frame));
  ContactFrame::for_each_field(frame, [&](const FieldInfo& field_info, const auto& field) {
    writer.field("contacts", field_info, field, n);
  });
  writer.vtk_grid("contacts/ends", n, 2, vtk_line);
  ContactFrame::for_each_field(frame, [&](const FieldInfo& field_info, const auto&) {
    const std::string name = field_info.name;
    writer.file().link("contacts/" + name, "VTKHDF/CellData/" + name);
  });
  writer.file().save();
}

ParticleFrame read_particle_frame(const std::string& path) {
  const Hdf5Reader file(path);
  ParticleFrame frame;
  frame.header = read_header(file, particle_format);
  const std::size_t n = file.shape("particles/id").rows;
  Particles& p = frame.particles;
  p.resize(static_cast<Index>(n));
  Particles::for_each_field(p, [](const FieldInfo&, auto& field) { std::fill(field.begin(), field.end(), 0); });
  for (Vec3Array* seen : {&p.velocity_seen, &p.angular_velocity_seen}) {
    for (Array<double>* component : {&seen->x, &seen->y, &seen->z})
      std::fill(component->begin(), component->end(), 0);
  }
  for_each_frame_field(
      p, [&](const std::string& name, auto& field) { read_field(file, "particles/" + name, field, n); });
  return frame;
}

ContactFrame read_contact_frame(const std::string& path) {
  const Hdf5Reader file(path);
  ContactFrame frame;
  frame.header = read_header(file, contact_format);
  const std::size_t n = file.shape("contacts/first_id").rows;
  ContactFrame::for_each_field(frame, [&](const FieldInfo& info, auto& field) {
    read_field(file, std::string("contacts/") + info.name, field, n);
  });
  Vec3Array ends;
  read_field(file, "contacts/ends", ends, 2 * n);
  frame.first_position.resize(n);
  frame.second_position.resize(n);
  for (std::size_t c = 0; c < n; ++c) {
    frame.first_position.set(c, ends.get(2 * c));
    frame.second_position.set(c, ends.get(2 * c + 1));
  }
  return frame;
}

void update_series(const std::string& path, const std::vector<SeriesEntry>& entries) {
  std::string files;
  for (const SeriesEntry& entry : entries) {
    if (!files.empty()) files += ',';
    files += "\n    {\"name\": " + json_string(entry.name) + ", \"time\": " + json_number(entry.time) + "}";
  }
  JsonObject series;
  series.add("file-series-version", "1.0");
  series.add_raw("files", "[" + files + "\n  ]");
  write_text_file_atomically(path, series.text());
}

}  // namespace wedge

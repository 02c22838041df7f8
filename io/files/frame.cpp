// frame.cpp: the fields of a frame once in our own groups, and once more as VTKHDF, by hard links.
#include "io/files/frame.hpp"

#include <algorithm>

#include "io/files/atomic_file.hpp"
#include "io/files/hdf5_file.hpp"

namespace wedge {
namespace {

constexpr int format_version = 1;
constexpr std::uint8_t vtk_vertex = 1, vtk_line = 3;  // vtkCellType.h

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
      : part_(path),
        file_(part_),
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
  void save() {
    file_.close();
    part_.commit();
  }

  void field(const std::string& group, const FieldInfo& info, const Vec3Array& vectors, std::size_t n) {
    field(group, info, interleaved(vectors, n));
  }
  void field(const std::string& group, const FieldInfo& info, const std::vector<double>& rows) {
    file_.write(group + "/" + info.name, rows.data(), Shape{rows.size() / 3, 3}, Packing::shuffle_gzip, real_);
    describe(group, info);
  }
  template <class T>
  void field(const std::string& group, const FieldInfo& info, const Array<T>& numbers, std::size_t n) {
    const NumberKind stored = std::is_same_v<T, double> ? real_ : number_kind<T>();
    file_.write(group + "/" + info.name, numbers.data(), Shape{n}, Packing::shuffle_gzip, stored);
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

  PartFile part_;
  Hdf5Writer file_;
  NumberKind real_;
};

/// One contact as a frame shows it: the fields of ContactFrame, one value each.
struct ContactLine {
  std::int32_t first_id, second_id, turn;
  Vec3 first_position, second_position, normal, normal_force, tangential_force;
  double normal_load, tangential_load, overlap;
};

ContactLine contact_line(const State& state, const Vec3Array& forces, std::size_t row) {
  const ContactTable& rows = state.contacts;
  const auto first = static_cast<std::size_t>(rows.first[row]), second = static_cast<std::size_t>(rows.second[row]);
  ContactLine c{};
  c.first_id = state.particles.id[first];
  const Partner partner = row_partner(state, row);
  c.second_id = state.particles.id[static_cast<std::size_t>(partner.grain)];
  c.turn = partner.turn;
  c.first_position = state.particles.position.get(first);
  c.second_position = state.particles.position.get(second);
  c.normal = row_normal(state, row);
  const Vec3 force = forces.get(row);
  const double along = dot(force, c.normal);
  c.normal_force = along * c.normal;
  c.tangential_force = force - c.normal_force;
  c.normal_load = -along;
  c.tangential_load = norm(c.tangential_force);
  c.overlap = row_overlap(state, row);
  return c;
}

/// Rows of the contact table that touch.
std::vector<Index> touching_rows(const State& state) {
  std::vector<Index> touching;
  for (Index k = 0; k < state.contacts.rows(); ++k) {
    if (row_overlap(state, static_cast<std::size_t>(k)) > 0) touching.push_back(k);
  }
  return touching;
}

void append(std::vector<double>& rows, Vec3 v) { rows.insert(rows.end(), {v.x, v.y, v.z}); }

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
  Particles::for_each_frame_field(p, [&](const char* name, const auto& field) {
    writer.field("particles", info_of(p, name, field), field, n);
  });
  writer.vtk_grid("particles/position", n, 1, vtk_vertex);
  Particles::for_each_frame_field(p, [&](const std::string& name, const auto&) {
    if (name != "position") writer.file().link("particles/" + name, "VTKHDF/PointData/" + name);
  });
  writer.save();
}

void write_contact_frame(const std::string& path, const State& state, const Vec3Array& forces,
                         const FrameInfo& info) {
  require(forces.size() == state.contacts.first.size(), "a contact frame needs a force for each row");
  FrameWriter writer(path, state, info, contact_format);
  const std::vector<Index> touching = touching_rows(state);
  const std::size_t n = touching.size();
  ContactLine contact{};
  // Field after field, so that only one of them is in memory.
  const auto for_each_contact = [&](auto&& use) {
    for (const Index row : touching) {
      contact = contact_line(state, forces, static_cast<std::size_t>(row));
      use();
    }
  };
  writer.file().group("contacts");
  {
    std::vector<double> ends;
    ends.reserve(6 * n);
    for_each_contact([&] {
      append(ends, contact.first_position);
      append(ends, contact.second_position);
    });
    writer.field("contacts", {"ends", "m", "centres of the two grains, two rows a contact"}, ends);
  }
  ContactFrame::for_each_field(contact, [&](const FieldInfo& field_info, const auto& value) {
    using Value = std::decay_t<decltype(value)>;
    if constexpr (std::is_same_v<Value, Vec3>) {
      std::vector<double> rows;
      rows.reserve(3 * n);
      for_each_contact([&] { append(rows, value); });
      writer.field("contacts", field_info, rows);
    } else {
      Array<Value> numbers;
      numbers.reserve(n);
      for_each_contact([&] { numbers.push_back(value); });
      writer.field("contacts", field_info, numbers, n);
    }
  });
  writer.vtk_grid("contacts/ends", n, 2, vtk_line);
  ContactFrame::for_each_field(contact, [&](const FieldInfo& field_info, const auto&) {
    const std::string name = field_info.name;
    writer.file().link("contacts/" + name, "VTKHDF/CellData/" + name);
  });
  writer.save();
}

FrameHeader read_particle_header(const std::string& path) { return read_header(Hdf5Reader(path), particle_format); }

ParticleFrame read_particle_frame(const std::string& path) {
  const Hdf5Reader file(path);
  ParticleFrame frame;
  frame.header = read_header(file, particle_format);
  const std::size_t n = file.shape("particles/id").rows;
  Particles& p = frame.particles;
  p.resize(static_cast<Index>(n));
  Particles::for_each_field(p, [](const FieldInfo&, auto& field) { std::fill(field.begin(), field.end(), 0); });
  for (std::size_t i = 0; i < p.seen.size(); ++i) p.seen.set(i, Seen{});
  Particles::for_each_frame_field(
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

}  // namespace wedge

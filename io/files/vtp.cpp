// vtp.cpp: VTK PolyData as XML with its arrays appended in base64 (VTK file formats, vtk.org, "XML file formats").
#include "io/files/vtp.hpp"

#include <cmath>
#include <cstdint>
#include <vector>

#include "io/files/atomic_file.hpp"

namespace wedge {
namespace {

constexpr double pi = 3.14159265358979323846;
constexpr int pieces_per_turn = 96;

/// Appends bytes as base64 (RFC 4648).
void append_base64(std::string& text, const std::string& bytes) {
  static const char* const digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  text.reserve(text.size() + (bytes.size() + 2) / 3 * 4);
  for (std::size_t k = 0; k < bytes.size(); k += 3) {
    const auto byte = [&](std::size_t j) -> unsigned {
      return k + j < bytes.size() ? static_cast<unsigned char>(bytes[k + j]) : 0;
    };
    const unsigned three = byte(0) << 16 | byte(1) << 8 | byte(2);
    text += digits[three >> 18];
    text += digits[(three >> 12) & 63];
    text += k + 1 < bytes.size() ? digits[(three >> 6) & 63] : '=';
    text += k + 2 < bytes.size() ? digits[three & 63] : '=';
  }
}

template <class T>
constexpr const char* vtk_type() {
  if constexpr (std::is_same_v<T, double>) return "Float64";
  if constexpr (std::is_same_v<T, std::int32_t>) return "Int32";
  if constexpr (std::is_same_v<T, std::int64_t>) return "Int64";
}

/// A .vtp file being made: elements in order, their numbers appended behind them.
class PolyData {
public:
  PolyData(std::size_t points, std::size_t vertices, std::size_t polygons) {
    const std::uint16_t probe = 1;
    const bool little = *reinterpret_cast<const unsigned char*>(&probe) == 1;
    xml_ = "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"";
    xml_ += little ? "LittleEndian" : "BigEndian";
    xml_ += "\" header_type=\"UInt64\">\n<PolyData>\n<Piece NumberOfPoints=\"" + std::to_string(points) +
            "\" NumberOfVerts=\"" + std::to_string(vertices) +
            "\" NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\"" + std::to_string(polygons) + "\">\n";
  }
  void open(const char* element) { xml_ += std::string("<") + element + ">\n"; }
  void close(const char* element) { xml_ += std::string("</") + element + ">\n"; }

  /// An array of `n` numbers, `components` a tuple.
  template <class T>
  void array(const char* name, const T* data, std::size_t n, int components = 1) {
    xml_ += std::string("<DataArray type=\"") + vtk_type<T>() + "\" Name=\"" + name + "\" NumberOfComponents=\"" +
            std::to_string(components) + "\" format=\"appended\" offset=\"" + std::to_string(appended_.size()) +
            "\"/>\n";
    const std::uint64_t size = n * sizeof(T);
    std::string bytes(reinterpret_cast<const char*>(&size), sizeof size);
    if (n > 0) bytes.append(reinterpret_cast<const char*>(data), size);
    append_base64(appended_, bytes);
  }
  void save(const std::string& path) {
    xml_ += "</Piece>\n</PolyData>\n<AppendedData encoding=\"base64\">\n_";
    const std::string end = "\n</AppendedData>\n</VTKFile>\n";
    replace_file(path,
                 {{xml_.data(), xml_.size()}, {appended_.data(), appended_.size()}, {end.data(), end.size()}});
  }

private:
  std::string xml_, appended_;
};

/// A surface being made of triangles and quadrilaterals.
struct Surface {
  std::vector<double> points;  // x, y, z, x, y, z, ...
  std::vector<std::int64_t> connectivity, offsets;
  std::vector<std::int32_t> wall;

  std::int64_t add_point(double x, double y, double z) {
    points.insert(points.end(), {x, y, z});
    return static_cast<std::int64_t>(points.size() / 3) - 1;
  }
  void add_polygon(const std::vector<std::int64_t>& corners, int of_wall) {
    connectivity.insert(connectivity.end(), corners.begin(), corners.end());
    offsets.push_back(static_cast<std::int64_t>(connectivity.size()));
    wall.push_back(of_wall);
  }
};

/// A profile line from (r, z) to (r, z), turned over the domain's angle.
void add_revolved(Surface& surface, int wall, Eigen::Vector2d from, Eigen::Vector2d to, const Domain& domain) {
  if (from.x() == 0 && to.x() == 0) return;  // on the axis: no surface
  const int order = domain.kind == DomainKind::sector ? domain.order : 1;
  const int pieces = (pieces_per_turn + order - 1) / order;
  std::int64_t previous_from = 0, previous_to = 0;
  for (int k = 0; k <= pieces; ++k) {
    const double phi = 2 * pi / order * k / pieces;
    const std::int64_t next_from = surface.add_point(from.x() * std::cos(phi), from.x() * std::sin(phi), from.y());
    const std::int64_t next_to = surface.add_point(to.x() * std::cos(phi), to.x() * std::sin(phi), to.y());
    if (k > 0 && from.x() == 0) {
      surface.add_polygon({next_from, previous_to, next_to}, wall);
    } else if (k > 0 && to.x() == 0) {
      surface.add_polygon({previous_from, next_to, next_from}, wall);
    } else if (k > 0) {
      surface.add_polygon({previous_from, previous_to, next_to, next_from}, wall);
    }
    previous_from = next_from;
    previous_to = next_to;
  }
}

/// A profile line from (x, z) to (x, z), drawn out over the width of a slot.
void add_extruded(Surface& surface, int wall, Eigen::Vector2d from, Eigen::Vector2d to, double width) {
  const std::int64_t a = surface.add_point(from.x(), 0, from.y()), b = surface.add_point(to.x(), 0, to.y());
  const std::int64_t c = surface.add_point(to.x(), width, to.y()), d = surface.add_point(from.x(), width, from.y());
  surface.add_polygon({a, b, c, d}, wall);
}

std::vector<double> tuples(const Vec3Array& field, std::size_t n) {
  std::vector<double> rows(3 * n);
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3 v = field.get(i);
    rows[3 * i] = v.x;
    rows[3 * i + 1] = v.y;
    rows[3 * i + 2] = v.z;
  }
  return rows;
}

}  // namespace

void write_particles_vtp(const std::string& path, const Particles& p) {
  const auto n = static_cast<std::size_t>(p.count());
  PolyData file(n, n, 0);
  const auto write = [&](const char* name, const auto& field) {
    if constexpr (std::is_same_v<std::decay_t<decltype(field)>, Vec3Array>)
      file.array(name, tuples(field, n).data(), 3 * n, 3);
    else
      file.array(name, field.data(), n);
  };
  file.open("PointData");
  Particles::for_each_frame_field(p, [&](const char* name, const auto& field) {
    if (static_cast<const void*>(&field) != &p.position) write(name, field);
  });
  file.close("PointData");
  file.open("Points");
  write("Points", p.position);
  file.close("Points");
  std::vector<std::int64_t> connectivity(n), offsets(n);
  for (std::size_t i = 0; i < n; ++i) {
    connectivity[i] = static_cast<std::int64_t>(i);
    offsets[i] = static_cast<std::int64_t>(i) + 1;
  }
  file.open("Verts");
  file.array("connectivity", connectivity.data(), n);
  file.array("offsets", offsets.data(), n);
  file.close("Verts");
  file.save(path);
}

void write_vessel_vtp(const std::string& path, const Vessel& vessel, const Domain& domain) {
  Surface surface;
  for (int w = 0; w < vessel.wall_count(); ++w) {
    if (!vessel.present(w)) continue;
    const std::vector<Eigen::Vector2d>& profile = vessel.wall(w).profile;
    const Eigen::Vector2d travel(0, vessel.travel(w));
    for (std::size_t k = 1; k < profile.size(); ++k) {
      const Eigen::Vector2d from = profile[k - 1] + travel, to = profile[k] + travel;
      if (domain.kind == DomainKind::slot) {
        add_extruded(surface, w, from, to, domain.slot_width);
      } else {
        add_revolved(surface, w, from, to, domain);
      }
    }
  }
  PolyData file(surface.points.size() / 3, 0, surface.wall.size());
  file.open("CellData");
  file.array("wall", surface.wall.data(), surface.wall.size());
  file.close("CellData");
  file.open("Points");
  file.array("Points", surface.points.data(), surface.points.size(), 3);
  file.close("Points");
  file.open("Polys");
  file.array("connectivity", surface.connectivity.data(), surface.connectivity.size());
  file.array("offsets", surface.offsets.data(), surface.offsets.size());
  file.close("Polys");
  file.save(path);
}

}  // namespace wedge

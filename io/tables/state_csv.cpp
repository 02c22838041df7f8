// state_csv.cpp: a table of grains, written and read; every complaint has its place in the file.
#include "io/tables/state_csv.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <unordered_map>

#include "core/require.hpp"
#include "io/files/atomic_file.hpp"
#include "io/tables/csv.hpp"

namespace wedge {
namespace {

constexpr std::size_t number_columns = 9;  // the vectors
constexpr std::array<const char*, 12> columns = {"x",  "y",  "z",  "vx", "vy",     "vz",
                                                 "wx", "wy", "wz", "id", "radius", "material"};
constexpr std::size_t id_column = 9, radius_column = 10, material_column = 11;
constexpr const char* header = "id,x,y,z,vx,vy,vz,wx,wy,wz,radius,material";
constexpr std::size_t most_errors = 10;

/// The arrays of the vector columns, in the order of `columns`.
template <class Self>
auto vector_components(Self& p) {
  return std::array{&p.position.x,         &p.position.y,         &p.position.z,
                    &p.velocity.x,         &p.velocity.y,         &p.velocity.z,
                    &p.angular_velocity.x, &p.angular_velocity.y, &p.angular_velocity.z};
}

std::string listed(const std::vector<std::string>& names) {
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
  return list;
}

/// Reads the table; collects what is wrong.
class StateTable {
public:
  StateTable(const std::string& path, const StateCsvDefaults& defaults, const std::vector<std::string>& materials)
      : path_(path), defaults_(defaults), materials_(materials) {}

  Particles read(std::string_view text) {
    if (text.substr(0, 3) == "\xEF\xBB\xBF") text.remove_prefix(3);  // byte order mark of UTF-8
    while (!text.empty() && !full()) {
      ++line_;
      const std::size_t end = text.find('\n');
      std::string_view line = text.substr(0, end);
      text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
      if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
      if (line.find_first_not_of(" \t") == std::string_view::npos || line.front() == '#') continue;
      if (place_.empty()) {
        read_header(split_csv_line(line));
        if (!errors_.empty()) break;  // rows of unknown columns would only repeat it
      } else {
        read_row(split_csv_line(line));
      }
    }
    if (place_.empty() && errors_.empty()) {
      line_ = 1;
      add_error(1, std::string("the file is empty; expected the header line ") + header);
    }
    if (!errors_.empty()) throw FileError(report());
    return particles();
  }

private:
  struct Row {
    std::array<double, number_columns> vectors{};
    double radius = 0;
    int material = 0;
    int id = 0;
  };

  bool full() const { return errors_.size() > most_errors; }

  void add_error(std::size_t column, const std::string& what) {
    errors_.push_back(path_ + ":" + std::to_string(line_) + ":" + std::to_string(column) + ": error: " + what);
  }

  std::string report() const {
    std::string text;
    for (std::size_t k = 0; k < std::min(errors_.size(), most_errors); ++k)
      text += (k == 0 ? "" : "\n") + errors_[k];
    if (full())
      text += "\n" + path_ + ": more errors follow; the first " + std::to_string(most_errors) + " are shown";
    return text;
  }

  void read_header(const std::vector<CsvField>& fields) {
    present_.fill(false);
    for (const CsvField& field : fields) {
      const auto known = std::find(columns.begin(), columns.end(), field.text);
      const auto c = static_cast<std::size_t>(known - columns.begin());
      if (known == columns.end()) {
        add_error(field.column, "unknown column '" + field.text + "'; expected " + header + ", in any order");
      } else if (present_[c]) {
        add_error(field.column, "column '" + field.text + "' stands here a second time");
      } else {
        present_[c] = true;
      }
      place_.push_back(c);
    }
    for (std::size_t c = 0; c < columns.size(); ++c) {
      const bool needed = c < number_columns || (c == radius_column && !(defaults_.radius > 0)) ||
                          (c == material_column && defaults_.material < 0);
      if (needed && !present_[c]) add_error(1, std::string("column '") + columns[c] + "' is missing");
    }
  }

  void read_row(const std::vector<CsvField>& fields) {
    if (fields.size() != place_.size()) {
      const std::size_t column =
          fields.size() > place_.size() ? fields[place_.size()].column : fields.back().column;
      add_error(column, "expected " + std::to_string(place_.size()) + " values, as in the header, found " +
                            std::to_string(fields.size()));
      return;
    }
    Row row;
    row.radius = defaults_.radius;
    row.material = defaults_.material;
    row.id = static_cast<int>(rows_.size());
    for (std::size_t k = 0; k < fields.size(); ++k) read_value(fields[k], place_[k], row);
    if (present_[id_column]) check_id(fields, row.id);
    rows_.push_back(row);
  }

  void read_value(const CsvField& field, std::size_t c, Row& row) {
    if (c == id_column) {
      row.id = -1;
      if (parse_number(field.text, row.id) != NumberError::none || row.id < 0) {
        add_error(field.column,
                  "expected a whole number from 0 to 2147483647 for 'id', found '" + field.text + "'");
        row.id = -1;
      }
    } else if (c == material_column) {
      const auto known = std::find(materials_.begin(), materials_.end(), field.text);
      row.material = static_cast<int>(known - materials_.begin());
      if (known == materials_.end()) {
        add_error(field.column, "unknown material '" + field.text + "'; the scene has " + listed(materials_));
      }
    } else {
      double& value = c == radius_column ? row.radius : row.vectors[c];
      const NumberError error = parse_number(field.text, value);
      if (error == NumberError::out_of_range) {
        add_error(field.column, "'" + field.text + "' for '" + columns[c] + "' is beyond the range of a double");
      } else if (error != NumberError::none || !std::isfinite(value)) {
        add_error(field.column,
                  std::string("expected a finite number for '") + columns[c] + "', found '" + field.text + "'");
      } else if (c == radius_column && value <= 0) {
        add_error(field.column, "expected a radius greater than 0, found '" + field.text + "'");
      }
    }
  }

  void check_id(const std::vector<CsvField>& fields, int id) {
    if (id < 0) return;  // complained about already
    const auto [entry, fresh] = line_of_id_.emplace(id, line_);
    if (fresh) return;
    const auto place = std::find(place_.begin(), place_.end(), id_column) - place_.begin();
    add_error(fields[static_cast<std::size_t>(place)].column,
              "id " + std::to_string(id) + " stands in line " + std::to_string(entry->second) + " already");
  }

  Particles particles() const {
    Particles p;
    p.resize(static_cast<Index>(rows_.size()));
    Particles::for_each_field(p, [](const FieldInfo&, auto& field) { std::fill(field.begin(), field.end(), 0); });
    const auto components = vector_components(p);
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      for (std::size_t c = 0; c < number_columns; ++c) (*components[c])[i] = rows_[i].vectors[c];
      p.radius[i] = rows_[i].radius;
      p.material[i] = rows_[i].material;
      p.id[i] = rows_[i].id;
      p.seen.set(i, {});
    }
    return p;
  }

  const std::string& path_;
  const StateCsvDefaults& defaults_;
  const std::vector<std::string>& materials_;
  std::size_t line_ = 0;
  std::vector<std::size_t> place_;  // column of the k-th value of a line
  std::array<bool, columns.size()> present_{};
  std::vector<Row> rows_;
  std::unordered_map<int, std::size_t> line_of_id_;
  std::vector<std::string> errors_;
};

}  // namespace

void write_state_csv(const std::string& path, const Particles& p, const std::vector<std::string>& materials) {
  for (const std::string& name : materials) {
    if (name.find_first_of("\r\n") != std::string::npos) {
      throw_file_error(path, "cannot write the material '" + name + "': its name has a line break");
    }
  }
  std::string text = std::string(header) + "\n";
  const auto components = vector_components(p);
  for (std::size_t i = 0; i < static_cast<std::size_t>(p.count()); ++i) {
    const auto material = static_cast<std::size_t>(p.material[i]);
    require(material < materials.size(), "a grain has a material that the scene has not");
    append_number(text, p.id[i]);
    for (const Array<double>* component : components) {
      text += ',';
      append_number(text, (*component)[i]);
    }
    text += ',';
    append_number(text, p.radius[i]);
    text += ',' + csv_quoted(materials[material]) + '\n';
  }
  write_text_file_atomically(path, text);
}

Particles read_state_csv(const std::string& path, const StateCsvDefaults& defaults,
                         const std::vector<std::string>& materials) {
  return StateTable(path, defaults, materials).read(read_text_file(path));
}

}  // namespace wedge

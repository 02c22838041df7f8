// file_series.cpp: the JSON of a .series file, version 1.0 of the format.
#include "io/tables/file_series.hpp"

#include <nlohmann/json.hpp>

#include "io/files/atomic_file.hpp"
#include "io/tables/json.hpp"

namespace wedge {

void write_file_series(const std::string& path, const std::vector<SeriesEntry>& entries) {
  Json files = Json::array();
  for (const SeriesEntry& entry : entries) files.push_back({{"name", entry.name}, {"time", entry.time}});
  write_text_file_atomically(path, json_text({{"file-series-version", "1.0"}, {"files", files}}));
}

}  // namespace wedge

// file_series.hpp: lists of frames that ParaView opens as one data set in time.
#pragma once

#include <string>
#include <vector>

namespace wedge {

struct SeriesEntry {
  std::string name;  // file name, relative to the series file
  double time = 0;   // s
};

/// Replaces `path` (particles.hdf.series, contacts.hdf.series) by a list of these frames. Throws FileError.
void write_file_series(const std::string& path, const std::vector<SeriesEntry>& entries);

}  // namespace wedge

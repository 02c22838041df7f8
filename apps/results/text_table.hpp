// text_table.hpp: plain text for people: aligned tables, sizes of files.
#pragma once

#include <string>
#include <vector>

namespace wedge {

/// Rows of words, each column as wide as its widest word; the first column is set left, the others right.
class TextTable {
public:
  void row(std::vector<std::string> words) { rows_.push_back(std::move(words)); }
  /// The table, each line after `indent`.
  std::string text(const std::string& indent = "") const;

private:
  std::vector<std::vector<std::string>> rows_;
};

/// A size as people say it: "800 B", "12 kB", "3.4 GB" (powers of 1000).
std::string size_text(double bytes);

}  // namespace wedge

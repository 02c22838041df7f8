// csv.hpp: numbers as text, free of locale, and the fields of a line of comma-separated values.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace wedge {

/// Appends the shortest text that reads back as the same double; whole numbers below 2^53 without an exponent.
void append_number(std::string& text, double value);
std::string number_text(double value);

enum class NumberError { none, malformed, out_of_range };

/// Reads a whole text as one number ("1", "+1.5e-3", "inf", "nan"; no blanks). `value` is set when none is
/// returned.
NumberError parse_number(std::string_view text, double& value);
NumberError parse_number(std::string_view text, int& value);

/// One field of a line.
struct CsvField {
  std::string text;        // without quotes, blanks around it removed
  std::size_t column = 1;  // 1-based place of its first byte in the line
};

/// Cuts a line at its commas. A field may stand in double quotes, with "" for a quote in it (RFC 4180, without line
/// breaks inside a field). A quote that is not closed ends with the line.
std::vector<CsvField> split_csv_line(std::string_view line);

/// `text`, put in quotes where it has a comma, a quote or blanks at its ends.
std::string csv_quoted(std::string_view text);

}  // namespace wedge

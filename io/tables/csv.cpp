// csv.cpp: std::to_chars, std::from_chars and the rules of RFC 4180.
#include "io/tables/csv.hpp"

#include <charconv>
#include <cmath>
#include <cstdint>

namespace wedge {
namespace {

constexpr double largest_whole = 9007199254740992.0;  // 2^53

bool blank(char c) { return c == ' ' || c == '\t'; }

template <class T>
NumberError parse_any(std::string_view text, T& value) {
  const bool plus = !text.empty() && text.front() == '+';
  if (plus) text.remove_prefix(1);
  if (text.empty() || (plus && text.front() == '-')) return NumberError::malformed;
  T parsed{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), parsed);
  if (end != text.data() + text.size() || error == std::errc::invalid_argument) return NumberError::malformed;
  if (error != std::errc{}) return NumberError::out_of_range;
  value = parsed;
  return NumberError::none;
}

}  // namespace

void append_number(std::string& text, double value) {
  char buffer[32];
  std::to_chars_result result{};
  const bool whole = std::abs(value) < largest_whole && std::trunc(value) == value;
  if (whole && !(value == 0 && std::signbit(value))) {
    result = std::to_chars(buffer, buffer + sizeof buffer, static_cast<std::int64_t>(value));
  } else {
    result = std::to_chars(buffer, buffer + sizeof buffer, value);
  }
  text.append(buffer, result.ptr);
}

std::string number_text(double value) {
  std::string text;
  append_number(text, value);
  return text;
}

NumberError parse_number(std::string_view text, double& value) { return parse_any(text, value); }
NumberError parse_number(std::string_view text, int& value) { return parse_any(text, value); }

std::vector<CsvField> split_csv_line(std::string_view line) {
  std::vector<CsvField> fields;
  std::size_t at = 0;
  for (;;) {
    while (at < line.size() && blank(line[at])) ++at;
    CsvField field;
    field.column = at + 1;
    const bool quoted = at < line.size() && line[at] == '"';
    if (quoted) {
      for (++at; at < line.size(); ++at) {
        if (line[at] == '"' && (at + 1 >= line.size() || line[at + 1] != '"')) break;
        if (line[at] == '"') ++at;
        field.text += line[at];
      }
      if (at < line.size()) ++at;  // the closing quote; what follows it up to the comma belongs to the field
      while (at < line.size() && blank(line[at])) ++at;
    }
    while (at < line.size() && line[at] != ',') field.text += line[at++];
    while (!quoted && !field.text.empty() && blank(field.text.back())) field.text.pop_back();
    fields.push_back(std::move(field));
    if (at >= line.size()) return fields;
    ++at;  // the comma
  }
}

std::string csv_quoted(std::string_view text) {
  const bool plain = text.find_first_of(",\"") == std::string_view::npos &&
                     (text.empty() || (!blank(text.front()) && !blank(text.back())));
  if (plain) return std::string(text);
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + '"';
}

}  // namespace wedge

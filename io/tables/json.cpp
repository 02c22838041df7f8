// json.cpp: RFC 8259, as much of it as a flat object needs.
#include "io/tables/json.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>

#include "io/files/atomic_file.hpp"
#include "io/tables/csv.hpp"

namespace wedge {
namespace {

/// Length of the well-formed UTF-8 sequence at the front of `s` (RFC 3629), 0 when there is none. Pre: s not empty.
std::size_t utf8_length(std::string_view s) {
  const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(s[k]); };
  const unsigned char lead = byte(0);
  if (lead < 0x80) return 1;
  const std::size_t length = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
  if (lead < 0xC2 || lead > 0xF4 || s.size() < length) return 0;
  for (std::size_t k = 1; k < length; ++k) {
    if ((byte(k) & 0xC0) != 0x80) return 0;
  }
  if (lead == 0xE0 && byte(1) < 0xA0) return 0;  // longer than needed
  if (lead == 0xED && byte(1) > 0x9F) return 0;  // a surrogate
  if (lead == 0xF0 && byte(1) < 0x90) return 0;  // longer than needed
  if (lead == 0xF4 && byte(1) > 0x8F) return 0;  // above U+10FFFF
  return length;
}

void append_utf8(std::string& text, unsigned code) {
  const auto put = [&](unsigned byte) { text += static_cast<char>(static_cast<unsigned char>(byte)); };
  if (code < 0x80) {
    put(code);
  } else if (code < 0x800) {
    put(0xC0 | (code >> 6));
    put(0x80 | (code & 0x3F));
  } else {
    put(0xE0 | (code >> 12));
    put(0x80 | ((code >> 6) & 0x3F));
    put(0x80 | (code & 0x3F));
  }
}

/// Walks over a JSON text; every failure names the line.
class FlatParser {
public:
  FlatParser(std::string_view text, const std::string& path) : text_(text), path_(path) {}

  std::vector<std::pair<std::string, std::string>> object() {
    std::vector<std::pair<std::string, std::string>> entries;
    expect('{');
    if (peek() != '}') {
      for (;;) {
        std::string key = string();
        expect(':');
        entries.emplace_back(std::move(key), value());
        if (peek() != ',') break;
        expect(',');
      }
    }
    expect('}');
    if (peek() != '\0') fail("nothing more after the closing brace");
    return entries;
  }

private:
  [[noreturn]] void fail(const std::string& expected) const {
    const auto lines = std::count(text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(at_), '\n');
    throw_file_error(path_ + ":" + std::to_string(lines + 1), "not the JSON wedge writes: expected " + expected);
  }
  char peek() {
    while (at_ < text_.size() &&
           (text_[at_] == ' ' || text_[at_] == '\n' || text_[at_] == '\t' || text_[at_] == '\r')) {
      ++at_;
    }
    return at_ < text_.size() ? text_[at_] : '\0';
  }
  void expect(char c) {
    if (peek() != c || at_ >= text_.size()) fail(std::string("'") + c + "'");
    ++at_;
  }
  unsigned four_hex() {
    unsigned code = 0;
    const char* first = text_.data() + at_;
    if (text_.size() - at_ < 4 || std::from_chars(first, first + 4, code, 16).ptr != first + 4)
      fail("four hex digits");
    at_ += 4;
    return code;
  }
  std::string string() {
    expect('"');
    std::string result;
    while (at_ < text_.size() && text_[at_] != '"') {
      const char c = text_[at_++];
      if (c != '\\') {
        result += c;
        continue;
      }
      if (at_ >= text_.size()) break;
      switch (const char escape = text_[at_++]) {
        case 'n':
          result += '\n';
          break;
        case 't':
          result += '\t';
          break;
        case 'r':
          result += '\r';
          break;
        case 'b':
          result += '\b';
          break;
        case 'f':
          result += '\f';
          break;
        case 'u':
          append_utf8(result, four_hex());
          break;
        default:
          result += escape;
      }
    }
    if (at_ >= text_.size()) fail("a closing quote");
    ++at_;
    return result;
  }
  std::string value() {
    if (peek() == '"') return string();
    const std::size_t start = at_;
    while (at_ < text_.size() && (std::isalnum(static_cast<unsigned char>(text_[at_])) != 0 ||
                                  std::string_view("+-.").find(text_[at_]) != std::string_view::npos)) {
      ++at_;
    }
    const std::string_view word = text_.substr(start, at_ - start);
    double number = 0;
    if (word != "true" && word != "false" && word != "null" && parse_number(word, number) != NumberError::none) {
      at_ = start;
      fail("a string, a number, true, false or null");
    }
    return std::string(word);
  }

  std::string_view text_;
  const std::string& path_;
  std::size_t at_ = 0;
};

}  // namespace

std::string json_string(std::string_view text) {
  std::string json = "\"";
  while (!text.empty()) {
    const std::size_t length = utf8_length(text);
    const char c = text.front();
    if (length == 0) {
      json += "\\ufffd";
    } else if (c == '"' || c == '\\') {
      json += '\\';
      json += c;
    } else if (c == '\n') {
      json += "\\n";
    } else if (c == '\t') {
      json += "\\t";
    } else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) {
      const char* digits = "0123456789abcdef";
      json += "\\u00";
      json += digits[(c >> 4) & 0xF];
      json += digits[c & 0xF];
    } else {
      json += text.substr(0, length);
    }
    text.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return json + '"';
}

std::string json_number(double value) { return std::isfinite(value) ? number_text(value) : "null"; }

void JsonObject::add_raw(std::string_view key, std::string_view json) {
  if (!lines_.empty()) lines_ += ",\n";
  lines_ += "  " + json_string(key) + ": ";
  lines_ += json;
}

void JsonObject::add(std::string_view key, const std::vector<std::string>& texts) {
  std::string list = "[";
  for (const std::string& text : texts) {
    if (list.size() > 1) list += ", ";
    list += json_string(text);
  }
  add_raw(key, list + "]");
}

std::string JsonObject::text() const { return "{\n" + lines_ + "\n}\n"; }

std::vector<std::pair<std::string, std::string>> parse_flat_json(std::string_view text, const std::string& path) {
  return FlatParser(text, path).object();
}

}  // namespace wedge

// diagnostics.cpp: rendering of errors and the nearest word.
#include "io/scene/diagnostics.hpp"

#include <algorithm>
#include <charconv>
#include <numeric>
#include <tuple>
#include <utility>

#include "core/require.hpp"

namespace wedge {

namespace {

std::vector<std::string> split_lines(const std::string& text) {
  std::vector<std::string> lines;
  std::size_t begin = 0;
  while (begin <= text.size()) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    lines.push_back(text.substr(begin, end - begin));
    if (!lines.back().empty() && lines.back().back() == '\r') lines.back().pop_back();
    begin = end + 1;
  }
  return lines;
}

/// Blanks as wide as the characters before `column`; a tab stays a tab, a UTF-8 sequence is one character.
std::string indent_to(const std::string& line, int column) {
  std::string blanks;
  int characters = 0;
  for (const char c : line) {
    if ((static_cast<unsigned char>(c) & 0xC0) == 0x80) continue;
    if (++characters >= column) return blanks;
    blanks += c == '\t' ? '\t' : ' ';
  }
  while (++characters < column) blanks += ' ';
  return blanks;
}

}  // namespace

bool operator<(const Place& a, const Place& b) {
  return std::tie(a.origin, a.line, a.column) < std::tie(b.origin, b.line, b.column);
}

Diagnostics::Diagnostics(std::string file_name, const std::string& text, std::vector<std::string> overrides)
    : file_name_(std::move(file_name)), lines_(split_lines(text)), overrides_(std::move(overrides)) {}

void Diagnostics::error(Place place, std::string what, std::string remedy) {
  notes_.push_back({place, std::move(what), std::move(remedy)});
}

std::string Diagnostics::render(const Note& note) const {
  if (note.place.origin > 0) {
    const std::string head =
        "--set " + overrides_[static_cast<std::size_t>(note.place.origin) - 1] + ": error: " + note.what;
    return note.remedy.empty() ? head : head + "\n  " + note.remedy;
  }
  const std::size_t row = static_cast<std::size_t>(note.place.line) - 1;
  const std::string line = row < lines_.size() ? lines_[row] : "";
  std::string text = file_name_ + ":" + std::to_string(note.place.line) + ":" + std::to_string(note.place.column) +
                     ": error: " + note.what + "\n" + line + "\n" + indent_to(line, note.place.column) + "^";
  if (!note.remedy.empty()) text += " " + note.remedy;
  return text;
}

std::string Diagnostics::report() const {
  std::vector<Note> ordered = notes_;
  std::stable_sort(ordered.begin(), ordered.end(), [](const Note& a, const Note& b) { return a.place < b.place; });
  std::string text;
  for (const Note& note : ordered) text += (text.empty() ? "" : "\n") + render(note);
  return text;
}

void Diagnostics::throw_if_wrong() const {
  if (!clean()) throw SceneError(report());
}

/// Optimal string alignment distance: Damerau, Communications of the ACM 7 (1964) 171-176.
int edit_distance(const std::string& a, const std::string& b) {
  std::vector<int> before, last(b.size() + 1), now(b.size() + 1);
  std::iota(last.begin(), last.end(), 0);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    now[0] = static_cast<int>(i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const int change = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      now[j] = std::min({change, last[j] + 1, now[j - 1] + 1});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        now[j] = std::min(now[j], before[j - 2] + 1);
    }
    before = last;
    last = now;
  }
  return last[b.size()];
}

std::string one_of(const std::vector<std::string>& words) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (i > 0) text += i + 1 == words.size() ? " or " : ", ";
    text += words[i];
  }
  return text;
}

std::string suggestion(const std::string& word, const std::vector<std::string>& candidates) {
  const int limit = std::max(2, static_cast<int>(word.size()) / 3);
  std::string nearest;
  int distance = std::min(limit + 1, static_cast<int>(word.size()));
  for (const std::string& candidate : candidates) {
    const bool cut_short = word.size() >= 3 && candidate.rfind(word, 0) == 0;
    const int d = cut_short ? 1 : edit_distance(word, candidate);
    if (d < distance) {
      distance = d;
      nearest = candidate;
    }
  }
  if (!nearest.empty()) return "did you mean '" + nearest + "'?";
  return candidates.empty() ? "" : "use " + one_of(candidates);
}

std::string plain_number(double value) {
  char buffer[32];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value);
  return std::string(buffer, end.ptr);
}

std::string short_number(double value) {
  char buffer[32];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::general, 6);
  return std::string(buffer, end.ptr);
}

}  // namespace wedge

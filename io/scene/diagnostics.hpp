// diagnostics.hpp: what is wrong with a scene, where, and what to do: collected, then reported in one go.
#pragma once

#include <string>
#include <vector>

namespace wedge {

/// A place in the scene file (origin 0) or in the k-th override (origin k, counted from 1).
struct Place {
  int origin = 0;
  int line = 1;    // from 1
  int column = 1;  // from 1, in characters
};
bool operator<(const Place& a, const Place& b);

class Diagnostics {
public:
  Diagnostics(std::string file_name, const std::string& text, std::vector<std::string> overrides);

  /// Notes an error: `what` is wrong, `remedy` says what to do (may be empty).
  void error(Place place, std::string what, std::string remedy = "");
  bool clean() const { return notes_.empty(); }
  std::size_t count() const { return notes_.size(); }
  /// All errors in order of place, each as file:line:col: error: what, the source line, a caret and the remedy.
  std::string report() const;
  /// Throws SceneError with the report unless clean().
  void throw_if_wrong() const;

private:
  struct Note {
    Place place;
    std::string what, remedy;
  };
  std::string render(const Note& note) const;

  std::string file_name_;
  std::vector<std::string> lines_;
  std::vector<std::string> overrides_;
  std::vector<Note> notes_;
};

/// Least number of letters to change, insert, drop or swap with their neighbour to turn one word into the other.
int edit_distance(const std::string& a, const std::string& b);
/// "a", "a or b", "a, b or c".
std::string one_of(const std::vector<std::string>& words);
/// "did you mean 'x'?" when a candidate is near or begins so, else "use a, b or c"; empty without candidates.
std::string suggestion(const std::string& word, const std::vector<std::string>& candidates);
/// Shortest decimal that reads back to the same double.
std::string plain_number(double value);
/// A double for people: six significant digits.
std::string short_number(double value);

}  // namespace wedge

// material.hpp: materials, what happens between two of them, and the table of pairs.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/require.hpp"

namespace wedge {

struct Material {
  std::string name;
  double density = 0;  // kg/m3
  double young = 0;    // Pa
  double poisson = 0;  // -
};

/// What a wall without any compliance is made of; grains cannot be. Its name is reserved.
inline Material rigid_material() {
  const double infinity = std::numeric_limits<double>::infinity();
  return {"rigid", infinity, infinity, 0};
}
inline bool is_rigid(const Material& m) { return m.name == "rigid"; }

/// Names of the materials that grains can be made of, by index: the rigid one comes last and is left out.
inline std::vector<std::string> grain_material_names(const std::vector<Material>& materials) {
  std::vector<std::string> names;
  for (const Material& m : materials)
    if (!is_rigid(m)) names.push_back(m.name);
  return names;
}

/// Contact parameters of a pair of materials. Which of them a law uses, kernels/README.md says.
struct Interaction {
  double sliding = 0;                 // sliding friction coefficient mu_s
  double rolling = 0;                 // rolling friction mu_r, a LENGTH [m]
  double damping_normal = 0;          // damping ratio c_n (1 is critical)
  double damping_tangential = 0;      // damping ratio c_t
  std::optional<double> restitution;  // when given, both damping ratios follow from it
  bool given = false;                 // false: the scene says nothing about this pair
};

/// A table over unordered pairs: (a, b) and (b, a) are one entry by storage (half a matrix).
template <class T>
class PairTable {
public:
  PairTable() = default;
  explicit PairTable(int kinds) : kinds_(kinds), entries_(static_cast<std::size_t>(kinds * (kinds + 1) / 2)) {}

  int kinds() const { return kinds_; }
  /// Position of the pair (a, b) in storage. Pre: 0 <= a, b < kinds().
  static int slot(int a, int b) { return a > b ? a * (a + 1) / 2 + b : b * (b + 1) / 2 + a; }
  T& operator()(int a, int b) { return entries_[static_cast<std::size_t>(slot(a, b))]; }
  const T& operator()(int a, int b) const { return entries_[static_cast<std::size_t>(slot(a, b))]; }
  const std::vector<T>& entries() const { return entries_; }

private:
  int kinds_ = 0;
  std::vector<T> entries_;
};

}  // namespace wedge

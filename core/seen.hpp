// seen.hpp: what contacts see of the grains and images, one record a slot, in double or single precision.
#pragma once

#include <cassert>
#include <cstddef>
#include <type_traits>

#include "core/array.hpp"
#include "core/precision.hpp"
#include "core/vec3.hpp"

namespace wedge {

/// What contacts see of a grain or an image during a force step: its place, and velocities predicted to the time of
/// the place. One record a slot, because a contact reads all of it, of partners that lie anywhere (perf/README.md).
/// In single precision it is one cache line.
template <class Number>
struct alignas(std::is_same_v<Number, float> ? 64 : 32) SeenOf {
  Vec3 position;                     // m
  double radius = 0;                 // m
  Vector3<Number> velocity;          // m/s
  Number mass = 0;                   // kg
  Vector3<Number> angular_velocity;  // rad/s
  Number material = 0;               // index of the material
};
using Seen = SeenOf<double>;
inline constexpr std::size_t seen_size = 12;  // numbers in a record, of either width
static_assert(sizeof(Seen) == seen_size * sizeof(double) && sizeof(SeenOf<float>) == 64);

template <class To, class From>
inline SeenOf<To> seen_in(const SeenOf<From>& s) {
  return {s.position,
          s.radius,
          in_width<To>(s.velocity),
          static_cast<To>(s.mass),
          in_width<To>(s.angular_velocity),
          static_cast<To>(s.material)};
}

/// The records of all slots, in one of the two widths. Passes ask for the width they are made for, once; others
/// read and write records of doubles, which a narrow table rounds.
class SeenTable {
public:
  Precision precision() const { return precision_; }
  /// Post: the records are in the new width, rounded if it is narrower.
  void set_precision(Precision precision) {
    if (precision == precision_) return;
    const SeenTable old = *this;
    *this = SeenTable();
    precision_ = precision;
    resize(old.size());
    for (std::size_t i = 0; i < size(); ++i) set(i, old.get(i));
  }

  std::size_t size() const { return narrow() ? single_.size() : double_.size(); }
  std::size_t capacity() const { return narrow() ? single_.capacity() : double_.capacity(); }
  void resize(std::size_t n) { narrow() ? single_.resize(n) : double_.resize(n); }
  void reserve(std::size_t n) { narrow() ? single_.reserve(n) : double_.reserve(n); }

  Seen get(std::size_t i) const { return narrow() ? seen_in<double>(single_[i]) : double_[i]; }
  void set(std::size_t i, const Seen& seen) {
    if (narrow())
      single_[i] = seen_in<float>(seen);
    else
      double_[i] = seen;
  }

  /// Pre: Number is float where the precision is mixed, and double otherwise.
  template <class Number>
  SeenOf<Number>* data() {
    assert((std::is_same_v<Number, float> == narrow()));
    if constexpr (std::is_same_v<Number, float>)
      return single_.data();
    else
      return double_.data();
  }
  template <class Number>
  const SeenOf<Number>* data() const {
    return const_cast<SeenTable*>(this)->data<Number>();
  }

private:
  bool narrow() const { return precision_ == Precision::mixed; }
  Precision precision_ = Precision::double_precision;
  Array<SeenOf<double>> double_;
  Array<SeenOf<float>> single_;
};

}  // namespace wedge

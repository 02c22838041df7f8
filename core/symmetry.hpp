// symmetry.hpp: the map from the domain onto its neighbour copies: a rotation about z (sector), a shift along y
// (slot), or nothing (full vessel). A copy is named by its turn k: k sector angles, or k slot widths.
#pragma once

#include <vector>

#include "core/vec3.hpp"

namespace wedge {

class Symmetry {
public:
  enum class Kind { none, rotation, translation };

  static Symmetry none() { return Symmetry(Kind::none, 1, 0); }
  /// A sector 0 <= phi < 2 pi / order about the z axis. Pre: order >= 2.
  static Symmetry rotation(int order);
  /// A slot 0 <= y < width [m].
  static Symmetry translation(double width) { return Symmetry(Kind::translation, 0, width); }

  Kind kind() const { return kind_; }
  bool periodic() const { return kind_ != Kind::none; }
  /// Copies that make the whole: n of a sector, 1 of a full vessel; a slot counts as 1.
  int order() const { return kind_ == Kind::rotation ? order_ : 1; }
  /// Sector angle [rad].
  double angle() const;
  /// Slot width [m].
  double width() const { return width_; }

  /// The representative of turn k: in (-n/2, n/2] for a rotation, k itself for a translation.
  int residue(int k) const {
    if (kind_ != Kind::rotation) return k;
    const int m = ((k % order_) + order_) % order_;
    return 2 * m > order_ ? m - order_ : m;
  }

  /// A direction (velocity, force, history) of this domain as it stands in copy k.
  Vec3 turn_vector(Vec3 v, int k) const {
    if (kind_ != Kind::rotation) return v;
    const std::size_t m = static_cast<std::size_t>(residue(k) + order_);
    return {cosine_[m] * v.x - sine_[m] * v.y, sine_[m] * v.x + cosine_[m] * v.y, v.z};
  }
  /// A point of this domain as it stands in copy k.
  Vec3 turn_point(Vec3 p, int k) const {
    if (kind_ == Kind::translation) return {p.x, p.y + k * width_, p.z};
    return turn_vector(p, k);
  }

  /// Whether the contact of a grain with the copy of `partner` at this turn is one with its own copy half a turn
  /// away: that copy sees the same contact from its end, so each of the two has half of it.
  bool is_seen_from_both_ends(Index grain, Index partner, int turn) const {
    return grain == partner && 2 * turn == order();
  }

  /// By how many turns a point must be turned to lie in the domain: 0 inside.
  int turns_home(Vec3 p) const;

  /// Distance [m] from the copy k of point p (p in the domain) to the domain; 0 when it lies inside.
  double distance_to_domain(Vec3 p, int k) const;

  /// Distance [m] from a point of the domain to its nearest periodic face: no copy of anything is nearer to it.
  /// Pre: periodic().
  double distance_to_face(Vec3 p) const {
    if (kind_ == Kind::translation) return std::fmin(p.y, width_ - p.y);
    const Vec3 q = turn_vector(p, -1);  // the face phi = angle turned onto the x axis
    const double to_axis = std::sqrt(p.x * p.x + p.y * p.y);
    return std::fmin(p.x > 0 ? std::fabs(p.y) : to_axis, q.x > 0 ? std::fabs(q.y) : to_axis);
  }

private:
  Symmetry(Kind kind, int order, double width) : kind_(kind), order_(order), width_(width) {}
  Kind kind_;
  int order_;
  double width_;
  std::vector<double> cosine_, sine_;  // of turn k at k + order_: read without a branch for negative residues
};

}  // namespace wedge

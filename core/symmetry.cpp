// symmetry.cpp: rotations by whole fractions of a turn, exact where exactness is possible.
#include "core/symmetry.hpp"

#include <cmath>

#include "core/require.hpp"

namespace wedge {
namespace {

constexpr double pi = 3.14159265358979323846;

/// Cosine and sine of 2 pi k / n, reduced to the first octant with whole numbers, so that multiples of 90 degrees
/// are exact and cos(-a) = cos(a), sin(-a) = -sin(a), cos(90 - a) = sin(a) hold to the bit.
void cosine_and_sine(int k, int n, double& cosine, double& sine) {
  const int m = ((k % n) + n) % n;
  const int quadrant = 4 * m / n;
  const int rest = 4 * m - quadrant * n;  // the angle within the quadrant is (pi/2) rest / n
  double c, s;
  if (2 * rest <= n) {
    c = std::cos(0.5 * pi * rest / n);
    s = std::sin(0.5 * pi * rest / n);
  } else {
    c = std::sin(0.5 * pi * (n - rest) / n);
    s = std::cos(0.5 * pi * (n - rest) / n);
  }
  if (rest == 0) {
    c = 1;
    s = 0;
  }
  switch (quadrant) {
    case 0:
      cosine = c;
      sine = s;
      break;
    case 1:
      cosine = -s;
      sine = c;
      break;
    case 2:
      cosine = -c;
      sine = -s;
      break;
    default:
      cosine = s;
      sine = -c;
      break;
  }
}

}  // namespace

Symmetry Symmetry::rotation(int order) {
  require(order >= 2, "a sector needs at least two copies");
  Symmetry s(Kind::rotation, order, 0);
  s.cosine_.resize(static_cast<std::size_t>(2 * order + 1));
  s.sine_.resize(static_cast<std::size_t>(2 * order + 1));
  for (int k = -order; k <= order; ++k) {
    const auto m = static_cast<std::size_t>(k + order);
    cosine_and_sine(k, order, s.cosine_[m], s.sine_[m]);
  }
  return s;
}

double Symmetry::angle() const { return 2 * pi / order(); }

int Symmetry::turns_home(Vec3 p) const {
  if (kind_ == Kind::none) return 0;
  if (kind_ == Kind::translation) return -static_cast<int>(std::floor(p.y / width_));
  // The face phi = 0 belongs to the domain, the face phi = angle to the next copy; close to a face the sign of a
  // coordinate decides, not a rounded angle.
  if (p.y == 0 && p.x >= 0) return 0;
  if (p.y > 0 && turn_vector(p, -1).y < 0) return 0;
  double phi = std::atan2(p.y, p.x);
  if (phi < 0) phi += 2 * pi;
  return residue(-static_cast<int>(std::floor(phi / (2 * pi) * order_)));
}

double Symmetry::distance_to_domain(Vec3 p, int k) const {
  if (kind_ == Kind::translation) {
    const double y = p.y + k * width_;
    return y < 0 ? -y : (y > width_ ? y - width_ : 0);
  }
  if (residue(k) == 0 || kind_ == Kind::none) return 0;
  const double r = std::hypot(p.x, p.y);
  const double phi = std::atan2(p.y, p.x) + k * angle();
  double beyond = std::fmod(phi - angle(), 2 * pi);  // past the face phi = angle
  double before = std::fmod(-phi, 2 * pi);           // short of the face phi = 0
  if (beyond < 0) beyond += 2 * pi;
  if (before < 0) before += 2 * pi;
  const double gap = std::fmin(beyond, before);
  // A copy that rounding puts on the wrong side of a face is at the face.
  if (gap + angle() > 2 * pi) return 0;
  return gap < 0.5 * pi ? r * std::sin(gap) : r;
}

}  // namespace wedge

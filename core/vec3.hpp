// vec3.hpp: three numbers in registers (Vec3) and three arrays in memory (Vec3Array).
//
// Vector3 serves the inner loops: plain arithmetic on three numbers, or on three packs of numbers (pack.hpp).
// Geometry outside the loops uses Eigen.
#pragma once

#include <cmath>

#include "core/array.hpp"

namespace wedge {

template <class Real>
struct Vector3 {
  Real x{}, y{}, z{};
};
using Vec3 = Vector3<double>;

/// A parameter that does not decide what the template is: takes whatever converts to T.
template <class T>
struct Plain {
  using type = T;
};
template <class T>
using plain_t = typename Plain<T>::type;

template <class Real>
inline Vector3<Real> operator+(const Vector3<Real>& a, const Vector3<Real>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class Real>
inline Vector3<Real> operator-(const Vector3<Real>& a, const Vector3<Real>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class Real>
inline Vector3<Real> operator-(const Vector3<Real>& a) {
  return {-a.x, -a.y, -a.z};
}
template <class Real>
inline Vector3<Real> operator*(const plain_t<Real>& s, const Vector3<Real>& a) {
  return {s * a.x, s * a.y, s * a.z};
}
template <class Real>
inline Vector3<Real>& operator+=(Vector3<Real>& a, const plain_t<Vector3<Real>>& b) {
  return a = a + b;
}
template <class Real>
inline Vector3<Real>& operator-=(Vector3<Real>& a, const plain_t<Vector3<Real>>& b) {
  return a = a - b;
}
template <class Real>
inline Real dot(const Vector3<Real>& a, const Vector3<Real>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class Real>
inline Vector3<Real> cross(const Vector3<Real>& a, const Vector3<Real>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class Real>
inline Real norm(const Vector3<Real>& a) {
  using std::sqrt;
  return sqrt(dot(a, a));
}

/// The vector in numbers of another width.
template <class To, class From>
inline Vector3<To> in_width(const Vector3<From>& v) {
  return {static_cast<To>(v.x), static_cast<To>(v.y), static_cast<To>(v.z)};
}

/// A vector field stored as three arrays of equal length.
struct Vec3Array {
  Array<double> x, y, z;

  std::size_t size() const { return x.size(); }
  void resize(std::size_t n) {
    x.resize(n);
    y.resize(n);
    z.resize(n);
  }
  Vec3 get(std::size_t i) const { return {x[i], y[i], z[i]}; }
  void set(std::size_t i, Vec3 v) {
    x[i] = v.x;
    y[i] = v.y;
    z[i] = v.z;
  }
};

}  // namespace wedge

// SPDX-License-Identifier: Zlib
#pragma once

#include <array>
#include <cmath>

#include "cairn/core/export.h"

namespace cairn {

/// A point or direction. `Vec3` (float) is what a tree stores, `Vec3d` is what proofs compute with.
/// Unit and frame are those of whoever holds it.
template <class T>
struct BasicVec3 {
  T x{}, y{}, z{};  ///< coordinates

  constexpr BasicVec3() = default;
  /// From its coordinates.
  constexpr BasicVec3(T xIn, T yIn, T zIn) : x(xIn), y(yIn), z(zIn) {}
  /// Explicit because float <- double rounds.
  template <class U>
  constexpr explicit BasicVec3(const BasicVec3<U>& v)
      : x(static_cast<T>(v.x)), y(static_cast<T>(v.y)), z(static_cast<T>(v.z)) {}

  /// A coordinate by its axis: 0, 1 or 2.
  constexpr T operator[](int axis) const { return axis == 0 ? x : axis == 1 ? y : z; }
  /// The same, to be changed.
  constexpr T& operator[](int axis) { return axis == 0 ? x : axis == 1 ? y : z; }

  /// Adds, coordinate by coordinate.
  constexpr BasicVec3& operator+=(const BasicVec3& o) { return *this = *this + o; }
  /// Subtracts, coordinate by coordinate.
  constexpr BasicVec3& operator-=(const BasicVec3& o) { return *this = *this - o; }
  /// Multiplies by a number.
  constexpr BasicVec3& operator*=(T s) { return *this = *this * s; }

  /// The sum.
  friend constexpr BasicVec3 operator+(const BasicVec3& a, const BasicVec3& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
  }
  /// The difference.
  friend constexpr BasicVec3 operator-(const BasicVec3& a, const BasicVec3& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
  }
  /// The opposite.
  friend constexpr BasicVec3 operator-(const BasicVec3& a) { return {-a.x, -a.y, -a.z}; }
  /// The multiple.
  friend constexpr BasicVec3 operator*(const BasicVec3& a, T s) { return {a.x * s, a.y * s, a.z * s}; }
  /// The multiple.
  friend constexpr BasicVec3 operator*(T s, const BasicVec3& a) { return a * s; }
  /// The multiple by 1 / `s`.
  friend constexpr BasicVec3 operator/(const BasicVec3& a, T s) { return {a.x / s, a.y / s, a.z / s}; }
  friend constexpr bool operator==(const BasicVec3&, const BasicVec3&) = default;
};

/// Single precision: what trees store.
using Vec3 = BasicVec3<float>;
/// Double precision: what proofs compute with.
using Vec3d = BasicVec3<double>;

/// Scalar product.
template <class T>
constexpr T dot(const BasicVec3<T>& a, const BasicVec3<T>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

/// Vector product.
template <class T>
constexpr BasicVec3<T> cross(const BasicVec3<T>& a, const BasicVec3<T>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// Squared length.
template <class T>
constexpr T lengthSq(const BasicVec3<T>& a) {
  return dot(a, a);
}

/// Length.
template <class T>
T length(const BasicVec3<T>& a) {
  return std::sqrt(lengthSq(a));
}

/// Length of the difference of two points.
template <class T>
T distance(const BasicVec3<T>& a, const BasicVec3<T>& b) {
  return length(a - b);
}

/// Precondition: `a` is not zero.
template <class T>
BasicVec3<T> normalized(const BasicVec3<T>& a) {
  return a / length(a);
}

/// Whether no coordinate is NaN or infinite.
template <class T>
bool isFinite(const BasicVec3<T>& a) {
  return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}

/// Row-major 3x3 matrix; `m * v` is the usual product.
template <class T>
struct BasicMat3 {
  /// The unit matrix at first.
  std::array<BasicVec3<T>, 3> rows{BasicVec3<T>{1, 0, 0}, BasicVec3<T>{0, 1, 0}, BasicVec3<T>{0, 0, 1}};

  /// An element, by row and column from 0.
  constexpr T operator()(int row, int column) const { return rows[row][column]; }
  /// The same, to be changed.
  constexpr T& operator()(int row, int column) { return rows[row][column]; }
  /// A column, numbered from 0.
  constexpr BasicVec3<T> column(int c) const { return {rows[0][c], rows[1][c], rows[2][c]}; }

  /// The product with a column vector.
  friend constexpr BasicVec3<T> operator*(const BasicMat3& m, const BasicVec3<T>& v) {
    return {dot(m.rows[0], v), dot(m.rows[1], v), dot(m.rows[2], v)};
  }
  /// The product of two matrices.
  friend constexpr BasicMat3 operator*(const BasicMat3& a, const BasicMat3& b) {
    BasicMat3 r;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) r(i, j) = dot(a.rows[i], b.column(j));
    return r;
  }
  /// Every element times a number.
  friend constexpr BasicMat3 operator*(const BasicMat3& a, T s) {
    return {{a.rows[0] * s, a.rows[1] * s, a.rows[2] * s}};
  }
  friend constexpr bool operator==(const BasicMat3&, const BasicMat3&) = default;
};

/// Rows and columns exchanged: the inverse of a rotation.
template <class T>
constexpr BasicMat3<T> transpose(const BasicMat3<T>& m) {
  return {{m.column(0), m.column(1), m.column(2)}};
}

/// Single precision.
using Mat3 = BasicMat3<float>;
/// Double precision.
using Mat3d = BasicMat3<double>;

}  // namespace cairn

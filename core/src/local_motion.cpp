// SPDX-License-Identifier: Zlib
#include "local_motion.h"

namespace cairn {

namespace {

// It doubles the correct digits; scaled, from any matrix that passes `kMinVolume`.
constexpr int kIterations = 12;
// In norms: a step this small was the last but none, since the next one is its square.
constexpr double kConverged = 1e-7;
// Of a matrix's determinant, in cubes of its norm: below it, what is nearest is left to rounding.
constexpr double kMinVolume = 1e-9;

double normOf(const Mat3d& m) {
  return std::sqrt(lengthSq(m.rows[0]) + lengthSq(m.rows[1]) + lengthSq(m.rows[2]));
}

bool isNear(const Mat3d& a, const Mat3d& b) {
  double sum = 0;
  for (std::size_t row = 0; row < 3; ++row) sum += lengthSq(a.rows[row] - b.rows[row]);
  return sum < kConverged * kConverged;
}

// The determinant times the transpose of the inverse.
Mat3d cofactors(const Mat3d& m) {
  return {{cross(m.rows[1], m.rows[2]), cross(m.rows[2], m.rows[0]), cross(m.rows[0], m.rows[1])}};
}

}  // namespace

Mat3d nearestRotation(const Mat3d& m) {
  const double norm = normOf(m);
  if (!(norm > 0)) return {};
  Mat3d q = m * (1 / norm);
  if (!(dot(q.rows[0], cofactors(q).rows[0]) > kMinVolume)) return {};
  for (int i = 0; i < kIterations; ++i) {
    const Mat3d minors = cofactors(q);
    const double determinant = dot(q.rows[0], minors.rows[0]);
    const double inverse = normOf(minors) / determinant, scale = std::sqrt(inverse / normOf(q));
    const Mat3d last = q;
    for (std::size_t row = 0; row < 3; ++row)
      q.rows[row] = (q.rows[row] * scale + minors.rows[row] * (1 / (determinant * scale))) * 0.5;
    if (isNear(q, last)) break;
  }
  return q;
}

}  // namespace cairn

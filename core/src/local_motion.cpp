// SPDX-License-Identifier: Zlib
#include "local_motion.h"

#include "refit_tuning.h"

namespace cairn {

namespace {

double normOf(const Mat3d& m) {
  return std::sqrt(lengthSq(m.rows[0]) + lengthSq(m.rows[1]) + lengthSq(m.rows[2]));
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
  if (!(dot(q.rows[0], cofactors(q).rows[0]) > refit::kMinVolume)) return {};
  for (int i = 0; i < refit::kIterations; ++i) {
    const Mat3d minors = cofactors(q);
    const double determinant = dot(q.rows[0], minors.rows[0]);
    const double inverse = normOf(minors) / determinant, scale = std::sqrt(inverse / normOf(q));
    for (std::size_t row = 0; row < 3; ++row)
      q.rows[row] = (q.rows[row] * scale + minors.rows[row] * (1 / (determinant * scale))) * 0.5;
  }
  return q;
}

}  // namespace cairn

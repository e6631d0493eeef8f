// SPDX-License-Identifier: Zlib
#include "cairn/core/pose.h"

namespace cairn {

Similarity relativePose(const Pose& to, const Pose& from) {
  const Mat3d worldToTarget = transpose(to.rotation);
  const double scale = from.scale / to.scale;
  const Mat3d linear = worldToTarget * from.rotation * scale;
  const Vec3d translation = worldToTarget * (from.translation - to.translation) / to.scale;

  Similarity s;
  for (int row = 0; row < 3; ++row) s.linear.rows[row] = Vec3(linear.rows[row]);
  s.translation = Vec3(translation);
  s.scale = static_cast<float>(scale);
  return s;
}

}  // namespace cairn

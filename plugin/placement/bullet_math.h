// SPDX-License-Identifier: Zlib
#pragma once

#include <LinearMath/btTransform.h>

#include "cairn/core/pose.h"
#include "cairn/core/vec3.h"

namespace cairn::bullet {

inline Vec3d toVec3d(const btVector3& v) {
  return {double(v.x()), double(v.y()), double(v.z())};
}
inline Vec3 toVec3(const btVector3& v) {
  return {float(v.x()), float(v.y()), float(v.z())};
}

template <class T>
btVector3 toBullet(const BasicVec3<T>& v) {
  return {btScalar(v.x), btScalar(v.y), btScalar(v.z)};
}

inline btVector3 toBtVector3(const Vec3& v) {
  return {btScalar(v.x), btScalar(v.y), btScalar(v.z)};
}

inline Mat3 toMat3(const btMatrix3x3& m) {
  return {{toVec3(m[0]), toVec3(m[1]), toVec3(m[2])}};
}

inline Mat3d toMat3d(const btMatrix3x3& m) {
  return {{toVec3d(m[0]), toVec3d(m[1]), toVec3d(m[2])}};
}

inline btMatrix3x3 toBullet(const Mat3d& m) {
  return {btScalar(m(0, 0)), btScalar(m(0, 1)), btScalar(m(0, 2)), btScalar(m(1, 0)), btScalar(m(1, 1)),
          btScalar(m(1, 2)), btScalar(m(2, 0)), btScalar(m(2, 1)), btScalar(m(2, 2))};
}

/// The pose rounded to float, for points near its own origin.
inline Similarity toSimilarity(const Pose& pose) {
  const Mat3d linear = pose.rotation * pose.scale;
  return {{{Vec3(linear.rows[0]), Vec3(linear.rows[1]), Vec3(linear.rows[2])}},
          Vec3(pose.translation),
          static_cast<float>(pose.scale)};
}

}  // namespace cairn::bullet

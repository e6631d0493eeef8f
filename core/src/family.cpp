// SPDX-License-Identifier: Zlib
//
// Compiled once per instruction set by Highway; the best one the machine has is chosen when the program runs.
#include "cairn/core/family.h"

#include "vector_targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "family.cpp"
#include <hwy/foreach_target.h>  // must come before highway.h

#include <hwy/highway.h>

#include "family-inl.h"

HWY_BEFORE_NAMESPACE();
namespace cairn::HWY_NAMESPACE {

std::uint32_t overlapOnce(const Family& family, const Sphere& s) {
  return overlapLanes(family, inAllLanes(s));
}

std::uint32_t supportLanes(const SupportBlock& block, const Vec3& direction) {
  return farthestLane(block, direction);
}

const char* targetName() {
  return hwy::TargetName(HWY_TARGET);
}

}  // namespace cairn::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace cairn {

HWY_EXPORT(overlapOnce);
HWY_EXPORT(supportLanes);
HWY_EXPORT(targetName);

std::uint32_t overlap(const Family& family, const Sphere& s) {
  return HWY_DYNAMIC_DISPATCH(overlapOnce)(family, s);
}

std::uint32_t supportLane(const SupportBlock& block, const Vec3& direction) {
  return HWY_DYNAMIC_DISPATCH(supportLanes)(block, direction);
}

const char* simdTargetName() {
  return HWY_DYNAMIC_DISPATCH(targetName)();
}

std::uint32_t overlapScalar(const Family& family, const Sphere& s) {
  std::uint32_t bits = 0;
  for (std::uint32_t lane = 0; lane < kFamilyWidth; ++lane) {
    const float dx = family.x[lane] - s.center.x;
    const float dy = family.y[lane] - s.center.y;
    const float dz = family.z[lane] - s.center.z;
    const float reach = family.radius[lane] + s.radius;
    const float distanceSq = dx * dx + dy * dy + dz * dz;
    bits |= static_cast<std::uint32_t>(distanceSq <= reach * reach) << lane;
  }
  return bits;
}

std::uint32_t supportLaneScalar(const SupportBlock& block, const Vec3& direction) {
  std::uint32_t bestLane = 0;
  float best = dot(block.point(0), direction);
  for (std::uint32_t lane = 1; lane < SupportBlock::kWidth; ++lane) {
    const float projection = dot(block.point(lane), direction);
    if (projection > best) {
      best = projection;
      bestLane = lane;
    }
  }
  return bestLane;
}

}  // namespace cairn
#endif  // HWY_ONCE

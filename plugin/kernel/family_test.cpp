// SPDX-License-Identifier: Zlib
#include "kernel/family_test.h"

#include <limits>

// The instruction sets Highway compiles for, as in the core.
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernel/family_test.cpp"
#include <hwy/foreach_target.h>  // must come before highway.h

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace cairn::bullet::HWY_NAMESPACE {
namespace {
namespace hn = hwy::HWY_NAMESPACE;
using FamilyTag = hn::CappedTag<float, PatchFamily::kWidth>;
}  // namespace

// Each box grows as `NearLimits::around` grows a box; the margin is how far the other box is outside.
void testBoxes(const PatchFamily& family, const PlacedBox& box, const NearLimits& limits, FamilyTest& result) {
  const FamilyTag d;
  const auto zero = hn::Zero(d), maxSeparation = hn::Set(d, limits.maxSeparation), deep = hn::Set(d, limits.depth),
             beside = hn::Set(d, limits.besideDeep);
  result.near = 0;
  const auto infinity = hn::Set(d, std::numeric_limits<float>::infinity());
  auto nearest = infinity;
  for (std::uint32_t at = 0; at < PatchFamily::kWidth; at += static_cast<std::uint32_t>(hn::Lanes(d))) {
    auto margin = hn::Neg(infinity), minSeparation = margin;
    for (int axis = 0; axis < 3; ++axis) {
      const auto low = hn::LoadU(d, family.normalLower[axis] + at), high = hn::LoadU(d, family.normalUpper[axis] + at);
      const auto lower = hn::LoadU(d, family.lower[axis] + at), upper = hn::LoadU(d, family.upper[axis] + at);
      const auto below = hn::Sub(lower, hn::Set(d, box.middle[axis] + box.half[axis])),
                 above = hn::Sub(hn::Set(d, box.middle[axis] - box.half[axis]), upper);
      const auto downwards = hn::Min(zero, hn::Min(hn::Mul(maxSeparation, low), hn::Mul(deep, high)));
      const auto upwards = hn::Max(zero, hn::Max(hn::Mul(maxSeparation, high), hn::Mul(deep, low)));
      margin = hn::Max(margin, hn::Max(hn::Add(below, downwards), hn::Sub(above, upwards)));
      minSeparation = hn::Max(minSeparation, hn::Max(below, above));
    }
    margin = hn::Sub(margin, beside);
    hn::StoreU(margin, d, result.margin + at);
    const auto isNear = hn::Le(margin, hn::Set(d, limits.skin));
    std::uint8_t bytes[8] = {};
    hn::StoreMaskBits(d, isNear, bytes);
    result.near |= static_cast<std::uint32_t>(bytes[0]) << at;
    nearest = hn::Min(nearest, hn::IfThenElse(isNear, infinity, minSeparation));
  }
  result.minSeparation = hn::GetLane(hn::MinOfLanes(d, nearest));
}

}  // namespace cairn::bullet::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace cairn::bullet {

HWY_EXPORT(testBoxes);

FamilyTest testFamily(const PatchFamily& family, const PlacedBox& box, const NearLimits& limits) {
  FamilyTest result;
  HWY_DYNAMIC_DISPATCH(testBoxes)(family, box, limits, result);
  return result;
}

}  // namespace cairn::bullet
#endif  // HWY_ONCE

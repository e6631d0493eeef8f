// SPDX-License-Identifier: Zlib
//
// The family test in vectors, compiled once per instruction set: include it after highway.h, inside no namespace. It is
// a header so that a whole traversal, and whatever is measured against it, can have it inlined.
#if defined(CAIRN_FAMILY_INL_H) == defined(HWY_TARGET_TOGGLE)  // Highway's include guard, once per target
#ifdef CAIRN_FAMILY_INL_H
#undef CAIRN_FAMILY_INL_H
#else
#define CAIRN_FAMILY_INL_H
#endif

#include <hwy/highway.h>

#include "cairn/core/family.h"

HWY_BEFORE_NAMESPACE();
namespace cairn::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Lanes of a family and of what goes with it; as many a vector as the target has, eight at most.
using FamilyTag = hn::CappedTag<float, kFamilyWidth>;
using FamilyVec = hn::Vec<FamilyTag>;

/// One sphere, each number in all lanes.
struct SphereLanes {
  FamilyVec x, y, z, radius;
};

HWY_INLINE SphereLanes inAllLanes(const Sphere& s) {
  const FamilyTag d;
  return {hn::Set(d, s.center.x), hn::Set(d, s.center.y), hn::Set(d, s.center.z), hn::Set(d, s.radius)};
}

/// See `overlap`. Products and sums stay separate (no fused multiply-add) and in one order, so that every target and
/// the scalar twin give the same bits.
HWY_INLINE std::uint32_t overlapLanes(const Family& family, const SphereLanes& s) {
  const FamilyTag d;
  std::uint32_t bits = 0;
  for (std::uint32_t lane = 0; lane < kFamilyWidth; lane += hn::Lanes(d)) {
    const auto dx = hn::Sub(s.x, hn::Load(d, family.x + lane));
    const auto dy = hn::Sub(s.y, hn::Load(d, family.y + lane));
    const auto dz = hn::Sub(s.z, hn::Load(d, family.z + lane));
    const auto reach = hn::Add(hn::Load(d, family.radius + lane), s.radius);
    const auto distanceSq = hn::Add(hn::Add(hn::Mul(dx, dx), hn::Mul(dy, dy)), hn::Mul(dz, dz));
    std::uint8_t mask[8] = {};
    hn::StoreMaskBits(d, hn::Le(distanceSq, hn::Mul(reach, reach)), mask);
    bits |= static_cast<std::uint32_t>(mask[0]) << lane;
  }
  return bits;
}

}  // namespace cairn::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard

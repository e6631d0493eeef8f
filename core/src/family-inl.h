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

#include <bit>

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

/// A bit per lane, from the lowest on.
template <class D, class M>
HWY_INLINE std::uint32_t bitsOf(D d, M mask) {
  std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(d, mask, bytes);
  return hn::MaxLanes(d) <= 8 ? bytes[0] : bytes[0] | static_cast<std::uint32_t>(bytes[1]) << 8;
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
    bits |= bitsOf(d, hn::Le(distanceSq, hn::Mul(reach, reach))) << lane;
  }
  return bits;
}

/// See `supportLane`. Which half of a block the lane is in is as good as random: no branch depends on it.
HWY_INLINE std::uint32_t farthestLane(const SupportBlock& block, const Vec3& direction) {
  const hn::CappedTag<float, SupportBlock::kWidth> d;
  const auto x = hn::Set(d, direction.x);
  const auto y = hn::Set(d, direction.y);
  const auto z = hn::Set(d, direction.z);
  const auto project = [&](std::uint32_t lane) HWY_ATTR {
    return hn::Add(hn::Add(hn::Mul(hn::Load(d, block.x + lane), x), hn::Mul(hn::Load(d, block.y + lane), y)),
                   hn::Mul(hn::Load(d, block.z + lane), z));
  };

  auto best = project(0);
  for (std::uint32_t lane = hn::Lanes(d); lane < SupportBlock::kWidth; lane += hn::Lanes(d))
    best = hn::Max(best, project(lane));
  best = hn::MaxOfLanes(d, best);
  std::uint32_t farthest = 0;
  for (std::uint32_t lane = 0; lane < SupportBlock::kWidth; lane += hn::Lanes(d))
    farthest |= bitsOf(d, hn::Eq(project(lane), best)) << lane;
  // Nothing is the farthest where numbers overflow.
  return static_cast<std::uint32_t>(std::countr_zero(farthest | 1U << SupportBlock::kWidth)) % SupportBlock::kWidth;
}

}  // namespace cairn::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard

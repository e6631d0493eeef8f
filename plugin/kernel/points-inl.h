// SPDX-License-Identifier: Zlib
//
// Points of a patch in columns, one per lane. Compiled once per instruction set: include it after highway.h, outside
// any namespace. Products and sums stay separate and in the order of `Vec3`'s. So every target and the scalar code give
// the same bits.
// same bits.
#if defined(CAIRN_POINTS_INL_H) == defined(HWY_TARGET_TOGGLE)  // Highway's include guard, once per target
#ifdef CAIRN_POINTS_INL_H
#undef CAIRN_POINTS_INL_H
#else
#define CAIRN_POINTS_INL_H
#endif

#include <hwy/highway.h>

#include <bit>
#include <cstdint>

#include "kernel/placed_patches.h"

HWY_BEFORE_NAMESPACE();
namespace cairn::bullet::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::CappedTag<float, SurfacePatch::kBatch>;
using Lanes = hn::Vec<Tag>;

struct Points {
  Lanes x, y, z;
};

HWY_INLINE Points all(const Vec3& p) {
  const Tag d;
  return {hn::Set(d, p.x), hn::Set(d, p.y), hn::Set(d, p.z)};
}

HWY_INLINE Points load(const float* columns, std::uint32_t stride, std::uint32_t at) {
  const Tag d;
  return {hn::LoadU(d, columns + at), hn::LoadU(d, columns + stride + at), hn::LoadU(d, columns + 2 * stride + at)};
}

HWY_INLINE Lanes dotOf(const Points& a, const Points& b) {
  return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}

HWY_INLINE Points minus(const Points& a, const Points& b) {
  return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}

HWY_INLINE Points crossOf(const Points& a, const Points& b) {
  return {hn::Sub(hn::Mul(a.y, b.z), hn::Mul(a.z, b.y)), hn::Sub(hn::Mul(a.z, b.x), hn::Mul(a.x, b.z)),
          hn::Sub(hn::Mul(a.x, b.y), hn::Mul(a.y, b.x))};
}

HWY_INLINE std::uint32_t bitsOf(hn::Mask<Tag> mask) {
  std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(Tag(), mask, bytes);
  return bytes[0];
}

// Converts margins from the surface's unit to world lengths.
HWY_INLINE Lanes worldLengths(Lanes margins, const PlacedPatches& side) {
  return hn::Mul(margins, hn::Set(Tag(), side.scale()));
}

// Calls `add` with the index and margin of each lane whose bit is set.
template <class Add>
HWY_INLINE void addEach(std::uint32_t bits, std::uint32_t at, Lanes margins, const Add& add) {
  if (bits == 0) return;
  float margin[SurfacePatch::kBatch];
  hn::StoreU(margins, Tag(), margin);
  for (; bits != 0; bits &= bits - 1) {
    const auto lane = static_cast<std::uint32_t>(std::countr_zero(bits));
    add(at + lane, margin[lane]);
  }
}

}  // namespace
}  // namespace cairn::bullet::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAIRN_POINTS_INL_H

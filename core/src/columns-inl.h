// SPDX-License-Identifier: Zlib
//
// Nodes and points in columns, one a lane, compiled once per instruction set: include it after highway.h, inside no
// namespace. Products and sums stay separate and in the order of `Vec3`'s and `Similarity`'s, so that every target and
// the scalar code give the same bits.
#if defined(CAIRN_COLUMNS_INL_H) == defined(HWY_TARGET_TOGGLE)  // Highway's include guard, once per target
#ifdef CAIRN_COLUMNS_INL_H
#undef CAIRN_COLUMNS_INL_H
#else
#define CAIRN_COLUMNS_INL_H
#endif

#include <hwy/highway.h>

#include "cairn/core/pose.h"
#include "family-inl.h"

HWY_BEFORE_NAMESPACE();
namespace cairn::HWY_NAMESPACE {

struct Columns {
  FamilyVec x, y, z, w;
};

/// Points or directions.
struct PointColumns {
  FamilyVec x, y, z;
};

/// Four numbers of each of as many nodes as there are lanes, in columns. `offset` is 0 for the sphere, 4 for the rest.
template <class NodeOfLane>
HWY_INLINE Columns loadColumns(NodeOfLane nodeOfLane, std::size_t offset) {
  const FamilyTag d;
  const auto numbers = [&](std::uint32_t lane)
                           HWY_ATTR { return reinterpret_cast<const float*>(nodeOfLane(lane)) + offset; };
#if HWY_TARGET == HWY_SCALAR
  const float* const row = numbers(0);
  return {hn::Set(d, row[0]), hn::Set(d, row[1]), hn::Set(d, row[2]), hn::Set(d, row[3])};
#else
  const auto row = [&](std::uint32_t i) HWY_ATTR {
#if HWY_TARGET <= HWY_AVX2
    const hn::Half<FamilyTag> half;
    return hn::Combine(d, hn::Load(half, numbers(i + 4)), hn::Load(half, numbers(i)));
#else
    return hn::Load(d, numbers(i));
#endif
  };
  const auto row0 = row(0), row1 = row(1), row2 = row(2), row3 = row(3);
  const auto lower02 = hn::InterleaveLower(d, row0, row2), lower13 = hn::InterleaveLower(d, row1, row3);
  const auto upper02 = hn::InterleaveUpper(d, row0, row2), upper13 = hn::InterleaveUpper(d, row1, row3);
  return {hn::InterleaveLower(d, lower02, lower13), hn::InterleaveUpper(d, lower02, lower13),
          hn::InterleaveLower(d, upper02, upper13), hn::InterleaveUpper(d, upper02, upper13)};
#endif
}

HWY_INLINE PointColumns plus(const PointColumns& a, const PointColumns& b) {
  return {hn::Add(a.x, b.x), hn::Add(a.y, b.y), hn::Add(a.z, b.z)};
}
HWY_INLINE PointColumns minus(const PointColumns& a, const PointColumns& b) {
  return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}
HWY_INLINE PointColumns times(const PointColumns& a, FamilyVec s) {
  return {hn::Mul(a.x, s), hn::Mul(a.y, s), hn::Mul(a.z, s)};
}
HWY_INLINE FamilyVec dotColumns(const PointColumns& a, const PointColumns& b) {
  return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}

HWY_INLINE PointColumns turned(const Mat3& m, const PointColumns& p) {
  const FamilyTag d;
  const auto coordinate = [&](std::size_t row) HWY_ATTR {
    const Vec3& r = m.rows[row];
    return dotColumns({hn::Set(d, r.x), hn::Set(d, r.y), hn::Set(d, r.z)}, p);
  };
  return {coordinate(0), coordinate(1), coordinate(2)};
}

HWY_INLINE PointColumns moved(const Similarity& to, const PointColumns& p) {
  const FamilyTag d;
  const Vec3& t = to.translation;
  return plus(turned(to.linear, p), {hn::Set(d, t.x), hn::Set(d, t.y), hn::Set(d, t.z)});
}

}  // namespace cairn::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard

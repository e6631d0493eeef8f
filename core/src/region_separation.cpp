// SPDX-License-Identifier: Zlib
//
// Many pairs are measured together because one alone is a chain of waiting: a root, divisions, two searches, each of
// which needs what came before. Compiled once per instruction set by Highway.
#include "cairn/core/region_separation.h"

#include <algorithm>
#include <limits>

#include "vector_targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "region_separation.cpp"
#include <hwy/foreach_target.h>  // must come before highway.h

#include <hwy/highway.h>

#include "columns-inl.h"
#include "family-inl.h"

HWY_BEFORE_NAMESPACE();
namespace cairn::HWY_NAMESPACE {

/// One number for each pair of a batch, in memory.
struct alignas(64) Row {
  float of[RegionSeparations::kSize];
};

/// A point or direction for each pair of a batch.
struct PointRows {
  Row x, y, z;

  HWY_INLINE void store(std::size_t first, const PointColumns& p) {
    const FamilyTag d;
    hn::Store(p.x, d, x.of + first);
    hn::Store(p.y, d, y.of + first);
    hn::Store(p.z, d, z.of + first);
  }
  HWY_INLINE PointColumns load(std::size_t first) const {
    const FamilyTag d;
    return {hn::Load(d, x.of + first), hn::Load(d, y.of + first), hn::Load(d, z.of + first)};
  }
};

/// Data of a batch that passes from one part to the next.
struct Measuring {
  PointRows normal, centerB;
  Row radiusA, radiusB;
  PointRows alongA, alongB;  // in the trees' frames: the directions that are asked, then the points that are found
};

struct SphereColumns {
  PointColumns center;
  FamilyVec radius;
};

/// The spheres of as many nodes as there are lanes, in the pair frame.
template <class NodeOfLane>
HWY_INLINE SphereColumns spheresOf(const PlacedRegions& regions, NodeOfLane nodeOfLane) {
  const TraversalNode* const nodes = regions.tree.answeringNodes().data();
  const Columns s = loadColumns([&](std::uint32_t lane) HWY_ATTR { return nodes + nodeOfLane(lane); }, 0);
  return {moved(regions.toPair, {s.x, s.y, s.z}), hn::Mul(s.w, hn::Set(FamilyTag(), regions.toPair.scale))};
}

/// The spheres and normals of as many pairs as there are lanes, from `first` on. A bit for each that is not blurred.
HWY_INLINE std::uint32_t lookAlong(const PlacedRegions& a, const PlacedRegions& b, const NodePair* pairs,
                                   std::uint32_t first, Measuring& m) {
  const FamilyTag d;
  const SphereColumns sphereA = spheresOf(a, [&](std::uint32_t i) HWY_ATTR { return pairs[first + i].a; });
  const SphereColumns sphereB = spheresOf(b, [&](std::uint32_t i) HWY_ATTR { return pairs[first + i].b; });
  const PointColumns line = minus(sphereA.center, sphereB.center);
  const auto squared = dotColumns(line, line);
  const auto isClear = hn::Ge(squared, hn::Set(d, std::numeric_limits<float>::min()));
  const auto length = hn::Sqrt(hn::IfThenElse(isClear, squared, hn::Set(d, 1.0F)));
  const PointColumns normal{hn::Div(line.x, length), hn::Div(line.y, length), hn::Div(line.z, length)};
  m.normal.store(first, normal);
  m.centerB.store(first, sphereB.center);
  hn::Store(sphereA.radius, d, m.radiusA.of + first);
  hn::Store(sphereB.radius, d, m.radiusB.of + first);
  m.alongA.store(first, turned(a.axesFromPair, {hn::Neg(normal.x), hn::Neg(normal.y), hn::Neg(normal.z)}));
  m.alongB.store(first, turned(b.axesFromPair, normal));
  return bitsOf(d, isClear);
}

/// Puts the block's point that is farthest along direction `i` in its place.
HWY_INLINE void findSupport(const SupportBlock& block, PointRows& along, std::size_t i) {
  const std::uint32_t lane = farthestLane(block, {along.x.of[i], along.y.of[i], along.z.of[i]});
  along.x.of[i] = block.x[lane];
  along.y.of[i] = block.y[lane];
  along.z.of[i] = block.z[lane];
}

/// As `measureSeparation`, of as many pairs as there are lanes. A bit for each that is near.
HWY_INLINE std::uint32_t measureBetween(const PlacedRegions& a, const PlacedRegions& b, const SeparationLimits& limits,
                                        std::uint32_t first, const Measuring& m, RegionSeparations& separations) {
  const FamilyTag d;
  const auto margins = hn::Set(d, limits.margins);
  const auto radiusA = hn::Load(d, m.radiusA.of + first), radiusB = hn::Load(d, m.radiusB.of + first);
  const PointColumns normal = m.normal.load(first);
  const PointColumns onA = moved(a.toPair, m.alongA.load(first)), onB = moved(b.toPair, m.alongB.load(first));
  const auto bound = hn::Sub(hn::Sub(dotColumns(normal, minus(onA, m.centerB.load(first))), radiusB), margins);
  const auto isBeyond = hn::Ge(bound, hn::Set(d, limits.atMost));
  const PointColumns apart = minus(onA, onB);
  const auto separation = hn::Sub(dotColumns(normal, apart), margins);
  const auto isSeparated = hn::Or(isBeyond, hn::Ge(separation, hn::Set(d, limits.reach)));

  const auto squareA = hn::Mul(radiusA, radiusA), squareB = hn::Mul(radiusB, radiusB);
  const auto weightA = hn::Div(squareB, hn::IfThenElse(isSeparated, hn::Set(d, 1.0F), hn::Add(squareA, squareB)));
  const PointColumns where = plus(onB, times(apart, weightA));
  const auto middle = hn::Mul(hn::Set(d, 0.5F), dotColumns(normal, plus(onA, onB)));
  const PointColumns position = plus(where, times(normal, hn::Sub(middle, dotColumns(normal, where))));

  hn::Store(normal.x, d, separations.normalX + first);
  hn::Store(normal.y, d, separations.normalY + first);
  hn::Store(normal.z, d, separations.normalZ + first);
  hn::Store(hn::IfThenElse(isBeyond, bound, separation), d, separations.separation + first);
  hn::Store(position.x, d, separations.x + first);
  hn::Store(position.y, d, separations.y + first);
  hn::Store(position.z, d, separations.z + first);
  return bitsOf(d, hn::Not(isSeparated));
}

/// Part by part, so that whatever waits in one pair does not keep the others waiting. B's points are looked for even
/// where A's say enough: to wait for those would take longer.
void measureBatch(const PlacedRegions& a, const PlacedRegions& b, const NodePair* pairs, std::uint32_t count,
                  const SeparationLimits& limits, RegionSeparations& separations) {
  const auto lanes = static_cast<std::uint32_t>(hn::Lanes(FamilyTag()));
  NodePair copy[RegionSeparations::kSize];
  if (count % lanes != 0) {
    std::copy_n(pairs, count, copy);
    std::fill(copy + count, copy + RegionSeparations::kSize, pairs[0]);
    pairs = copy;
  }
  Measuring m;
  std::uint32_t clear = 0, close = 0;
  for (std::uint32_t first = 0; first < count; first += lanes) clear |= lookAlong(a, b, pairs, first, m) << first;
  for (std::uint32_t i = 0; i < count; ++i) {
    findSupport(a.tree.support(pairs[i].a), m.alongA, i);
    findSupport(b.tree.support(pairs[i].b), m.alongB, i);
  }
  for (std::uint32_t first = 0; first < count; first += lanes)
    close |= measureBetween(a, b, limits, first, m, separations) << first;
  const std::uint32_t living = (1U << count) - 1;
  separations.nearPairs = close & clear & living;
  separations.blurredPairs = ~clear & living;
}

}  // namespace cairn::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace cairn {

HWY_EXPORT(measureBatch);

void measureSeparations(const PlacedRegions& a, const PlacedRegions& b, std::span<const NodePair> pairs,
                        const SeparationLimits& limits, RegionSeparations& separations) {
  HWY_DYNAMIC_DISPATCH(measureBatch)(a, b, pairs.data(), static_cast<std::uint32_t>(pairs.size()), limits, separations);
}

RegionSeparation measureSeparation(const PlacedRegions& a, const PlacedRegions& b, const NodePair& pair,
                                   const Vec3& normal, const SeparationLimits& limits) {
  const Sphere sphereA = a.sphere(pair.a), sphereB = b.sphere(pair.b);
  const Vec3 onA = a.support(pair.a, -normal);
  // No point of B's region lies higher than the top of its ball: often that says enough.
  const float bound = dot(normal, onA - sphereB.center) - sphereB.radius - limits.margins;
  if (bound >= limits.atMost) return {bound, {}, false};
  const Vec3 onB = b.support(pair.b, normal);
  const float separation = dot(normal, onA - onB) - limits.margins;
  if (separation >= limits.reach) return {separation, {}, false};
  // The smaller region knows better where the contact is: on a flat one, any point may be extreme.
  const float squareA = sphereA.radius * sphereA.radius, squareB = sphereB.radius * sphereB.radius;
  const float weightA = squareB / (squareA + squareB);
  const Vec3 where = onB + (onA - onB) * weightA;
  const float middle = 0.5F * dot(normal, onA + onB);
  return {separation, where + normal * (middle - dot(normal, where)), true};
}

}  // namespace cairn
#endif  // HWY_ONCE

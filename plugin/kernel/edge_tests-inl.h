// SPDX-License-Identifier: Zlib
//
// Finds the convex edges of a patch that may touch an edge of another patch. Compiled once per instruction set: include
// it after highway.h, outside any namespace.
#if defined(CAIRN_EDGE_TESTS_INL_H) == defined(HWY_TARGET_TOGGLE)  // Highway's include guard, once per target
#ifdef CAIRN_EDGE_TESTS_INL_H
#undef CAIRN_EDGE_TESTS_INL_H
#else
#define CAIRN_EDGE_TESTS_INL_H
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <limits>

#include "kernel/placed_patches.h"
#include "kernel/points-inl.h"

HWY_BEFORE_NAMESPACE();
namespace cairn::bullet::HWY_NAMESPACE {
namespace {

HWY_INLINE hn::Mask<Tag> areBoxesNear(const Points& p, const Points& q, const Box& box) {
  const Points lower = all(box.lower), upper = all(box.upper);
  const auto onAxis = [&](Lanes u, Lanes v, Lanes low, Lanes high)
                          HWY_ATTR { return hn::And(hn::Le(hn::Min(u, v), high), hn::Ge(hn::Max(u, v), low)); };
  return hn::And(onAxis(p.x, q.x, lower.x, upper.x),
                 hn::And(onAxis(p.y, q.y, lower.y, upper.y), onAxis(p.z, q.z, lower.z, upper.z)));
}

HWY_INLINE Lanes clamped(Lanes v) {
  const Tag d;
  return hn::Max(hn::Zero(d), hn::Min(v, hn::Set(d, 1.0F)));
}

// The vector between the nearest points of two edges. `between` goes from the second edge's first end to the first
// edge's. For parallel edges, any pair of nearest places serves.
HWY_INLINE Points nearestOf(const Points& between, const Points& way, const Points& wayB, Lanes lengthSqA,
                            Lanes lengthSqB) {
  const Tag d;
  const auto tiny = hn::Set(d, std::numeric_limits<float>::min());
  const auto ab = dotOf(way, wayB), da = dotOf(way, between), db = dotOf(wayB, between);
  const auto det = hn::Max(hn::Sub(hn::Mul(lengthSqA, lengthSqB), hn::Mul(ab, ab)), tiny);
  const auto first = clamped(hn::Div(hn::Sub(hn::Mul(ab, db), hn::Mul(lengthSqB, da)), det));
  const auto onB = clamped(hn::Div(hn::Add(hn::Mul(ab, first), db), hn::Max(lengthSqB, tiny)));
  const auto onA = clamped(hn::Div(hn::Sub(hn::Mul(ab, onB), da), hn::Max(lengthSqA, tiny)));
  return {hn::Sub(hn::Add(between.x, hn::Mul(way.x, onA)), hn::Mul(wayB.x, onB)),
          hn::Sub(hn::Add(between.y, hn::Mul(way.y, onA)), hn::Mul(wayB.y, onB)),
          hn::Sub(hn::Add(between.z, hn::Mul(way.z, onA)), hn::Mul(wayB.z, onB))};
}

// How far beyond their ends the lines of two edges are nearest: the larger of the two overshoots, negative if both are
// within. Precondition: not parallel.
HWY_INLINE Lanes beyondEnds(const Points& between, const Points& way, const Points& wayB, Lanes lengthSqA,
                            Lanes lengthSqB) {
  const auto ab = dotOf(way, wayB), da = dotOf(way, between), db = dotOf(wayB, between);
  const auto det = hn::Sub(hn::Mul(lengthSqA, lengthSqB), hn::Mul(ab, ab));
  const auto onA = hn::Sub(hn::Mul(ab, db), hn::Mul(lengthSqB, da));
  const auto onB = hn::Sub(hn::Mul(lengthSqA, db), hn::Mul(ab, da));
  // Lengths along the edges, times `det`.
  const auto ofA = hn::Mul(hn::Max(hn::Neg(onA), hn::Sub(onA, det)), hn::Sqrt(lengthSqA));
  const auto ofB = hn::Mul(hn::Max(hn::Neg(onB), hn::Sub(onB, det)), hn::Sqrt(lengthSqB));
  return hn::Div(hn::Max(ofA, ofB), det);
}

// Tests an edge of A against B's convex edges in `nearEdges`. Adds those near enough for a contact that may face each
// other once the bodies have turned by `turn`.
template <class Add>
HWY_INLINE void edgeOnEdges(const Vec3& from, const Vec3& to, const Vec3& outwardOfA, const SurfacePatch& edges,
                            std::uint32_t nearEdges, const PlacedPatches& side, float turn, const Add& add) {
  const Tag d;
  const NearLimits& limits = side.limits();
  const std::uint32_t stride = SurfacePatch::padded(edges.convexEdges);
  const float ahead = limits.maxSeparation + limits.besideDeep,
              around = std::max(limits.maxSeparation, -limits.depth) + limits.besideDeep;
  const float grown = around + limits.skin;
  Box box{from, from};
  box.add(to);
  box = box.grown(grown);
  const Points p = all(from), way = all(to - from), outwardA = all(outwardOfA);
  const auto lengthSqA = dotOf(way, way);
  for (std::uint32_t at = 0; at < stride; at += static_cast<std::uint32_t>(hn::Lanes(d))) {
    const std::uint32_t nearHere = nearEdges >> at & ((1U << hn::Lanes(d)) - 1);
    if (nearHere == 0) continue;
    const Points r = load(edges.edgeColumns, stride, at), s = load(edges.edgeColumns + 3 * stride, stride, at);
    auto mask = areBoxesNear(r, s, box);
    if ((bitsOf(mask) & nearHere) == 0) continue;
    const Points wayB = minus(s, r), across = crossOf(way, wayB);
    const auto lengthSqB = dotOf(wayB, wayB), lengths = hn::Sqrt(hn::Mul(lengthSqA, lengthSqB));
    const auto norm = hn::Sqrt(dotOf(across, across));
    const auto slack = hn::Mul(hn::Set(d, turn), hn::Add(norm, lengths));
    const auto alongA = dotOf(across, outwardA),
               alongB = dotOf(across, load(edges.edgeColumns + 6 * stride, stride, at));
    const auto up = hn::And(hn::Ge(alongB, hn::Neg(slack)), hn::Le(alongA, slack));
    const auto down = hn::And(hn::Le(alongB, slack), hn::Ge(alongA, hn::Neg(slack)));
    mask = hn::And(mask, hn::Or(up, down));
    if ((bitsOf(mask) & nearHere) == 0) continue;
    const Points minSeparation = nearestOf(minus(p, r), way, wayB, lengthSqA, lengthSqB);
    const auto separation = hn::Sqrt(dotOf(minSeparation, minSeparation)), upwards = dotOf(minSeparation, across);
    // The common normal of two edges that are not nearly parallel turns by at most a quarter radian within the skin. So
    // a pair clearly in front stays in front, and the place where the lines pass each other moves little.
    const auto isClear = hn::Gt(norm, hn::Mul(hn::Set(d, 4 * turn), lengths));
    const auto height = hn::IfThenElse(hn::Lt(alongB, alongA), hn::Neg(upwards), upwards);
    const auto isInFront = hn::And(hn::Gt(height, hn::Mul(hn::Set(d, 0.5F), hn::Mul(norm, separation))), isClear);
    auto margin = hn::Sub(separation, hn::IfThenElse(isInFront, hn::Set(d, ahead), hn::Set(d, around)));
    const auto cosecant = hn::Div(lengths, hn::Max(norm, hn::Set(d, std::numeric_limits<float>::min())));
    const auto turned = hn::Mul(hn::Set(d, 4 * grown * turn), cosecant);
    const auto beyond = hn::Sub(beyondEnds(minus(p, r), way, wayB, lengthSqA, lengthSqB),
                                hn::Add(hn::Set(d, limits.besideDeep), turned));
    const auto passing = hn::Div(beyond, hn::Add(hn::Mul(hn::Set(d, 4.0F), cosecant), hn::Set(d, 1.0F)));
    margin = hn::IfThenElse(isClear, hn::Max(margin, passing), margin);
    mask = hn::And(mask, hn::Le(margin, hn::Set(d, limits.skin)));
    addEach(bitsOf(mask) & nearHere, at, worldLengths(margin, side), add);
  }
}

}  // namespace
}  // namespace cairn::bullet::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAIRN_EDGE_TESTS_INL_H

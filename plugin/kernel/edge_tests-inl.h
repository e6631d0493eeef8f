// SPDX-License-Identifier: Zlib
//
// Which convex edges of a patch may touch an edge of another, compiled once per instruction set: include it after
// highway.h, inside no namespace.
#if defined(CAIRN_EDGE_TESTS_INL_H) == defined(HWY_TARGET_TOGGLE)  // Highway's include guard, once per target
#ifdef CAIRN_EDGE_TESTS_INL_H
#undef CAIRN_EDGE_TESTS_INL_H
#else
#define CAIRN_EDGE_TESTS_INL_H
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <limits>

#include "kernel/contact_tuning.h"
#include "kernel/near_box.h"
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

// From one edge to another where they are nearest; `between`: from the second's first end to the first's. Where they
// are parallel any place along them does.
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

// Whether both edges' lines are nearest no farther beyond their ends.
HWY_INLINE hn::Mask<Tag> passesWithin(const Points& between, const Points& way, const Points& wayB, Lanes lengthSqA,
                                      Lanes lengthSqB, Lanes farther) {
  const auto ab = dotOf(way, wayB), da = dotOf(way, between), db = dotOf(wayB, between);
  const auto det = hn::Sub(hn::Mul(lengthSqA, lengthSqB), hn::Mul(ab, ab));
  const auto onA = hn::Sub(hn::Mul(ab, db), hn::Mul(lengthSqB, da));
  const auto onB = hn::Sub(hn::Mul(lengthSqA, db), hn::Mul(ab, da));
  // Ways along them times `det`.
  const auto beyondA = hn::Mul(det, hn::Div(farther, hn::Sqrt(lengthSqA)));
  const auto beyondB = hn::Mul(det, hn::Div(farther, hn::Sqrt(lengthSqB)));
  const auto isOnA = hn::And(hn::Ge(onA, hn::Neg(beyondA)), hn::Le(hn::Sub(onA, det), beyondA));
  const auto isOnB = hn::And(hn::Ge(onB, hn::Neg(beyondB)), hn::Le(hn::Sub(onB, det), beyondB));
  return hn::And(isOnA, isOnB);
}

// An edge of A against the convex ones of B that `nearEdges` names: what is no farther than contacts are, and may face
// each other once the bodies have turned a little.
template <class Add>
HWY_INLINE void edgeOnEdges(const Vec3& from, const Vec3& to, const Vec3& outwardOfA, const SurfacePatch& edges,
                            std::uint32_t nearEdges, const NearLimits& limits, float turn, const Add& add) {
  const Tag d;
  const std::uint32_t stride = SurfacePatch::padded(edges.convexEdges);
  const float grown = std::max(limits.reach, -limits.depth) + limits.besideDeep;
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
    const Points apart = nearestOf(minus(p, r), way, wayB, lengthSqA, lengthSqB);
    const auto distanceSq = dotOf(apart, apart), upwards = dotOf(apart, across);
    mask = hn::And(mask, hn::Le(distanceSq, hn::Set(d, grown * grown)));
    // What is clearly in front, and not nearly parallel, stays so.
    const auto height = hn::IfThenElse(hn::Lt(alongB, alongA), hn::Neg(upwards), upwards);
    const auto isInFront = hn::And(hn::Gt(height, hn::Mul(hn::Set(d, 0.5F), hn::Mul(norm, hn::Sqrt(distanceSq)))),
                                   hn::Gt(norm, hn::Mul(hn::Set(d, tuning::kClearSine), lengths)));
    const float ahead = limits.reach + limits.besideDeep;
    mask = hn::AndNot(hn::And(isInFront, hn::Gt(distanceSq, hn::Set(d, ahead * ahead))), mask);
    // Lines that are not nearly parallel pass each other where they do, but for a little.
    const auto isClear = hn::Gt(norm, hn::Mul(hn::Set(d, std::max(tuning::kClearSine, 4 * turn)), lengths));
    const auto cosecant = hn::Div(lengths, hn::Max(norm, hn::Set(d, std::numeric_limits<float>::min())));
    const auto farther =
        hn::Add(hn::Set(d, limits.besideDeep),
                hn::Mul(hn::Set(d, 4 * (limits.skin + grown * (turn + tuning::kPassingRounding))), cosecant));
    const auto passes = passesWithin(minus(p, r), way, wayB, lengthSqA, lengthSqB, farther);
    mask = hn::And(mask, hn::Or(hn::Not(isClear), passes));
    addEach(bitsOf(mask) & nearHere, at, add);
  }
}

}  // namespace
}  // namespace cairn::bullet::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CAIRN_EDGE_TESTS_INL_H

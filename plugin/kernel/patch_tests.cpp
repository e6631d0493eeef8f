// SPDX-License-Identifier: Zlib
//
// The tests of two patches that most pairs of features end with, in vectors, compiled once per instruction set by
// Highway. Products and sums stay separate and in the order of `Vec3`'s.
#include "kernel/patch_tests.h"

#include <algorithm>
#include <bit>
#include <limits>

// The instruction sets Highway compiles for, as in the core.
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernel/patch_tests.cpp"
#include <hwy/foreach_target.h>  // must come before highway.h

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace cairn::bullet::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::CappedTag<float, SurfacePatch::kBatch>;
using IntTag = hn::RebindToSigned<Tag>;
using Lanes = hn::Vec<Tag>;

struct Points {
  Lanes x, y, z;
};

// Which planes each vertex of a patch is beyond, as bits: those of the near box and slab, and in the next byte those of
// the exact ones.
struct Codes {
  alignas(64) std::int32_t of[SurfacePatch::kMaxFeatures];
};

constexpr std::int32_t kNear = 0xFF, kExact = 0xFF00;

// Of a patch, in the other's frame.
struct PlacedColumns {
  const float* columns;
  std::uint32_t stride;

  explicit PlacedColumns(const PlacedPatch& patch)
      : columns(patch.columns), stride(SurfacePatch::padded(patch.patch.vertices.size())) {}
  Vec3 operator[](std::uint32_t i) const { return {columns[i], columns[stride + i], columns[2 * stride + i]}; }
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

template <class Add>
HWY_INLINE void addEach(std::uint32_t bits, std::uint32_t at, const Add& add) {
  for (; bits != 0; bits &= bits - 1) add(at + static_cast<std::uint32_t>(std::countr_zero(bits)));
}

HWY_INLINE hn::Vec<IntTag> codeIf(hn::Mask<Tag> mask, std::int32_t bit) {
  const IntTag d;
  return hn::IfThenElseZero(hn::RebindMask(d, mask), hn::Set(d, bit));
}

HWY_INLINE hn::Vec<IntTag> codesOf(const Points& p, const Box& box, Lanes height, float lowest, float highest,
                                   int shift) {
  const Tag d;
  const Points lower = all(box.lower), upper = all(box.upper);
  const auto below = hn::Or(codeIf(hn::Lt(p.x, lower.x), 1 << shift),
                            hn::Or(codeIf(hn::Lt(p.y, lower.y), 2 << shift), codeIf(hn::Lt(p.z, lower.z), 4 << shift)));
  const auto above =
      hn::Or(codeIf(hn::Gt(p.x, upper.x), 8 << shift),
             hn::Or(codeIf(hn::Gt(p.y, upper.y), 16 << shift), codeIf(hn::Gt(p.z, upper.z), 32 << shift)));
  const auto slab = hn::Or(codeIf(hn::Lt(height, hn::Set(d, lowest)), 64 << shift),
                           codeIf(hn::Gt(height, hn::Set(d, highest)), 128 << shift));
  return hn::Or(hn::Or(below, above), slab);
}

// A patch's vertices as they stand to a patch of the other surface. Returns the bits of all planes that every one is
// beyond.
HWY_INLINE std::int32_t codesOf(const PlacedColumns& placed, const PlacedPatch& faced, Codes& codes) {
  const Tag d;
  const Points facing = all(faced.patch.facing);
  auto common = hn::Set(IntTag(), -1);
  for (std::uint32_t i = 0; i < placed.stride; i += static_cast<std::uint32_t>(hn::Lanes(d))) {
    const Points p = load(placed.columns, placed.stride, i);
    const auto height = dotOf(facing, p);
    const auto code = hn::Or(codesOf(p, faced.near, height, faced.nearLowest, faced.nearHighest, 0),
                             codesOf(p, faced.exact, height, faced.lowest, faced.highest, 8));
    common = hn::And(common, code);
    hn::Store(code, IntTag(), codes.of + i);
  }
  alignas(64) std::int32_t each[SurfacePatch::kBatch];
  hn::Store(common, IntTag(), each);
  std::int32_t sum = -1;
  for (std::size_t i = 0; i < hn::Lanes(d); ++i) sum &= each[i];
  return sum;
}

struct FaceRows {
  const float* columns;
  std::uint32_t stride;

  HWY_INLINE Points normal(std::uint32_t at) const { return load(columns, stride, at); }
  HWY_INLINE Lanes offset(std::uint32_t at) const { return hn::LoadU(Tag(), columns + 3 * stride + at); }
  HWY_INLINE Lanes inside(int side, const Points& p, std::uint32_t at) const {
    const float* const row = columns + static_cast<std::uint32_t>(4 * side + 4) * stride;
    return hn::Sub(dotOf(load(row, stride, at), p), hn::LoadU(Tag(), row + 3 * stride + at));
  }
};

FaceRows rowsOf(const SurfacePatch& patch) {
  return {patch.faceColumns, SurfacePatch::padded(patch.triangles.size())};
}

template <class Add>
HWY_INLINE void vertexOnFaces(const Vec3& vertex, const SurfacePatch& faces, const NearLimits& limits, const Add& add) {
  const Tag d;
  const FaceRows rows = rowsOf(faces);
  const Points p = all(vertex);
  const auto least = hn::Set(d, limits.beside), most = hn::Set(d, limits.besideDeep);
  for (std::uint32_t at = 0; at < rows.stride; at += static_cast<std::uint32_t>(hn::Lanes(d))) {
    const auto height = hn::Sub(dotOf(rows.normal(at), p), rows.offset(at));
    auto mask = hn::And(hn::Le(height, hn::Set(d, limits.reach)), hn::Ge(height, hn::Set(d, limits.depth)));
    if (hn::AllFalse(d, mask)) continue;
    const auto depth = hn::Sub(hn::Set(d, limits.margins + 2 * limits.skin), height);
    const auto beside = hn::Neg(hn::Max(least, hn::Min(depth, most)));
    for (int side = 0; side < 3; ++side) mask = hn::And(mask, hn::Ge(rows.inside(side, p, at), beside));
    addEach(bitsOf(mask), at, add);
  }
}

// What crosses the plane of a face does so inside its sides. Where bodies may yet move, a point of an edge that is
// then on the face now is a skin or less from it, and from there to where the edge's line goes through its plane is as
// much farther as the edge is flat to it.
template <class Add>
HWY_INLINE void edgeThroughFaces(const Vec3& from, const Vec3& to, const SurfacePatch& faces, const NearLimits& limits,
                                 const Add& add) {
  const Tag d;
  const FaceRows rows = rowsOf(faces);
  const auto skin = hn::Set(d, limits.skin), zero = hn::Zero(d);
  const auto moved = hn::Set(d, 2 * limits.skin * length(to - from));
  const Points p = all(from), way = all(to - from), q = all(to);
  for (std::uint32_t at = 0; at < rows.stride; at += static_cast<std::uint32_t>(hn::Lanes(d))) {
    const Points normal = rows.normal(at);
    const auto offset = rows.offset(at);
    const auto first = hn::Sub(dotOf(normal, p), offset), second = hn::Sub(dotOf(normal, q), offset);
    auto mask = hn::And(hn::Le(hn::Min(first, second), skin), hn::Ge(hn::Max(first, second), hn::Neg(skin)));
    if (hn::AllFalse(d, mask)) continue;
    const auto goesThrough = hn::Xor(hn::Lt(first, zero), hn::Lt(second, zero));
    const auto rise = hn::Sub(first, second);
    const auto along = hn::Div(first, hn::IfThenElse(goesThrough, rise, hn::Set(d, 1.0F)));
    const Points place{hn::Add(p.x, hn::Mul(way.x, along)), hn::Add(p.y, hn::Mul(way.y, along)),
                       hn::Add(p.z, hn::Mul(way.z, along))};
    const auto slack = hn::Neg(hn::Div(moved, hn::IfThenElse(goesThrough, hn::Abs(rise), hn::Set(d, 1.0F))));
    for (int side = 0; side < 3; ++side) {
      const auto ends = hn::Max(rows.inside(side, p, at), rows.inside(side, q, at));
      const auto isInside = hn::Or(hn::Not(goesThrough), hn::Ge(rows.inside(side, place, at), slack));
      mask = hn::And(mask, hn::And(isInside, hn::Ge(ends, hn::Neg(skin))));
    }
    addEach(bitsOf(mask), at, add);
  }
}

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

// Sine of the angle from which a normal of two edges turns little when they do.
constexpr float kClearSine = 0.1F;
// Of where such edges are nearest, as a part of what is looked at beside them.
constexpr float kRounding = 1e-3F;

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
                                   hn::Gt(norm, hn::Mul(hn::Set(d, kClearSine), lengths)));
    const float ahead = limits.reach + limits.besideDeep;
    mask = hn::AndNot(hn::And(isInFront, hn::Gt(distanceSq, hn::Set(d, ahead * ahead))), mask);
    // Lines that are not nearly parallel pass each other where they do, but for a little.
    const auto isClear = hn::Gt(norm, hn::Mul(hn::Set(d, std::max(kClearSine, 4 * turn)), lengths));
    const auto cosecant = hn::Div(lengths, hn::Max(norm, hn::Set(d, std::numeric_limits<float>::min())));
    const auto farther = hn::Add(hn::Set(d, limits.besideDeep),
                                 hn::Mul(hn::Set(d, 4 * (limits.skin + grown * (turn + kRounding))), cosecant));
    const auto passes = passesWithin(minus(p, r), way, wayB, lengthSqA, lengthSqB, farther);
    mask = hn::And(mask, hn::Or(hn::Not(isClear), passes));
    addEach(bitsOf(mask) & nearHere, at, add);
  }
}

HWY_INLINE bool mayBeNear(const Codes& codes, const std::array<std::uint8_t, 2>& ends, std::int32_t planes) {
  return (codes.of[ends[0]] & codes.of[ends[1]] & planes) == 0;
}

// Of the patch's convex edges, a bit for each that may be near.
HWY_INLINE std::uint32_t nearEdgesOf(const SurfacePatch& patch, const Codes& codes) {
  std::uint32_t bits = 0;
  for (std::uint32_t e = 0; e < patch.convexEdges; ++e)
    bits |= static_cast<std::uint32_t>(mayBeNear(codes, patch.edgeEnds[e], kNear)) << e;
  return bits;
}

HWY_INLINE bool overlap(const Box& a, const Box& b) {
  return a.lower.x <= b.upper.x && a.upper.x >= b.lower.x && a.lower.y <= b.upper.y && a.upper.y >= b.lower.y &&
         a.lower.z <= b.upper.z && a.upper.z >= b.lower.z;
}

struct TestedPair {
  const PlacedPatch &a, &b;
  PlacedColumns aInB, bInA;
  Codes codesA, codesB;
};

HWY_INLINE void testTouching(const PatchQuestion& question, const TestedPair& pair, FeatureLists& lists) {
  const SurfacePatch &a = pair.a.patch, &b = pair.b.patch;
  for (std::uint32_t i = 0; i < a.ownVertices; ++i)
    if ((pair.codesA.of[i] & kNear) == 0)
      vertexOnFaces(pair.aInB[i], b, question.b.limits(), [&](std::uint32_t f) {
        lists.verticesOnFaces.push_back({a.vertices[i], b.triangles[f]});
      });
  for (std::uint32_t i = 0; i < b.ownVertices; ++i)
    if ((pair.codesB.of[i] & kNear) == 0)
      vertexOnFaces(pair.bInA[i], a, question.a.limits(), [&](std::uint32_t f) {
        lists.facesOnVertices.push_back({a.triangles[f], b.vertices[i]});
      });
  const std::uint32_t nearEdges = nearEdgesOf(b, pair.codesB);
  const float* const outward = a.edgeColumns + 6 * static_cast<std::size_t>(SurfacePatch::padded(a.convexEdges));
  for (std::uint32_t bits = nearEdges == 0 ? 0 : nearEdgesOf(a, pair.codesA); bits != 0; bits &= bits - 1) {
    const auto e = static_cast<std::uint32_t>(std::countr_zero(bits));
    const auto [from, to] = a.edgeEnds[e];
    const std::uint32_t stride = SurfacePatch::padded(a.convexEdges);
    const Vec3 outwardInA(outward[e], outward[stride + e], outward[2 * stride + e]);
    edgeOnEdges(pair.aInB[from], pair.aInB[to], question.surfaces.a.axesToOther * outwardInA, b, nearEdges,
                question.b.limits(), question.turn, [&](std::uint32_t f) {
                  lists.edgesOnEdges.push_back({a.edges[e], b.edges[f]});
                });
  }
}

HWY_INLINE void testCrossing(const PatchQuestion& question, const TestedPair& pair, FeatureLists& lists) {
  const SurfacePatch &a = pair.a.patch, &b = pair.b.patch;
  for (std::uint32_t e = 0; e < a.edges.size(); ++e)
    if (const auto& ends = a.edgeEnds[e]; mayBeNear(pair.codesA, ends, kExact))
      edgeThroughFaces(pair.aInB[ends[0]], pair.aInB[ends[1]], b, question.b.limits(), [&](std::uint32_t f) {
        lists.edgesThroughFaces.push_back({a.edges[e], b.triangles[f]});
      });
  for (std::uint32_t e = 0; e < b.edges.size(); ++e)
    if (const auto& ends = b.edgeEnds[e]; mayBeNear(pair.codesB, ends, kExact))
      edgeThroughFaces(pair.bInA[ends[0]], pair.bInA[ends[1]], a, question.a.limits(), [&](std::uint32_t f) {
        lists.facesThroughEdges.push_back({a.triangles[f], b.edges[e]});
      });
}

// Boxes of what is placed are tighter than those of placed boxes, and say no to most.
HWY_INLINE void testPair(const PatchQuestion& question, const PatchPair& indices, FeatureLists& lists) {
  const PlacedPatch &a = question.a[indices.a], &b = question.b[indices.b];
  if (!overlap(a.placed, b.near) || !overlap(b.placed, a.near)) return;
  TestedPair pair{a, b, PlacedColumns(a), PlacedColumns(b), {}, {}};
  const std::int32_t beyondB = codesOf(pair.aInB, b, pair.codesA);
  if ((beyondB & kNear) != 0) return;
  const std::int32_t beyondA = codesOf(pair.bInA, a, pair.codesB);
  if ((beyondA & kNear) != 0) return;
  testTouching(question, pair, lists);
  if (question.asksCrossings && ((beyondA | beyondB) & kExact) == 0) testCrossing(question, pair, lists);
}

}  // namespace

void testPairs(const PatchQuestion& question, std::span<const PatchPair> pairs, FeatureLists& lists) {
  for (const PatchPair& pair : pairs) testPair(question, pair, lists);
}

void place(const SurfacePatch& patch, const Similarity& to, float* columns, Box& box) {
  const Tag d;
  const std::uint32_t stride = SurfacePatch::padded(patch.vertices.size());
  const Points rows[3] = {all(to.linear.rows[0]), all(to.linear.rows[1]), all(to.linear.rows[2])};
  const Points shift = all(to.translation);
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  const Vec3 far(kInfinity, kInfinity, kInfinity);
  Points least = all(far), most = all(-far);
  for (std::uint32_t i = 0; i < stride; i += static_cast<std::uint32_t>(hn::Lanes(d))) {
    const Points p = load(patch.vertexColumns, stride, i);
    const Points q{hn::Add(dotOf(rows[0], p), shift.x), hn::Add(dotOf(rows[1], p), shift.y),
                   hn::Add(dotOf(rows[2], p), shift.z)};
    hn::StoreU(q.x, d, columns + i);
    hn::StoreU(q.y, d, columns + stride + i);
    hn::StoreU(q.z, d, columns + 2 * stride + i);
    least = {hn::Min(least.x, q.x), hn::Min(least.y, q.y), hn::Min(least.z, q.z)};
    most = {hn::Max(most.x, q.x), hn::Max(most.y, q.y), hn::Max(most.z, q.z)};
  }
  const auto low = [&](Lanes v) HWY_ATTR { return hn::GetLane(hn::MinOfLanes(d, v)); };
  const auto high = [&](Lanes v) HWY_ATTR { return hn::GetLane(hn::MaxOfLanes(d, v)); };
  box = {{low(least.x), low(least.y), low(least.z)}, {high(most.x), high(most.y), high(most.z)}};
}

}  // namespace cairn::bullet::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace cairn::bullet {

HWY_EXPORT(testPairs);
HWY_EXPORT(place);

Box placeVertices(const SurfacePatch& patch, const Similarity& to, float* columns) {
  Box box;
  HWY_DYNAMIC_DISPATCH(place)(patch, to, columns, box);
  return box;
}

void testPatches(const PatchQuestion& question, std::span<const PatchPair> pairs, FeatureLists& lists) {
  HWY_DYNAMIC_DISPATCH(testPairs)(question, pairs, lists);
}

}  // namespace cairn::bullet
#endif  // HWY_ONCE

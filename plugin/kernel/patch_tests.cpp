// SPDX-License-Identifier: Zlib
//
// The tests of two patches that most pairs of features end with, in vectors, compiled once per instruction set by
// Highway. Products and sums stay separate and in the order of `Vec3`'s.
#include "kernel/patch_tests.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

// The instruction sets Highway compiles for, as in the core.
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernel/patch_tests.cpp"
#include <hwy/foreach_target.h>  // must come before highway.h

#include <hwy/highway.h>

#include "kernel/contact_tuning.h"
#include "kernel/near_box.h"

#ifndef CAIRN_PATCH_TESTS_ONCE
#define CAIRN_PATCH_TESTS_ONCE
namespace cairn::bullet {

// One side's share of the question, in the frame and unit of the other, whose faces are asked.
struct PatchFrame {
  Box near;   // of what may touch the faces
  Box exact;  // of the faces
  Vec3 facing;
  float lowest = 0, highest = 0;          // of the faces, along `facing`
  float nearLowest = 0, nearHighest = 0;  // of what may touch them
  float reach = 0, depth = 0;  // heights above a face that may be contacts: at most, at least
  float margins = 0, contactDistance = 0;
};

}  // namespace cairn::bullet
#endif

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

// Which of a box's six planes each vertex of a patch is beyond, as bits: of the near box, and of the exact one in the
// next byte.
struct Codes {
  alignas(64) std::int32_t of[SurfacePatch::kMaxFeatures];
};

constexpr std::int32_t kNear = 0xFF, kExact = 0xFF00;

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

template <class M>
HWY_INLINE std::uint32_t bitsOf(M mask) {
  std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(Tag(), mask, bytes);
  return bytes[0];
}

HWY_INLINE hn::Vec<IntTag> codeIf(hn::Mask<Tag> mask, std::int32_t bit) {
  const IntTag d;
  return hn::IfThenElseZero(hn::RebindMask(d, mask), hn::Set(d, bit));
}

HWY_INLINE hn::Vec<IntTag> codesOf(const Points& p, const Box& box, Lanes height, float lowest, float highest,
                                   int shift) {
  const Points lower = all(box.lower), upper = all(box.upper);
  const auto below = hn::Or(codeIf(hn::Lt(p.x, lower.x), 1 << shift),
                            hn::Or(codeIf(hn::Lt(p.y, lower.y), 2 << shift), codeIf(hn::Lt(p.z, lower.z), 4 << shift)));
  const auto above =
      hn::Or(codeIf(hn::Gt(p.x, upper.x), 8 << shift),
             hn::Or(codeIf(hn::Gt(p.y, upper.y), 16 << shift), codeIf(hn::Gt(p.z, upper.z), 32 << shift)));
  const Tag d;
  const auto slab = hn::Or(codeIf(hn::Lt(height, hn::Set(d, lowest)), 64 << shift),
                           codeIf(hn::Gt(height, hn::Set(d, highest)), 128 << shift));
  return hn::Or(hn::Or(below, above), slab);
}

// Puts the vertices into the other's frame. Returns the bits of all planes that every vertex is beyond.
HWY_INLINE std::int32_t place(const SurfacePatch& patch, const Similarity& to, const PatchFrame& frame,
                              PatchPair::Placed& placed, Codes& codes) {
  const Tag d;
  const std::uint32_t stride = SurfacePatch::padded(patch.vertices.size());
  const Points rows[3] = {all(to.linear.rows[0]), all(to.linear.rows[1]), all(to.linear.rows[2])};
  const Points shift = all(to.translation);
  auto common = hn::Set(IntTag(), -1);
  for (std::uint32_t i = 0; i < stride; i += static_cast<std::uint32_t>(hn::Lanes(d))) {
    const Points p = load(patch.vertexColumns, stride, i);
    const Points q{hn::Add(dotOf(rows[0], p), shift.x), hn::Add(dotOf(rows[1], p), shift.y),
                   hn::Add(dotOf(rows[2], p), shift.z)};
    hn::Store(q.x, d, placed.x + i);
    hn::Store(q.y, d, placed.y + i);
    hn::Store(q.z, d, placed.z + i);
    const auto height = dotOf(all(frame.facing), q);
    const auto code = hn::Or(codesOf(q, frame.near, height, frame.nearLowest, frame.nearHighest, 0),
                             codesOf(q, frame.exact, height, frame.lowest, frame.highest, 8));
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

// A few roundings more than whoever decides allows.
constexpr float kMore = 1 + 1e-4F;

template <class Add>
HWY_INLINE void vertexOnFaces(const Vec3& vertex, const SurfacePatch& faces, const PatchFrame& frame, const Add& add) {
  const Tag d;
  const FaceRows rows = rowsOf(faces);
  const Points p = all(vertex);
  const auto least = hn::Set(d, kMore * tuning::kBeside * frame.contactDistance);
  const auto most = hn::Set(d, kMore * frame.contactDistance);
  for (std::uint32_t at = 0; at < rows.stride; at += static_cast<std::uint32_t>(hn::Lanes(d))) {
    const auto height = hn::Sub(dotOf(rows.normal(at), p), rows.offset(at));
    auto mask = hn::And(hn::Le(height, hn::Set(d, frame.reach)), hn::Ge(height, hn::Set(d, frame.depth)));
    if (hn::AllFalse(d, mask)) continue;
    const auto depth = hn::Mul(hn::Sub(hn::Set(d, frame.margins), height), hn::Set(d, kMore));
    const auto beside = hn::Neg(hn::Max(least, hn::Min(depth, most)));
    for (int side = 0; side < 3; ++side) mask = hn::And(mask, hn::Ge(rows.inside(side, p, at), beside));
    for (std::uint32_t bits = bitsOf(mask); bits != 0; bits &= bits - 1)
      add(at + static_cast<std::uint32_t>(std::countr_zero(bits)));
  }
}

template <class Add>
HWY_INLINE void edgeThroughFaces(const Vec3& from, const Vec3& to, const SurfacePatch& faces, const Add& add) {
  const Tag d;
  const FaceRows rows = rowsOf(faces);
  const auto zero = hn::Zero(d);
  const Points p = all(from), q = all(to), way = minus(q, p);
  for (std::uint32_t at = 0; at < rows.stride; at += static_cast<std::uint32_t>(hn::Lanes(d))) {
    const Points normal = rows.normal(at);
    const auto offset = rows.offset(at);
    const auto first = hn::Sub(dotOf(normal, p), offset), second = hn::Sub(dotOf(normal, q), offset);
    auto mask = hn::Xor(hn::Lt(first, zero), hn::Lt(second, zero));
    if (hn::AllFalse(d, mask)) continue;
    const auto along = hn::Div(first, hn::Sub(first, second));
    const Points place{hn::Add(p.x, hn::Mul(way.x, along)), hn::Add(p.y, hn::Mul(way.y, along)),
                       hn::Add(p.z, hn::Mul(way.z, along))};
    for (int side = 0; side < 3; ++side) mask = hn::And(mask, hn::Ge(rows.inside(side, place, at), zero));
    for (std::uint32_t bits = bitsOf(mask); bits != 0; bits &= bits - 1)
      add(at + static_cast<std::uint32_t>(std::countr_zero(bits)));
  }
}

HWY_INLINE hn::Mask<Tag> areBoxesNear(const Points& p, const Points& q, const Box& box) {
  const Points lower = all(box.lower), upper = all(box.upper);
  const auto onAxis = [&](Lanes u, Lanes v, Lanes low, Lanes high) HWY_ATTR {
    return hn::And(hn::Le(hn::Min(u, v), high), hn::Ge(hn::Max(u, v), low));
  };
  return hn::And(onAxis(p.x, q.x, lower.x, upper.x),
                 hn::And(onAxis(p.y, q.y, lower.y, upper.y), onAxis(p.z, q.z, lower.z, upper.z)));
}

// An edge of A, `p` to `q`, against all convex ones of B.
template <class Add>
HWY_INLINE void edgeOnEdges(const Vec3& from, const Vec3& to, const Vec3& outwardOfA, const SurfacePatch& edges,
                            std::uint32_t nearEdges, const PatchFrame& frame, const Add& add) {
  const Tag d;
  const std::uint32_t stride = SurfacePatch::padded(edges.convexEdges);
  const auto zero = hn::Zero(d);
  const float grown = std::max(frame.reach, -frame.depth) + kMore * frame.contactDistance;
  Box box{from, from};
  box.add(to);
  for (int axis = 0; axis < 3; ++axis) {
    box.lower[axis] -= grown;
    box.upper[axis] += grown;
  }
  const Points p = all(from), way = all(to - from), outwardA = all(outwardOfA);
  const auto lengthSqA = dotOf(way, way);
  constexpr float kSineSq = tuning::kParallelSine * tuning::kParallelSine / (kMore * kMore);
  for (std::uint32_t at = 0; at < stride; at += static_cast<std::uint32_t>(hn::Lanes(d))) {
    const Points r = load(edges.edgeColumns, stride, at), s = load(edges.edgeColumns + 3 * stride, stride, at);
    const std::uint32_t nearHere = nearEdges >> at & ((1U << hn::Lanes(d)) - 1);
    if (nearHere == 0) continue;
    auto mask = areBoxesNear(r, s, box);
    if ((bitsOf(mask) & nearHere) == 0) continue;
    const Points wayB = minus(s, r), across = crossOf(way, wayB);
    const auto lengthSqB = dotOf(wayB, wayB), normSq = dotOf(across, across);
    mask = hn::And(mask, hn::Gt(normSq, hn::Mul(hn::Set(d, kSineSq), hn::Mul(lengthSqA, lengthSqB))));
    const auto alongA = dotOf(across, outwardA),
               alongB = dotOf(across, load(edges.edgeColumns + 6 * stride, stride, at));
    mask = hn::And(mask, hn::Lt(hn::Mul(alongA, alongB), zero));
    if (hn::AllFalse(d, mask)) continue;
    const Points between = minus(p, r);
    const auto norm = hn::Sqrt(normSq);
    const auto heightUp = dotOf(across, between);
    const auto height = hn::IfThenElse(hn::Lt(alongB, zero), hn::Neg(heightUp), heightUp);
    mask = hn::And(mask, hn::And(hn::Le(height, hn::Mul(norm, hn::Set(d, frame.reach))),
                                 hn::Ge(height, hn::Mul(norm, hn::Set(d, frame.depth)))));
    if (hn::AllFalse(d, mask)) continue;
    const auto ab = dotOf(way, wayB), da = dotOf(way, between), db = dotOf(wayB, between);
    // Ways along the edges times the determinant, which is the square of the sine times both lengths.
    const auto onA = hn::Sub(hn::Mul(ab, db), hn::Mul(lengthSqB, da));
    const auto onB = hn::Sub(hn::Mul(lengthSqA, db), hn::Mul(ab, da));
    const auto det = hn::Sub(hn::Mul(lengthSqA, lengthSqB), hn::Mul(ab, ab));
    const auto beside = hn::Mul(hn::Set(d, kMore * kMore * frame.contactDistance), det);
    const auto besideA = hn::Div(beside, hn::Sqrt(lengthSqA)), besideB = hn::Div(beside, hn::Sqrt(lengthSqB));
    mask = hn::And(mask, hn::And(hn::Ge(onA, hn::Neg(besideA)), hn::Le(hn::Sub(onA, det), besideA)));
    mask = hn::And(mask, hn::And(hn::Ge(onB, hn::Neg(besideB)), hn::Le(hn::Sub(onB, det), besideB)));
    for (std::uint32_t bits = bitsOf(mask) & nearHere; bits != 0; bits &= bits - 1)
      add(at + static_cast<std::uint32_t>(std::countr_zero(bits)));
  }
}

}  // namespace

void testPlaced(const SurfacePair& surfaces, const PatchFrame& inB, const PatchFrame& inA, PatchPair& patches) {
  Codes codesA, codesB;
  const std::int32_t beyondB = place(patches.a, surfaces.a.toOther, inB, patches.aInB, codesA);
  if ((beyondB & kNear) != 0) return;
  const std::int32_t beyondA = place(patches.b, surfaces.b.toOther, inA, patches.bInA, codesB);
  if ((beyondA & kNear) != 0) return;
  const auto countA = static_cast<std::uint32_t>(patches.a.vertices.size());
  const auto countB = static_cast<std::uint32_t>(patches.b.vertices.size());
  for (std::uint32_t i = 0; i < countA; ++i)
    if ((codesA.of[i] & kNear) == 0)
      vertexOnFaces(patches.aInB[i], patches.b, inB, [&](std::uint32_t f) { patches.verticesOnFaces.add(i, f); });
  for (std::uint32_t i = 0; i < countB; ++i)
    if ((codesB.of[i] & kNear) == 0)
      vertexOnFaces(patches.bInA[i], patches.a, inA, [&](std::uint32_t f) { patches.facesOnVertices.add(f, i); });
  std::uint32_t nearEdges = 0;  // of B's convex ones, a bit each
  for (std::uint32_t e = 0; e < patches.b.convexEdges; ++e) {
    const auto [from, to] = patches.b.edgeEnds[e];
    nearEdges |= static_cast<std::uint32_t>((codesB.of[from] & codesB.of[to] & kNear) == 0) << e;
  }
  for (std::uint32_t e = 0; e < patches.a.convexEdges && nearEdges != 0; ++e) {
    const auto [from, to] = patches.a.edgeEnds[e];
    if ((codesA.of[from] & codesA.of[to] & kNear) != 0) continue;
    const Vec3 outward = surfaces.a.axesToOther * surfaces.a.features().edges()[patches.a.edges[e]].outward;
    edgeOnEdges(patches.aInB[from], patches.aInB[to], outward, patches.b, nearEdges, inB,
                [&](std::uint32_t f) { patches.edgesOnEdges.add(e, f); });
  }
  if (((beyondA | beyondB) & kExact) != 0) return;
  for (std::uint32_t e = 0; e < patches.a.edges.size(); ++e) {
    const auto [from, to] = patches.a.edgeEnds[e];
    if ((codesA.of[from] & codesA.of[to] & kExact) == 0)
      edgeThroughFaces(patches.aInB[from], patches.aInB[to], patches.b,
                       [&](std::uint32_t f) { patches.edgesThroughFaces.add(e, f); });
  }
  for (std::uint32_t e = 0; e < patches.b.edges.size(); ++e) {
    const auto [from, to] = patches.b.edgeEnds[e];
    if ((codesB.of[from] & codesB.of[to] & kExact) == 0)
      edgeThroughFaces(patches.bInA[from], patches.bInA[to], patches.a,
                       [&](std::uint32_t f) { patches.facesThroughEdges.add(f, e); });
  }
}

}  // namespace cairn::bullet::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace cairn::bullet {

HWY_EXPORT(testPlaced);

namespace {

PatchFrame frameOf(const PlacedSurface& faced, const ContactLimits& limits, const SurfacePatch& faces) {
  const NearLimits near(faced.scale, limits);
  PatchFrame frame;
  frame.reach = near.reach;
  frame.depth = (limits.margins - limits.trustedDepth) / faced.scale + (near.depth * 1e-5F);
  frame.margins = limits.margins / faced.scale;
  frame.contactDistance = near.beside;
  frame.exact = faces.box;
  frame.near = near.around(faces.box, faces.normals);
  frame.facing = faces.facing;
  frame.lowest = faces.lowest;
  frame.highest = faces.highest;
  frame.nearLowest = faces.lowest + std::min(near.depth, -near.reach) - near.beside;
  frame.nearHighest = faces.highest + near.reach + near.beside;
  return frame;
}

}  // namespace

void testPatches(const SurfacePair& surfaces, const ContactLimits& limits, PatchPair& patches) {
  for (FeaturePairs* found : {&patches.verticesOnFaces, &patches.facesOnVertices, &patches.edgesOnEdges,
                            &patches.edgesThroughFaces, &patches.facesThroughEdges})
    found->count = 0;
  const PatchFrame inB = frameOf(surfaces.b, limits, patches.b), inA = frameOf(surfaces.a, limits, patches.a);
  HWY_DYNAMIC_DISPATCH(testPlaced)(surfaces, inB, inA, patches);
}

}  // namespace cairn::bullet
#endif  // HWY_ONCE

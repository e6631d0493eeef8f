// SPDX-License-Identifier: Zlib
//
// The vectorised tests of two patches, which rule out most pairs of features. Highway compiles them once per
// instruction set. Products and sums stay separate and in the order of `Vec3`'s, so that all targets give the same
// bits.
#include "kernel/patch_tests.h"

#include <bit>

// The instruction sets Highway compiles for, as in the core.
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernel/patch_tests.cpp"
#include <hwy/foreach_target.h>  // must come before highway.h

#include <hwy/highway.h>

#include "kernel/edge_tests-inl.h"
#include "kernel/points-inl.h"

HWY_BEFORE_NAMESPACE();
namespace cairn::bullet::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

using IntTag = hn::RebindToSigned<Tag>;

// For each vertex of a patch, a bit for each plane that it is beyond. The low byte is for the near box and slab, the
// next byte for the exact ones.
struct Codes {
  alignas(64) std::int32_t of[SurfacePatch::kMaxFeatures];
};

constexpr std::int32_t kNear = 0xFF, kExact = 0xFF00;

// The vertices of a patch, in the other surface's frame.
struct PlacedColumns {
  const float* columns;
  std::uint32_t stride;

  explicit PlacedColumns(const PlacedPatch& patch)
      : columns(patch.columns), stride(SurfacePatch::padded(patch.patch.vertices.size())) {}
  Vec3 operator[](std::uint32_t i) const { return {columns[i], columns[stride + i], columns[2 * stride + i]}; }
};

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

// Codes a patch's vertices against a patch of the other surface. Returns the planes that all of them are beyond.
HWY_INLINE std::int32_t codesOf(const PlacedColumns& placed, const PlacedPatch& faced, float skin, Codes& codes) {
  const Tag d;
  const Points facing = all(faced.patch.facing);
  const Box near = faced.near.grown(skin), exact = faced.patch.box.grown(skin);
  auto common = hn::Set(IntTag(), -1);
  for (std::uint32_t i = 0; i < placed.stride; i += static_cast<std::uint32_t>(hn::Lanes(d))) {
    const Points p = load(placed.columns, placed.stride, i);
    const auto height = dotOf(facing, p);
    const auto code = hn::Or(codesOf(p, near, height, faced.nearLowest - skin, faced.nearHighest + skin, 0),
                             codesOf(p, exact, height, faced.patch.lowest - skin, faced.patch.highest + skin, 8));
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

// A margin says by how much a condition of a contact fails, divided by the greatest rate at which movement changes it.
template <class Add>
HWY_INLINE void vertexOnFaces(const Vec3& vertex, const SurfacePatch& faces, const PlacedPatches& facing,
                              const Add& add) {
  const Tag d;
  const FaceRows rows = rowsOf(faces);
  const Points p = all(vertex);
  const NearLimits& limits = facing.limits();
  const auto skin = hn::Set(d, limits.skin);
  for (std::uint32_t at = 0; at < rows.stride; at += static_cast<std::uint32_t>(hn::Lanes(d))) {
    const auto height = hn::Sub(dotOf(rows.normal(at), p), rows.offset(at));
    auto margin = hn::Max(hn::Sub(height, hn::Set(d, limits.maxSeparation)), hn::Sub(hn::Set(d, limits.depth), height));
    if (hn::AllFalse(d, hn::Le(margin, skin))) continue;
    auto inside = rows.inside(0, p, at);
    for (int side = 1; side < 3; ++side) inside = hn::Min(inside, rows.inside(side, p, at));
    // The allowed distance beside a face grows with depth, up to a limit.
    const auto outside = hn::Neg(inside), depth = hn::Sub(hn::Set(d, limits.margins), height);
    const auto ifDeep =
        hn::Max(hn::Mul(hn::Set(d, 0.5F), hn::Sub(outside, depth)), hn::Sub(outside, hn::Set(d, limits.besideDeep)));
    margin = hn::Max(margin, hn::Min(hn::Sub(outside, hn::Set(d, limits.beside)), ifDeep));
    addEach(bitsOf(hn::Le(margin, skin)), at, worldLengths(margin, facing), add);
  }
}

// An edge crosses a face where it passes the face's plane inside its sides. Bodies may still move by the skin. A point
// of the edge that is on the face then is at most a skin from it now. From there to the crossing with the plane is
// farther, the flatter the edge lies to the plane.
template <class Add>
HWY_INLINE void edgeThroughFaces(const Vec3& from, const Vec3& to, const SurfacePatch& faces,
                                 const PlacedPatches& facing, const Add& add) {
  const Tag d;
  const FaceRows rows = rowsOf(faces);
  const auto skin = hn::Set(d, facing.limits().skin), zero = hn::Zero(d), one = hn::Set(d, 1.0F);
  const auto twiceLength = hn::Set(d, 2 * length(to - from));
  const Points p = all(from), way = all(to - from), q = all(to);
  for (std::uint32_t at = 0; at < rows.stride; at += static_cast<std::uint32_t>(hn::Lanes(d))) {
    const Points normal = rows.normal(at);
    const auto offset = rows.offset(at);
    const auto first = hn::Sub(dotOf(normal, p), offset), second = hn::Sub(dotOf(normal, q), offset);
    auto margin = hn::Max(hn::Min(first, second), hn::Neg(hn::Max(first, second)));
    if (hn::AllFalse(d, hn::Le(margin, skin))) continue;
    const auto goesThrough = hn::Xor(hn::Lt(first, zero), hn::Lt(second, zero));
    const auto rise = hn::Sub(first, second);
    const auto along = hn::Div(first, hn::IfThenElse(goesThrough, rise, one));
    const Points place{hn::Add(p.x, hn::Mul(way.x, along)), hn::Add(p.y, hn::Mul(way.y, along)),
                       hn::Add(p.z, hn::Mul(way.z, along))};
    auto inside = rows.inside(0, place, at);
    for (int side = 0; side < 3; ++side) {
      const auto ends = hn::Max(rows.inside(side, p, at), rows.inside(side, q, at));
      margin = hn::Max(margin, hn::Neg(ends));
      if (side > 0) inside = hn::Min(inside, rows.inside(side, place, at));
    }
    const auto outside = hn::Neg(hn::Div(hn::Mul(inside, hn::Abs(rise)), twiceLength));
    margin = hn::IfThenElse(goesThrough, hn::Max(margin, outside), margin);
    addEach(bitsOf(hn::Le(margin, skin)), at, worldLengths(margin, facing), add);
  }
}

HWY_INLINE bool mayBeNear(const Codes& codes, const std::array<std::uint8_t, 2>& ends, std::int32_t planes) {
  return (codes.of[ends[0]] & codes.of[ends[1]] & planes) == 0;
}

// A bit for each of the patch's convex edges that may be near.
HWY_INLINE std::uint32_t nearEdgesOf(const SurfacePatch& patch, const Codes& codes) {
  std::uint32_t bits = 0;
  for (std::uint32_t e = 0; e < patch.convexEdges; ++e)
    bits |= static_cast<std::uint32_t>(mayBeNear(codes, patch.edgeEnds[e], kNear)) << e;
  return bits;
}

struct TestedPair {
  const PlacedPatch &a, &b;
  PlacedColumns aInB, bInA;
  Codes codesA, codesB;
};

HWY_INLINE void testTouching(const PatchQuery& question, const TestedPair& pair, FeatureLists& lists) {
  const SurfacePatch &a = pair.a.patch, &b = pair.b.patch;
  for (std::uint32_t i = 0; i < a.ownVertices; ++i)
    if ((pair.codesA.of[i] & kNear) == 0)
      vertexOnFaces(pair.aInB[i], b, question.b, [&](std::uint32_t f, float margin) {
        lists.verticesOnFaces.push_back({a.vertices[i], b.triangles[f], margin});
      });
  for (std::uint32_t i = 0; i < b.ownVertices; ++i)
    if ((pair.codesB.of[i] & kNear) == 0)
      vertexOnFaces(pair.bInA[i], a, question.a, [&](std::uint32_t f, float margin) {
        lists.facesOnVertices.push_back({a.triangles[f], b.vertices[i], margin});
      });
  const std::uint32_t nearEdges = nearEdgesOf(b, pair.codesB);
  const float* const outward = a.edgeColumns + 6 * static_cast<std::size_t>(SurfacePatch::padded(a.convexEdges));
  for (std::uint32_t bits = nearEdges == 0 ? 0 : nearEdgesOf(a, pair.codesA); bits != 0; bits &= bits - 1) {
    const auto e = static_cast<std::uint32_t>(std::countr_zero(bits));
    const auto [from, to] = a.edgeEnds[e];
    const std::uint32_t stride = SurfacePatch::padded(a.convexEdges);
    const Vec3 outwardInA(outward[e], outward[stride + e], outward[2 * stride + e]);
    edgeOnEdges(pair.aInB[from], pair.aInB[to], question.surfaces.a.axesToOther * outwardInA, b, nearEdges, question.b,
                question.turn, [&](std::uint32_t f, float margin) {
                  lists.edgesOnEdges.push_back({a.edges[e], b.edges[f], margin});
                });
  }
}

HWY_INLINE void testCrossing(const PatchQuery& question, const TestedPair& pair, FeatureLists& lists) {
  const SurfacePatch &a = pair.a.patch, &b = pair.b.patch;
  for (std::uint32_t e = 0; e < a.edges.size(); ++e)
    if (const auto& ends = a.edgeEnds[e]; mayBeNear(pair.codesA, ends, kExact))
      edgeThroughFaces(pair.aInB[ends[0]], pair.aInB[ends[1]], b, question.b, [&](std::uint32_t f, float margin) {
        lists.edgesThroughFaces.push_back({a.edges[e], b.triangles[f], margin});
      });
  for (std::uint32_t e = 0; e < b.edges.size(); ++e)
    if (const auto& ends = b.edgeEnds[e]; mayBeNear(pair.codesB, ends, kExact))
      edgeThroughFaces(pair.bInA[ends[0]], pair.bInA[ends[1]], a, question.a, [&](std::uint32_t f, float margin) {
        lists.facesThroughEdges.push_back({a.triangles[f], b.edges[e], margin});
      });
}

// The boxes around placed vertices are tighter than placed boxes, and rule out most pairs.
HWY_INLINE void testPair(const PatchQuery& question, const PatchPair& indices, FeatureLists& lists) {
  const PlacedPatch &a = question.a[indices.a], &b = question.b[indices.b];
  const float skinA = question.a.limits().skin, skinB = question.b.limits().skin;
  if (a.placed.separationTo(b.near) > skinB || b.placed.separationTo(a.near) > skinA) return;
  TestedPair pair{a, b, PlacedColumns(a), PlacedColumns(b), {}, {}};
  const std::int32_t beyondB = codesOf(pair.aInB, b, skinB, pair.codesA);
  if ((beyondB & kNear) != 0) return;
  const std::int32_t beyondA = codesOf(pair.bInA, a, skinA, pair.codesB);
  if ((beyondA & kNear) != 0) return;
  testTouching(question, pair, lists);
  if (question.asked == Asked::all && ((beyondA | beyondB) & kExact) == 0) testCrossing(question, pair, lists);
}

}  // namespace

void testPairs(const PatchQuery& question, std::span<const PatchPair> pairs, FeatureLists& lists) {
  for (const PatchPair& pair : pairs)
    if (pair.margin <= question.mostMargin) testPair(question, pair, lists);
}

}  // namespace cairn::bullet::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace cairn::bullet {

HWY_EXPORT(testPairs);

void testPatches(const PatchQuery& question, std::span<const PatchPair> pairs, FeatureLists& lists) {
  HWY_DYNAMIC_DISPATCH(testPairs)(question, pairs, lists);
}

}  // namespace cairn::bullet
#endif  // HWY_ONCE

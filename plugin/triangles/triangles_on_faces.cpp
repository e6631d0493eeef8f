// SPDX-License-Identifier: Zlib
#include "triangles/triangles_on_faces.h"

#include <algorithm>
#include <cmath>

#include "contacts/cut_face.h"
#include "contacts/face_limits.h"

namespace cairn::bullet {

namespace {

// Fraction of a triangle's least height that counts as its rim.
constexpr float kRimFraction = 0.25F;
// Fraction of a leaf's radius within which triangles with a common normal form one face, by height.
constexpr float kOneFaceFraction = 0.2F;
// Fraction of the tree's radius within which the heights of one plane may differ from step to step.
constexpr float kPlaneFraction = 1e-3F;
// Fraction of the other shape's size. A body that stands flush with a face may reach across its plane by this much
// without crossing the face.
constexpr float kFlushFraction = 2e-3F;
// Fraction of the flush length. The middle of a common part must be inside a face's sides by this much to count as over
// the face.
constexpr float kBesideFraction = 0.05F;
// Fraction of the other shape's size by which a touching body may move in a step, whatever its speed. Solvers push
// bodies that are deep in others.
constexpr float kPushedFraction = 0.1F;

void forEachFaceNormal(const PlacedTree& tree, NodeId leaf, const auto& visit) {
  if (!tree.isFaceted(leaf)) return visit(tree.facing(leaf));
  const Mat3 pairFromTreeAxes = transpose(tree.axesFromPair());
  for (const Vec3& outwards : tree.tree().faceNormals(leaf)) visit(pairFromTreeAxes * outwards);
}

void forEachTriangle(const PlacedTree& placed, NodeId leaf, const Vec3& outwards, const auto& visit) {
  const SphereTree& tree = placed.tree();
  for (const std::uint32_t index : tree.regionTriangles(leaf)) {
    const auto& [i, j, k] = tree.triangles()[index];
    const auto corner = [&](std::uint32_t v) { return placed.toPair() * tree.vertices()[v]; };
    const Triangle triangle{corner(i), corner(j), corner(k)};
    if (dot(triangle.normal(), outwards) >= kSameFaceCosine) visit(triangle);
  }
}

}  // namespace

bool TrianglesOnFaces::Own::isOver(const Vec3& point, float slack) const {
  return std::ranges::all_of(sides, [&](const Side& side) { return dot(side.inwards, point) >= side.offset - slack; });
}

bool TrianglesOnFaces::isFor(const PlacedTree& tree, NodeId leaf) {
  return (tree.isFaceted(leaf) || tree.isPlanar(leaf)) && tree.tree().regionTriangles(leaf).size() <= kMaxTriangles;
}

std::span<const Contact> TrianglesOnFaces::ofFace(const Face& face) const {
  return std::span(found_).subspan(face.begin, face.end - face.begin);
}

std::span<const TrianglesOnFaces::Own> TrianglesOnFaces::ownsOf(const Face& face) const {
  return std::span(owns_).subspan(face.owns, face.ownsEnd - face.owns);
}

void TrianglesOnFaces::append(const PairPlacement& placement, float size, std::span<const Triangle> triangles,
                              std::span<const NodePair> pairs, bool isComplete, std::vector<Contact>& contacts) {
  const PlacedTree& tree = placement.tree;
  margin_ = placement.treeMargin;
  planeTolerance_ = kPlaneFraction * tree.sphere(kRootNode).radius;
  flush_ = kFlushFraction * size;
  owns_.clear();
  faces_.clear();
  found_.clear();
  onRim_.clear();
  for (std::size_t begin = 0, end = 0; begin < pairs.size(); begin = end) {
    while (end < pairs.size() && pairs[end].a == pairs[begin].a) ++end;
    const std::size_t first = faces_.size();
    forEachFaceNormal(tree, pairs[begin].a, [&](const Vec3& n) { addFaces(tree, pairs[begin].a, n); });
    for (std::size_t i = first; i < faces_.size(); ++i)
      look(placement, faces_[i], triangles, pairs.subspan(begin, end - begin));
  }
  std::erase_if(faces_, [](const Face& face) { return face.begin == face.end; });
  decide(placement, size);
  remember(tree, placement.maxSeparation, isComplete);
  appendInFront(triangles, placement.maxSeparation, contacts);
}

// One face for each height: a leaf may hold the floor and the roof.
void TrianglesOnFaces::addFaces(const PlacedTree& tree, NodeId leaf, const Vec3& outwards) {
  const std::size_t first = faces_.size();
  const float tolerance = kOneFaceFraction * tree.sphere(leaf).radius;
  forEachTriangle(tree, leaf, outwards, [&](const Triangle& own) {
    const float offset = dot(outwards, supportOf(own, outwards));
    const auto known = std::find_if(faces_.begin() + static_cast<std::ptrdiff_t>(first), faces_.end(),
                                    [&](const Face& face) { return std::abs(face.offset - offset) <= tolerance; });
    if (known != faces_.end()) return;
    Face face;
    face.outwards = outwards;
    face.offset = offset;
    faces_.push_back(face);
  });
  for (std::size_t i = first; i < faces_.size(); ++i) addOwns(tree, leaf, faces_[i]);
}

void TrianglesOnFaces::addOwns(const PlacedTree& tree, NodeId leaf, Face& face) {
  const float tolerance = kOneFaceFraction * tree.sphere(leaf).radius;
  face.owns = owns_.size();
  forEachTriangle(tree, leaf, face.outwards, [&](const Triangle& triangle) {
    const float offset = dot(face.outwards, supportOf(triangle, face.outwards));
    if (std::abs(face.offset - offset) > tolerance) return;
    face.offset = std::max(face.offset, offset);
    Own own{triangle.a, triangle.normal(), {}, -kNothing};
    const std::array<Vec3, 3> corner{triangle.a, triangle.b, triangle.c};
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 along = corner[(i + 1) % 3] - corner[i], inwards = unitVector(cross(face.outwards, along));
      own.sides[i] = {inwards, dot(inwards, corner[i]) - kSeam * length(along)};
      own.height = std::min(own.height, dot(inwards, corner[(i + 2) % 3] - corner[i]));
    }
    owns_.push_back(own);
  });
  face.ownsEnd = owns_.size();
}

void TrianglesOnFaces::look(const PairPlacement& placement, Face& face, std::span<const Triangle> triangles,
                            std::span<const NodePair> pairs) {
  face.begin = found_.size();
  const float ceiling = face.offset + margin_ + placement.maxSeparation;
  for (const NodePair& pair : pairs) {
    const Triangle& other = triangles[pair.b];
    if (dot(face.outwards, supportOf(other, -face.outwards)) >= ceiling) continue;
    float lowest = -kNothing, highest = kNothing, lowestOfAll = -kNothing, highestOfAll = kNothing;
    for (const Own& own : ownsOf(face)) {
      const std::size_t before = found_.size();
      compare(face, own, other, pair);
      const std::span<const Contact> common = std::span(found_).subspan(before);
      if (common.empty()) continue;
      const auto [least, most] = std::ranges::minmax(common, {}, &Contact::separation);
      lowestOfAll = std::min(lowestOfAll, least.separation);
      highestOfAll = std::max(highestOfAll, most.separation);
      const bool isRim = !isWellOver(own, common, placement.maxSeparation + placement.slip);
      // A body that hangs beside the face, a wall against a wall, is on both sides of the face's plane and not over it.
      if (isRim && !isWellOver(own, common, kBesideFraction * flush_)) found_.resize(before);
      onRim_.resize(found_.size(), isRim);
      if (isRim) continue;
      lowest = std::min(lowest, least.separation);
      highest = std::max(highest, most.separation);
    }
    face.isCrossed = face.isCrossed || (lowest < 0 && highest > flush_);
    face.isCrossedOnRim = face.isCrossedOnRim || (lowestOfAll < 0 && highestOfAll > flush_);
  }
  face.end = found_.size();
}

// A body over no more than the rim stands on the face beyond it. So a plate on a beam is no wall to the beam's sides.
bool TrianglesOnFaces::isWellOver(const Own& own, std::span<const Contact> points, float tolerance) {
  if (points.empty()) return false;
  Vec3 middle{};
  for (const Contact& point : points) middle += point.position;
  return own.isOver(middle * (1 / static_cast<float>(points.size())), -std::min(tolerance, kRimFraction * own.height));
}

// Cuts the other triangle by the planes through the own triangle's sides along the normal. The rest lies over the own
// triangle.
void TrianglesOnFaces::compare(const Face& face, const Own& own, const Triangle& other, const NodePair& pair) {
  const std::array<Vec3, 3> others{other.a, other.b, other.c};
  CutFace<3> common(others);
  for (const Side& side : own.sides) common.cut(side.inwards, side.offset);
  for (const Vec3& onOther : common.points()) {
    Contact contact;
    contact.pair = pair;
    contact.normal = -face.outwards;
    contact.separation = dot(own.normal, onOther - own.corner) / dot(own.normal, face.outwards) - margin_;
    contact.position = onOther - face.outwards * (0.5F * contact.separation);
    found_.push_back(contact);
  }
}

// For a new plane, points count as in front up to the depth by which the bodies can have moved.
void TrianglesOnFaces::decide(const PairPlacement& placement, float size) {
  const float tolerance = placement.maxSeparation + placement.slip;
  for (Face& face : faces_) {
    const std::size_t place = placeOf(placement.tree, face);
    const Seen* const last = place < seen_.size() ? &seen_[place] : nullptr;
    face.isNew = !last;
    face.wasTouched = last && last->isTouched;
    face.threshold = last ? thresholdOf(*last, tolerance, size) : -tolerance;
  }
  for (Face& face : faces_)
    if (isFarSide(face, tolerance)) face.threshold = -placement.maxSeparation;
  bringOut(placement.maxSeparation, kPushedFraction * size);
}

// Points in front have sunk by no more than the bodies can have moved. They have also sunk by at most half the distance
// to the points behind.
float TrianglesOnFaces::thresholdOf(const Seen& last, float tolerance, float size) const {
  const float moved = last.isTouched ? std::max(tolerance, kPushedFraction * size) : tolerance;
  const float between = last.behind == kNothing ? moved : 0.5F * (last.front - last.behind);
  return last.front - std::min(moved, between);
}

float TrianglesOnFaces::deepestInFront(const Face& face) const {
  float deepest = std::numeric_limits<float>::infinity();
  for (std::size_t i = face.begin; i < face.end; ++i)
    if (found_[i].separation >= face.threshold) deepest = std::min(deepest, found_[i].separation);
  return deepest;
}

// The far side of a body that something stands on meets that too, from behind. Where bodies are fast, it may be no
// deeper than a step explains, and a squeezed body would come out there. If a body goes through one side and not
// through the other, the face that it crossed is the entry face.
bool TrianglesOnFaces::isFarSide(const Face& face, float tolerance) const {
  if (face.wasTouched) return false;
  const float deepest = deepestInFront(face);
  return std::ranges::any_of(faces_, [&](const Face& other) {
    if (dot(other.outwards, face.outwards) >= kOppositeCosine) return false;
    if (deepest < 0 && !face.isCrossed && other.isCrossed) return true;
    const float ofOther = deepestInFront(other);
    if (ofOther == std::numeric_limits<float>::infinity()) return false;
    return face.isNew ? ofOther > deepest + 0.5F * tolerance : other.wasTouched && ofOther < -tolerance;
  });
}

bool TrianglesOnFaces::isOfOnePlane(const Face& one, const Face& other) const {
  return dot(one.outwards, other.outwards) >= kSameFaceCosine && std::abs(one.offset - other.offset) <= planeTolerance_;
}

// Leaves that share a plane share how deep a body is in any of them, and whether it crosses the plane.
void TrianglesOnFaces::gatherPlanes() {
  for (Face& face : faces_) face.deepest = std::ranges::min(ofFace(face), {}, &Contact::separation).separation;
  for (std::size_t i = 0; i < faces_.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      if (!isOfOnePlane(faces_[i], faces_[j])) continue;
      faces_[i].isCrossed = faces_[j].isCrossed = faces_[i].isCrossed || faces_[j].isCrossed;
      faces_[i].isCrossedOnRim = faces_[j].isCrossedOnRim = faces_[i].isCrossedOnRim || faces_[j].isCrossedOnRim;
      faces_[i].deepest = faces_[j].deepest = std::min(faces_[i].deepest, faces_[j].deepest);
    }
}

// A body that passes through a face overlaps for certain. If nothing holds it, it is in front of the plane that it
// crosses least deep. If it is held already, it may also be in front of a new face: a floor, and now a wall. It must
// cross that face by at most `alsoTo`. A deeper body, or one that crosses the opposite face too, stands beside an edge.
void TrianglesOnFaces::bringOut(float maxSeparation, float alsoTo) {
  const auto mayBeLost = [&](const Face& face) { return face.isNew || deepestInFront(face) >= maxSeparation; };
  if (std::ranges::none_of(faces_, [&](const Face& face) { return face.isCrossedOnRim && mayBeLost(face); })) return;
  gatherPlanes();
  if (std::ranges::none_of(faces_, [&](const Face& face) { return face.isCrossed; })) crossOnRims(alsoTo);
  if (std::ranges::none_of(faces_, [&](const Face& face) { return face.isCrossed && mayBeLost(face); })) return;
  const bool isHeld = std::ranges::any_of(
      faces_, [&](const Face& face) { return face.deepest >= face.threshold && deepestInFront(face) < maxSeparation; });
  float least = kNothing;
  for (const Face& face : faces_)
    if (face.isCrossed && !isHeld) least = std::max(least, face.deepest);
  for (Face& face : faces_) {
    const bool isShallowest = least != kNothing && face.deepest >= least;
    if (face.isCrossed && (isShallowest || (face.isNew && face.deepest >= -alsoTo && !isSpanned(face))))
      face.threshold = std::min(face.threshold, face.deepest - maxSeparation);
  }
}

// Whether the opposite side is crossed too.
bool TrianglesOnFaces::isSpanned(const Face& face) const {
  return std::ranges::any_of(faces_, [&](const Face& other) {
    return other.isCrossed && dot(other.outwards, face.outwards) < kOppositeCosine;
  });
}

// For crates that stand flush on each other, all crossings of a face are on its rim.
void TrianglesOnFaces::crossOnRims(float alsoTo) {
  for (Face& face : faces_) face.isCrossed = face.isCrossedOnRim && face.deepest >= -alsoTo;
}

std::size_t TrianglesOnFaces::placeOf(const PlacedTree& tree, const Face& face) const {
  const Vec3 outwards = tree.axesFromPair() * face.outwards;
  const auto isSame = [&](const Seen& seen) {
    return dot(seen.outwards, outwards) >= kSameFaceCosine && std::abs(seen.offset - face.offset) <= planeTolerance_;
  };
  return static_cast<std::size_t>(std::ranges::find_if(seen_, isSame) - seen_.begin());
}

void TrianglesOnFaces::remember(const PlacedTree& tree, float maxSeparation, bool isComplete) {
  if (isComplete) seen_.clear();
  for (const Face& face : faces_) {
    const std::size_t place = placeOf(tree, face);
    if (place == seen_.size()) seen_.push_back({tree.axesFromPair() * face.outwards, face.offset, 0, kNothing, false});
    Seen& seen = seen_[place];
    for (std::size_t i = face.begin; i < face.end; ++i) {
      const float separation = found_[i].separation;
      if (onRim_[i]) continue;
      if (separation < face.threshold) {
        seen.behind = std::max(seen.behind, std::min(separation, 0.0F));
        continue;
      }
      seen.front = std::min(seen.front, separation);
      seen.isTouched = seen.isTouched || separation < maxSeparation;
    }
  }
}

}  // namespace cairn::bullet

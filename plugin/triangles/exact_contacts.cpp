// SPDX-License-Identifier: Zlib
#include "triangles/exact_contacts.h"

#include <algorithm>

#include "placement/unit_vector.h"
#include "triangles/charge.h"

namespace cairn::bullet {

namespace {

// Points this much (of the reach) above the deepest are as deep: a face on a face touches all over.
constexpr float kAsDeep = 0.25F;
// No deeper than so many reaches, two per cent of the size: what lies on something.
constexpr float kTouchingReaches = 10;
// Cosine of half a degree: a face that lies on a face.
constexpr float kFaceOnFaceCosine = 0.999961923F;

template <class Add>
void showTriangles(const GapWindow& window, const PlacedTree& tree, NodeId leaf, const Add& add) {
  const WindowView view = viewThrough(window, tree.toPair());
  const auto triangles = tree.tree().triangles();
  const auto vertices = tree.tree().vertices();
  for (const std::uint32_t index : tree.tree().regionTriangles(leaf)) {
    const auto& t = triangles[index];
    add({view * vertices[t[0]], view * vertices[t[1]], view * vertices[t[2]]});
  }
}

void placeTriangles(const PlacedTree& tree, NodeId leaf, std::vector<Triangle>& placed) {
  const Similarity& toPair = tree.toPair();
  const auto vertices = tree.tree().vertices();
  placed.clear();
  for (const std::uint32_t index : tree.tree().regionTriangles(leaf)) {
    const auto& t = tree.tree().triangles()[index];
    placed.push_back({toPair * vertices[t[0]], toPair * vertices[t[1]], toPair * vertices[t[2]]});
  }
}

}  // namespace

// The deepest; then, of those as deep, always the one farthest from what is chosen, if that is farther than the reach.
// The first of equals.
void ExactContacts::choose(std::span<const GapPoint> points, float reach) {
  chosen_.clear();
  if (points.empty()) return;
  chosen_.push_back(*std::ranges::min_element(points, {}, &GapPoint::gap));
  while (chosen_.size() < kMaxPoints) {
    const GapPoint* farthest = nullptr;
    float greatestSq = reach * reach;
    for (const GapPoint& p : points) {
      float nearestSq = lengthSq(p.position - chosen_[0].position);
      for (const GapPoint& c : chosen_) nearestSq = std::min(nearestSq, lengthSq(p.position - c.position));
      if (nearestSq <= greatestSq) continue;
      greatestSq = nearestSq;
      farthest = &p;
    }
    if (!farthest) return;
    chosen_.push_back(*farthest);
  }
}

// False when the budget does not cover it.
bool ExactContacts::look(const PlacedTree& a, const PlacedTree& b, const NodePair& pair, const Vec3& normal,
                         float reach, Budget& budget) {
  const Sphere ballA = a.sphere(pair.a), ballB = b.sphere(pair.b);
  const GapWindow window = windowOfBalls(normal, ballA.center, ballA.radius, ballB.center, ballB.radius, reach);
  const std::size_t moved = a.tree().regionTriangles(pair.a).size() + b.tree().regionTriangles(pair.b).size();
  if (!chargeFor(budget, kSphereUpdateCost * moved)) return false;
  gap_.begin(window);
  if (!window.isEmpty()) {
    showTriangles(window, a, pair.a, [&](const DirectionalGap::Corners& corners) { gap_.addUpper(corners); });
    showTriangles(window, b, pair.b, [&](const DirectionalGap::Corners& corners) { gap_.addLower(corners); });
  }
  return chargeFor(budget, kOverlapTestCost * gap_.pairCount());
}

// Regions part most easily along the direction they overlap least in: one that tells them deeper in each other than the
// leaves' does is wrong. A leaf that holds both sides of a body has a middle normal that points anywhere, and the far
// sides of two bodies face each other too, through both. Where they say that bodies are in each other, any direction
// may be the way out: thin ones would stay.
bool ExactContacts::isDeeper(std::span<const GapPoint> points, float gap) {
  return std::ranges::any_of(points, [&](const GapPoint& p) { return p.gap < gap; });
}

bool ExactContacts::replace(const PlacedTree& a, const PlacedTree& b, float margins, float reach, const Contact& rough,
                            Budget& budget, std::vector<Contact>& contacts) {
  const Vec3 normals[] = {rough.normal, b.facing(rough.pair.b), -a.facing(rough.pair.a)};
  for (const Vec3& normal : normals) {
    if (!look(a, b, rough.pair, normal, reach + margins, budget)) return false;
    const std::span<const GapPoint> points = gap_.run(reach + margins, kAsDeep * reach);
    // Only where nothing is near does it matter whether anything is far.
    if (points.empty() && !chargeFor(budget, kOverlapTestCost * gap_.pairCount())) return false;
    if (points.empty() && !gap_.anyOverlap()) continue;
    const bool isTouching = rough.gap > -kTouchingReaches * reach;
    const float deepest = rough.gap - reach + margins;
    if (&normal != normals && isTouching && isDeeper(points, deepest)) continue;
    choose(points, reach);
    if (const std::optional<Vec3> face = faceUnder(normal)) {
      if (!look(a, b, rough.pair, *face, reach + margins, budget)) return false;
      const std::span<const GapPoint> onFace = gap_.run(reach + margins, kAsDeep * reach);
      if (!onFace.empty() && !(isTouching && isDeeper(onFace, deepest))) {
        choose(onFace, reach);
        appendChosen(*face, margins, rough, contacts);
        return true;
      }
    }
    appendChosen(normal, margins, rough, contacts);
    return true;
  }
  return appendNearest(a, b, margins, reach, rough, budget, contacts);
}

// A leaf around an edge knows nothing of faces: where one lies on another, its normal is what holds.
std::optional<Vec3> ExactContacts::faceUnder(const Vec3& normal) const {
  if (chosen_.empty()) return {};
  const Vec3& lower = chosen_[0].lowerFace;
  const bool isFaceOnFace = dot(chosen_[0].upperFace, lower) < -kFaceOnFaceCosine;
  return isFaceOnFace && dot(lower, normal) < kFaceOnFaceCosine ? std::optional(lower) : std::nullopt;
}

void ExactContacts::appendChosen(const Vec3& normal, float margins, const Contact& rough,
                                 std::vector<Contact>& contacts) const {
  for (const GapPoint& p : chosen_) {
    Contact contact = rough;
    contact.isExact = true;
    contact.normal = normal;
    contact.gap = p.gap - margins;
    contact.exactError = std::max(0.0F, -p.gap - margins);
    contact.position = p.position;
    contacts.push_back(contact);
  }
}

// They slide past each other in all directions that were tried; only corners and edges are left to meet. What has
// crossed already overlaps where other leaves see it from the right side.
bool ExactContacts::appendNearest(const PlacedTree& a, const PlacedTree& b, float margins, float reach,
                                  const Contact& rough, Budget& budget, std::vector<Contact>& contacts) {
  const std::size_t moved =
      a.tree().regionTriangles(rough.pair.a).size() + b.tree().regionTriangles(rough.pair.b).size();
  if (!chargeFor(budget, kSphereUpdateCost * moved)) return false;
  placeTriangles(a, rough.pair.a, ofA_);
  placeTriangles(b, rough.pair.b, ofB_);
  if (!chargeFor(budget, kOverlapTestCost * ofA_.size() * ofB_.size())) return false;
  Contact nearest = rough;
  float nearestYet = reach;
  for (const Triangle& t : ofA_)
    for (const Triangle& u : ofB_) {
      const NearestPoints points = nearestOfTriangles(t, u);
      const Vec3 line = points.onFirst - points.onSecond, outwards = u.normal() - t.normal();
      const float norm = length(outwards);
      const float distance = length(line) - margins;
      if (distance >= nearestYet || !(norm > 0) || dot(line, t.normal()) > 0 || dot(line, u.normal()) < 0) continue;
      nearestYet = distance;
      nearest.normal = unitVector(outwards);
      nearest.gap = dot(nearest.normal, line) - margins;
      nearest.isCrossing = !(lengthSq(line) > 0) || trianglesCross(t, u);
      nearest.position = (points.onFirst + points.onSecond) * 0.5F;
    }
  nearest.isExact = true;
  if (nearestYet < reach) contacts.push_back(nearest);
  return true;
}

}  // namespace cairn::bullet

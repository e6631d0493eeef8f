// SPDX-License-Identifier: Zlib
#include "faces/few_faces.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "faces/mesh_view.h"

namespace cairn::bullet {

namespace {

constexpr float kCarriedCosine = 0.99862953F;  // 3 degrees, the angle within which a common normal counts as the last
// A direction that was remembered stays until another is shallower by this fraction of the sizes. Between convex bodies
// none separates better than by not overlapping: as long as they overlap by less along it no other need be asked.
constexpr float kKeptFraction = 0.003F;

constexpr float kUnknownGap = -std::numeric_limits<float>::infinity();

}  // namespace

// The bodies, seen along the remembered directions. Not cleared: there is much of it, and little of that is used.
struct FewFaces::Question {
  Question(const PlacedTree& ofTreeA, const PlacedTree& ofTreeB, const FewFaces& of, float marginsIn, float reachIn)
      : treeA(ofTreeA),
        treeB(ofTreeB),
        margins(marginsIn),
        reach(reachIn),
        a(treeA, of.outwardsA_),
        b(treeB, of.outwardsB_) {}

  const PlacedTree& treeA;
  const PlacedTree& treeB;
  float margins, reach;
  PlacedMesh a, b;
  std::array<Vec3, kMaxClusters> normal;
  std::array<GapWindow, kMaxClusters> window;
  std::array<WindowView, kMaxClusters> view;
  std::array<MeshView, kMaxClusters> ofA, ofB;  // B's against the normal: its heights count downwards

  float hysteresis() const { return kKeptFraction * (a.radius() + b.radius()); }
  // Of whole bodies.
  float separation(std::size_t k) const { return ofA[k].lowest() + ofB[k].lowest() - margins; }

  // Whether any face's normal proves that two triangles are farther apart than `far`.
  bool areApart(const TrianglePair& pair, float far) const {
    const auto separates = [&](const Vec3& axis) {
      return a.lowest(pair.ofA, axis) + b.lowest(pair.ofB, -axis) >= far ||
             a.lowest(pair.ofA, -axis) + b.lowest(pair.ofB, axis) >= far;
    };
    return std::ranges::any_of(a.outwards(), separates) || std::ranges::any_of(b.outwards(), separates);
  }

  bool isExtreme(std::size_t k, const GapPoint& point) const {
    const Vec3 half = normal[k] * (0.5F * point.gap), onA = point.position + half, onB = point.position - half;
    return ofA[k].isExtreme(a, onA, dot(normal[k], onA)) && ofB[k].isExtreme(b, onB, -dot(normal[k], onB));
  }
};

void FewFaces::reset() {
  featureCount_ = 0;
  areServed_ = false;
  treeA_ = treeB_ = nullptr;
  pairs_.clear();
}

void FewFaces::start(const SphereTree& a, const SphereTree& b) {
  areNew_ = true;
  if (treeA_ == &a && treeB_ == &b) return;
  treeA_ = &a;
  treeB_ = &b;
  areServed_ = PlacedMesh::serves(a) && PlacedMesh::serves(b);
  if (!areServed_) return;
  areConvex_ = PlacedMesh::isConvex(a) && PlacedMesh::isConvex(b);
  const auto takeOutwards = [](const SphereTree& tree, std::vector<Vec3>& outwards) {
    outwards.clear();
    for (std::size_t t = 0; t < tree.triangles().size(); ++t) outwards.push_back(PlacedMesh::outwards(tree, t));
  };
  takeOutwards(a, outwardsA_);
  takeOutwards(b, outwardsB_);
  uppers_.reserve(outwardsA_.size());
  lowers_.reserve(outwardsB_.size());
  // Convex bodies have few in common at a time.
  const std::size_t most = outwardsA_.size() * outwardsB_.size();
  pairs_.reserve(areConvex_ ? std::min(most, PlacedMesh::kMaxTriangles) : most);
  pairAt_.reserve(most);
}

void FewFaces::learn(const PlacedTree& a, const PlacedTree& b, std::span<const Vec3> normals) {
  featureCount_ = 0;
  if (!areServed_) return;
  std::size_t count = 0;
  for (const Vec3& normal : normals) {
    if (lengthSq(normal) == 0) continue;
    const std::optional<SeparatingFeature> feature = featureAlong(a, b, normal);
    if (!feature) return;
    features_[count++] = *feature;
  }
  featureCount_ = count;
}

void FewFaces::carry(const PlacedTree& a, const PlacedTree& b, std::span<Vec3> normals) const {
  for (const SeparatingFeature& feature : std::span(features_).first(featureCount_)) {
    const Vec3 now = feature.normal(a, b);
    for (Vec3& normal : normals)
      if (dot(normal, now) > kCarriedCosine) normal = now;
  }
}

void FewFaces::collect(const SphereTree& a, const SphereTree& b, std::span<const NodePair> leafPairs) {
  if (!std::exchange(areNew_, false)) return;
  pairs_.clear();
  pairAt_.assign(outwardsA_.size() * outwardsB_.size(), kNone);
  for (const NodePair& leaves : leafPairs)
    for (const std::uint32_t i : a.regionTriangles(leaves.a))
      for (const std::uint32_t j : b.regionTriangles(leaves.b)) {
        std::uint16_t& at = pairAt_[i * b.triangles().size() + j];
        if (at != kNone) continue;
        at = static_cast<std::uint16_t>(pairs_.size());
        pairs_.push_back({static_cast<std::uint8_t>(i), static_cast<std::uint8_t>(j), leaves});
      }
}

// Of convex bodies only those that have something in common: the search ends with the last that was looked for.
void FewFaces::collect(std::span<const GapPoint> points, std::span<const NodePair> leafPairs) {
  if (std::exchange(areNew_, false)) {
    pairs_.clear();
    pairAt_.assign(outwardsA_.size() * outwardsB_.size(), kNone);
  }
  std::size_t wanted = 0;
  for (const GapPoint& point : points)
    if (std::uint16_t& at = pairAt_[placeOf(point)]; at == kNone) {
      at = kWanted;
      ++wanted;
    }
  for (const NodePair& leaves : leafPairs) {
    if (wanted == 0) return;
    for (const std::uint32_t i : treeA_->regionTriangles(leaves.a))
      for (const std::uint32_t j : treeB_->regionTriangles(leaves.b)) {
        std::uint16_t& at = pairAt_[i * outwardsB_.size() + j];
        if (at != kWanted) continue;
        --wanted;
        at = static_cast<std::uint16_t>(pairs_.size());
        pairs_.push_back({static_cast<std::uint8_t>(i), static_cast<std::uint8_t>(j), leaves});
      }
  }
}

// False where a direction has become meaningless.
bool FewFaces::look(Question& question) const {
  const Sphere ballA = question.treeA.sphere(kRootNode), ballB = question.treeB.sphere(kRootNode);
  for (std::size_t k = 0; k < featureCount_; ++k) {
    const Vec3 normal = question.normal[k] = features_[k].normal(question.treeA, question.treeB);
    if (lengthSq(normal) == 0) return false;
    question.window[k] = windowOfBalls(normal, ballA.center, ballA.radius, ballB.center, ballB.radius,
                                       question.reach + question.margins);
    question.view[k] = viewThrough(question.window[k], {Mat3(), Vec3(), 1});
    question.ofA[k].look(question.a, normal);
    question.ofB[k].look(question.b, -normal);
  }
  return true;
}

std::optional<float> FewFaces::append(const PlacedTree& a, const PlacedTree& b, float margins, float reach,
                                      std::span<const NodePair> leafPairs, Budget& budget,
                                      std::vector<Contact>& contacts) {
  if (!areServed_ || (featureCount_ == 0 && !areConvex_)) return std::nullopt;
  if (leafPairs.empty()) return kUnknownGap;
  compared_ = 0;
  budget.chargeAnyway(kSphereUpdateCost * (a.tree().triangles().size() + b.tree().triangles().size()));
  Question question(a, b, *this, margins, reach);
  const std::size_t before = contacts.size();
  const std::optional<float> gap =
      areConvex_ ? appendConvex(question, leafPairs, contacts) : appendConcave(question, leafPairs, contacts);
  budget.chargeAnyway(kOverlapTestCost * compared_);
  if (!gap) contacts.resize(before);
  return gap;
}

bool FewFaces::areKept(const Question& question) const {
  for (std::size_t k = 0; k < featureCount_; ++k)
    if (question.separation(k) < -question.hysteresis()) return false;
  return true;
}

// The remembered direction as long as it serves, else the best one.
std::optional<float> FewFaces::appendConvex(Question& question, std::span<const NodePair> leafPairs,
                                            std::vector<Contact>& contacts) {
  const std::size_t before = contacts.size(), lookedAt = look(question) ? featureCount_ : 0;
  for (std::size_t k = 0; k < lookedAt; ++k)
    if (question.separation(k) >= question.reach) return question.separation(k);
  if (lookedAt > 0 && areKept(question)) {
    for (std::size_t k = 0; k < lookedAt; ++k) appendAlong(question, k, leafPairs, contacts);
    if (contacts.size() > before) return kUnknownGap;
  }
  const auto lasts = std::span(question.normal).first(lookedAt);
  // Along a direction that is preferred, but not the best, they may have nothing in common.
  for (const bool hasPreferences : {true, false}) {
    const Separation best = bestSeparation(question.treeA, question.treeB, question.a, question.b, lasts,
                                           question.hysteresis(), question.reach + question.margins, hasPreferences);
    features_[0] = best.feature;
    featureCount_ = 1;
    const float gap = best.gap - question.margins;
    if (gap >= question.reach) return gap;
    if (!look(question)) return std::nullopt;
    appendAlong(question, 0, leafPairs, contacts);
    if (contacts.size() > before) return kUnknownGap;
    // Apart, but not face to face: what leaves say of that may be deep, and is wrong.
    if (gap >= 0) return gap;
  }
  return std::nullopt;
}

// Of convex bodies all that lies low enough is shown: what it has in common tells by itself which triangles touch.
void FewFaces::showAlong(const Question& question, std::size_t k) {
  const MeshView &a = question.ofA[k], &b = question.ofB[k];
  const float far = question.reach + question.margins;
  gap_.begin(question.window[k]);
  uppers_.clear();
  lowers_.clear();
  for (std::size_t t = 0; t < outwardsA_.size(); ++t)
    if (a.faces(t) && a.lowest(t) + b.lowest() < far && gap_.addUpper(question.a.corners(t, question.view[k])))
      uppers_.push_back(static_cast<std::uint8_t>(t));
  for (std::size_t t = 0; t < outwardsB_.size(); ++t)
    if (b.faces(t) && b.lowest(t) + a.lowest() < far && gap_.addLower(question.b.corners(t, question.view[k])))
      lowers_.push_back(static_cast<std::uint8_t>(t));
}

std::size_t FewFaces::placeOf(const GapPoint& point) const {
  return uppers_[point.upper] * outwardsB_.size() + lowers_[point.lower];
}

void FewFaces::appendAlong(const Question& question, std::size_t k, std::span<const NodePair> leafPairs,
                           std::vector<Contact>& contacts) {
  showAlong(question, k);
  compared_ += gap_.pairCount();
  const std::span<const GapPoint> points =
      gap_.run(question.reach + question.margins, std::numeric_limits<float>::infinity());
  collect(points, leafPairs);
  for (const GapPoint& point : points) {
    const std::uint16_t pair = pairAt_[placeOf(point)];
    if (pair != kWanted && question.isExtreme(k, point)) append(question, k, pairs_[pair].leaves, point, contacts);
  }
}

std::optional<float> FewFaces::appendConcave(Question& question, std::span<const NodePair> leafPairs,
                                             std::vector<Contact>& contacts) {
  if (!look(question)) return std::nullopt;
  collect(question.a.tree(), question.b.tree(), leafPairs);
  compared_ = pairs_.size();
  const std::size_t before = contacts.size();
  bool areApart = true;
  for (const TrianglePair& pair : pairs_) {
    const Answer answer = ask(question, pair, contacts);
    if (answer == Answer::unknown) return std::nullopt;
    areApart = areApart && answer == Answer::apart;
  }
  // Near each other, and no face on a face: an edge or a corner may be what touches.
  return areApart || contacts.size() > before ? std::optional(kUnknownGap) : std::nullopt;
}

FewFaces::Answer FewFaces::ask(const Question& question, const TrianglePair& pair, std::vector<Contact>& contacts) {
  bool isExplained = false;
  for (std::size_t k = 0; k < featureCount_; ++k) {
    const MeshView &a = question.ofA[k], &b = question.ofB[k];
    const float lowestA = a.lowest(pair.ofA), lowestB = b.lowest(pair.ofB);
    if (lowestA + lowestB - question.margins >= question.reach) return Answer::apart;
    if (a.isFlush(pair.ofA) && b.isFlush(pair.ofB)) {
      if (!appendCommon(question, k, pair, contacts)) return Answer::unknown;
      isExplained = true;
    }
    if (isExplained || lowestA + lowestB - question.margins < -question.reach) continue;
    const float far = question.margins + question.reach;
    isExplained =
        a.isSaidByFlush(question.a, pair.ofA, far - lowestB) && b.isSaidByFlush(question.b, pair.ofB, far - lowestA);
  }
  if (isExplained) return Answer::explained;
  const float far = question.margins + question.reach;
  return question.areApart(pair, far) ? Answer::apart : Answer::unknown;
}

// False where they are deeper than the reach: another direction may be the right one.
bool FewFaces::appendCommon(const Question& question, std::size_t k, const TrianglePair& pair,
                            std::vector<Contact>& contacts) {
  gap_.begin(question.window[k]);
  gap_.addUpper(question.a.corners(pair.ofA, question.view[k]));
  gap_.addLower(question.b.corners(pair.ofB, question.view[k]));
  for (const GapPoint& point : gap_.run(question.reach + question.margins, std::numeric_limits<float>::infinity())) {
    if (point.gap - question.margins < -question.reach) return false;
    append(question, k, pair.leaves, point, contacts);
  }
  return true;
}

void FewFaces::append(const Question& question, std::size_t k, const NodePair& leaves, const GapPoint& point,
                      std::vector<Contact>& contacts) const {
  Contact contact;
  contact.normal = question.normal[k];
  contact.gap = point.gap - question.margins;
  contact.exactError = std::max(0.0F, -point.gap - question.margins);
  contact.position = point.position;
  contact.pair = leaves;
  contact.id = {static_cast<int>(question.a.tree().level(leaves.a)), static_cast<int>(leaves.a),
                static_cast<int>(question.b.tree().level(leaves.b)), static_cast<int>(leaves.b)};
  contact.isExact = true;
  contacts.push_back(contact);
}

}  // namespace cairn::bullet

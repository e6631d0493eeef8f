// SPDX-License-Identifier: GPL-3.0-or-later
#include "bare_traversal.h"

#include <algorithm>
#include <cmath>

#include "cairn/core/tree_pair_traversal.h"
#include "random_tree.h"
#include "reference_traversal.h"
#include "require.h"
#include "trees_from_bytes.h"

namespace cairn::fuzz {
namespace {

// Beyond this the squares of an overlap test leave float's range, and everything may be named.
constexpr double kMaxLength = 1e15;
constexpr int kMaxStops = 64;
constexpr std::size_t kMaxAsked = 64;

/// Two trees where the bytes set them down.
struct Scene {
  KnownTree a, b;
  Pose poseA, poseB;
  float margin = 0;

  /// From a point of A's surface to one of B's, world axes. Differences first: what both are far away by cancels.
  Vec3d between(const SurfacePoint& p, const SurfacePoint& q) const {
    const Vec3d ofA = poseA.rotation * (Vec3d(p.point) * poseA.scale);
    const Vec3d ofB = poseB.rotation * (Vec3d(q.point) * poseB.scale);
    return poseB.translation - poseA.translation + ofB - ofA;
  }
  double apart() const { return length(poseB.translation - poseA.translation); }
  double reachA() const { return poseA.scale * double(a.tree->extent()); }
  double reachB() const { return poseB.scale * double(b.tree->extent()); }
  double lengths() const { return apart() + reachA() + reachB(); }
  bool isTestable() const { return lengths() < kMaxLength * std::min({poseA.scale, poseB.scale, 1.0}); }

  void start(TreePairTraversal& traversal) const { traversal.start(*a.tree, *b.tree, poseA, poseB, margin); }
};

Mat3d turnFrom(Bytes& bytes) {
  const std::uint8_t seed = bytes.next();
  if (seed == 0) return {};
  std::mt19937_64 engine(seed);
  return test::randomRotation(engine);
}

Vec3d directionFrom(Bytes& bytes) {
  return normalized(Vec3d{bytes.between(-1, 1), bytes.between(-1, 1), bytes.between(-1, 1)} + Vec3d(1e-3, 0, 0));
}

/// One in the other, points of the surfaces in one place, root balls that just touch, near, or absurdly far apart.
Vec3d offsetFrom(Bytes& bytes, const Scene& scene) {
  const double reach = scene.reachA() + scene.reachB();
  const std::uint32_t kind = bytes.below(5);
  switch (kind) {
    case 0:
      return {};
    case 1: {
      const auto any = [&](const KnownTree& tree) {
        return tree.surface[bytes.below(std::uint32_t(tree.surface.size()))];
      };
      const SurfacePoint p = any(scene.a);
      return scene.between(p, any(scene.b)) * -1.0;
    }
    default:
      break;
  }
  const Vec3d direction = directionFrom(bytes);
  if (kind == 2) return direction * (reach * (1 + bytes.between(-1, 1) * 1e-6));
  return direction * (reach * (kind == 3 ? bytes.part() : std::pow(10.0, bytes.below(20))));
}

Scene sceneFrom(Bytes& bytes) {
  Scene scene{knownTreeFrom(bytes), {}, {}, {}};
  scene.b = bytes.below(4) == 0 ? scene.a : knownTreeFrom(bytes);
  for (Pose* pose : {&scene.poseA, &scene.poseB}) {
    pose->rotation = turnFrom(bytes);
    pose->scale = bytes.powerOfTen(3);
  }
  if (bytes.below(4) == 0) scene.poseB = scene.poseA;
  scene.poseB.translation = offsetFrom(bytes, scene);
  Vec3d away = directionFrom(bytes);
  away *= bytes.below(4) == 0 ? std::pow(10.0, bytes.below(10)) : 0.0;
  scene.poseA.translation += away;
  scene.poseB.translation += away;
  if (bytes.below(2) != 0) return scene;
  const double part = bytes.part();
  scene.margin = static_cast<float>(scene.reachA() * part * bytes.powerOfTen(2));
  return scene;
}

bool isBelow(const SphereTree& tree, NodeId node, NodeId ancestor) {
  while (node != ancestor && node != kRootNode) node = tree.nodeAt(tree.node(node).parent);
  return node == ancestor;
}

bool isNamed(const Scene& scene, const Traversal& traversal, const NodePair& leaves) {
  const auto holds = [&](const NodePair& pair) {
    return isBelow(*scene.a.tree, leaves.a, pair.a) && isBelow(*scene.b.tree, leaves.b, pair.b) &&
           traversal.mayTouch(pair);
  };
  return std::ranges::any_of(traversal.front(), holds) || std::ranges::any_of(traversal.leafPairs(), holds);
}

/// Leaves whose surfaces have points no farther apart than the margin, by brute force; some of them.
std::vector<NodePair> touchingLeaves(const Scene& scene) {
  std::vector<NodePair> touching;
  for (const SurfacePoint& p : scene.a.surface)
    for (const SurfacePoint& q : scene.b.surface) {
      if (length(scene.between(p, q)) > double(scene.margin)) continue;
      touching.push_back({p.leaf, q.leaf});
      if (touching.size() == kMaxAsked) return touching;
    }
  return touching;
}

void requireNothingMissed(const Scene& scene, const Traversal& traversal, std::span<const NodePair> touching) {
  for (const NodePair& pair : touching) require(isNamed(scene, traversal, pair), "surfaces that touch are not named");
}

/// Balls that overlap by the test, whose slack counts twice for the sum of two frames.
void requireNearEnough(const Scene& scene, const Traversal& traversal, std::span<const NodePair> pairs) {
  const double slack = 2 * double(kOverlapSlack) * scene.lengths();
  const std::size_t stride = pairs.size() / kMaxAsked + 1;
  for (std::size_t i = 0; i < pairs.size(); i += stride) {
    if (!traversal.mayTouch(pairs[i])) continue;
    const double allowed =
        double(traversal.pairError(pairs[i])) + double(scene.margin) * (1 + double(kOverlapSlack)) + slack;
    const bool isNear = std::ranges::any_of(scene.a.surface, [&](const SurfacePoint& p) {
      return isBelow(*scene.a.tree, p.leaf, pairs[i].a) &&
             std::ranges::any_of(scene.b.surface, [&](const SurfacePoint& q) {
               return isBelow(*scene.b.tree, q.leaf, pairs[i].b) && length(scene.between(p, q)) <= allowed;
             });
    });
    require(isNear, "a pair is named whose surfaces are farther apart than certified");
  }
}

void requireErrors(TreePairTraversal& traversal) {
  for (const auto& pairs : {traversal.front(), traversal.leafPairs()})
    for (const NodePair& pair : pairs) {
      const float error = traversal.pairError(pair);
      require(std::isfinite(error) && error >= 0, "a pair's error is negative or no number");
    }
  require(traversal.worstFrontError() == traversal.worstOf(traversal.front()), "the front's worst error is another");
}

void requireSame(const Traversal& x, const Traversal& y, const char* what) {
  require(std::ranges::equal(x.front(), y.front()) && std::ranges::equal(x.leafPairs(), y.leafPairs()), what);
}

/// As one that was given all of it at once, and as the plain twin after as much work.
void requireSameAsUncut(const Scene& scene, const TreePairTraversal& stopped, std::uint64_t spent) {
  TreePairTraversal uncut;
  scene.start(uncut);
  Budget budget = Budget::operations(spent);
  (void)uncut.refine(budget);
  require(budget.used() == spent, "a stopped traversal spent what one in one go does not");
  requireSame(stopped, uncut, "a stopped traversal stands elsewhere than one that was never stopped");
  test::ReferenceTraversal plain(*scene.a.tree, *scene.b.tree, scene.poseA, scene.poseB, scene.margin);
  for (std::uint64_t used = 0; used < spent;) used += plain.refineOne();
  require(std::ranges::equal(stopped.front(), plain.front) && std::ranges::equal(stopped.leafPairs(), plain.leafPairs),
          "a traversal found other pairs than its plain twin");
}

}  // namespace

void checkBareTraversal(Bytes& bytes) {
  const Scene scene = sceneFrom(bytes);
  const std::vector<NodePair> touching = touchingLeaves(scene);
  TreePairTraversal traversal;
  scene.start(traversal);
  std::uint64_t spent = 0;
  const std::uint32_t looksAt = bytes.below(kMaxStops);
  for (int stop = 0; !traversal.done(); ++stop) {
    const bool isLast = stop == kMaxStops;
    const std::uint64_t given = isLast ? Budget::kUnlimited : bytes.below(300);
    Budget budget = Budget::operations(given);
    const Progress progress = traversal.refine(budget);
    require(budget.used() <= given, "a budget was exceeded");
    require((progress == Progress::done) == traversal.done(), "a traversal is done and does not say so");
    spent += budget.used();
    requireErrors(traversal);
    requireNothingMissed(scene, traversal, touching);
    if (std::uint32_t(stop) != looksAt && !isLast) continue;
    requireSameAsUncut(scene, traversal, spent);
    if (scene.isTestable()) requireNearEnough(scene, traversal, traversal.front());
  }
  requireErrors(traversal);
  requireNothingMissed(scene, traversal, touching);
  requireSameAsUncut(scene, traversal, spent);
  if (scene.isTestable()) requireNearEnough(scene, traversal, traversal.leafPairs());
  traversal.movePoses(scene.poseB, scene.poseA);
  requireErrors(traversal);
  traversal.abandon();
  require(traversal.done() && traversal.worstError() == 0, "an abandoned traversal knows pairs");
}

}  // namespace cairn::fuzz

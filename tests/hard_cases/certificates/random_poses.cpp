// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <string>

#include "cairn/core/tree_pair_traversal.h"
#include "certificate_cases.h"
#include "certificates/small_solids.h"
#include "placement/tree_pose.h"
#include "scenes/truth/placed_body.h"

// Two bodies anywhere about each other, asked of the trees, cut short at some budget, and of the meshes, exactly:
//
//       .---.                         trees say nothing  ->  surfaces have no point in common
//      ( A   ) .---.
//       '---' (  B  )                 trees name a pair  ->  no farther apart than any pair's error
//              '---'
namespace cairn::hard {
namespace {

constexpr std::uint64_t kBudgets[] = {10, 100, 1000, Budget::kUnlimited};

struct PosesFound {
  std::uint64_t poses = 0, meeting = 0, apartButNamed = 0, missed = 0, tooFar = 0;
  double deepestMissed = 0;
  double gapOverError = 0;  ///< the largest gap between the surfaces of a named pair, over the least of its errors

  void look(const SmallSolid& solidA, const SmallSolid& solidB, const bullet::SphereTreeShape& shapeA,
            const bullet::SphereTreeShape& shapeB, std::mt19937_64& engine);
};

void PosesFound::look(const SmallSolid& solidA, const SmallSolid& solidB, const bullet::SphereTreeShape& shapeA,
                      const bullet::SphereTreeShape& shapeB, std::mt19937_64& engine) {
  const btScalar reach = (shapeA.getAngularMotionDisc() + shapeB.getAngularMotionDisc()) * btScalar(1.1);
  const btTransform bodyA(randomTurn(engine), randomDirection(engine) * 10);
  const btTransform bodyB(randomTurn(engine),
                          bodyA.getOrigin() + randomDirection(engine) * (reach * btScalar(test::uniform(engine))));
  const Pose poseA = bullet::treePose(shapeA, bodyA), poseB = bullet::treePose(shapeB, bodyB);
  TreePairTraversal traversal;
  traversal.start(*solidA.tree, *solidB.tree, poseA, poseB, 0);
  Budget budget = Budget::operations(kBudgets[poses % std::size(kBudgets)]);
  (void)traversal.refine(budget);
  double least = HUGE_VAL;
  for (const auto& pairs : {traversal.front(), traversal.leafPairs()})
    for (const NodePair& pair : pairs) least = std::min(least, double(traversal.pairError(pair)));

  ++poses;
  // Nothing named: asked exactly only where boxes leave it open, as `surfacesMeet` does by itself.
  const auto bFromA = scenes::relativePlacement(scenes::placementOf(bodyA * shapeA.bodyFromTree()),
                                                scenes::placementOf(bodyB * shapeB.bodyFromTree()));
  const bool meet = scenes::surfacesMeet(*solidA.surface, *solidB.surface, bFromA);
  meeting += meet ? 1 : 0;
  if (meet && std::isinf(least)) {
    ++missed;
    const double tolerance = 1e-4 * double(std::min(shapeA.size(), shapeB.size()));
    deepestMissed =
        std::max(deepestMissed, scenes::mutualPenetration(*solidA.surface, *solidB.surface, bFromA, tolerance));
  }
  if (meet || std::isinf(least)) return;
  ++apartButNamed;
  // The traversal's own slack: balls this far apart still count as overlapping (twice, for the sum of two frames).
  const double lengths =
      length(poseB.translation - poseA.translation) + double(solidA.tree->extent() + solidB.tree->extent());
  const double allowed = least + 2 * double(kOverlapSlack) * lengths;
  const double gap = scenes::surfaceDistance(*solidA.surface, *solidB.surface, bFromA);
  tooFar += gap > allowed ? 1 : 0;
  gapOverError = std::max(gapOverError, gap / allowed);
}

Outcome runRandomPoses(Effort effort) {
  const bool quick = effort == Effort::quick;
  const std::vector<SmallSolid> solids = smallSolids(2);
  std::vector<std::unique_ptr<bullet::SphereTreeShape>> shapes;
  for (const SmallSolid& solid : solids) shapes.push_back(shapeOf(solid.tree));
  std::mt19937_64 engine(32);
  PosesFound found;
  const std::uint64_t poses = quick ? 2000 : 1000000;
  while (found.poses < poses) {
    const std::size_t a = engine() % solids.size(), b = engine() % solids.size();
    found.look(solids[a], solids[b], *shapes[a], *shapes[b], engine);
  }
  const std::string all = "of " + std::to_string(found.poses) + " poses";
  return {{{"surfaces that meet and are not named", double(found.missed), 0, Bound::atMost,
            "of " + std::to_string(found.meeting), "", 0},
           {"the deepest of them", found.deepestMissed, 0, Bound::atMost, "m", "", 0},
           {"named, and farther apart than certified", double(found.tooFar), 0, Bound::atMost,
            "of " + std::to_string(found.apartButNamed), "", 0},
           {"widest gap over the certified one", found.gapOverError, 1, Bound::atMost, all, "", 0}},
          ""};
}

}  // namespace

HardCase randomPoses() {
  return {"C2", "pairs of trees in random poses against an exact check",
          "1e6 poses of pairs of four solids, traversals cut after 10, 100, 1000 operations or none: no surfaces that "
          "meet are missed, however shallow; no pair is named whose surfaces are farther apart than the least of its "
          "certified errors, and twice the slack of 2^-18 of the lengths that overlap tests have",
          runRandomPoses};
}

}  // namespace cairn::hard

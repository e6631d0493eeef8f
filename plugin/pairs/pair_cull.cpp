// SPDX-License-Identifier: Zlib
#include "pairs/pair_cull.h"

#include <algorithm>

#include "pairs/body_motion.h"
#include "placement/bullet_math.h"

namespace cairn::bullet {

namespace {

bool isStillSeparated(const TreePair& pair, const btCollisionObjectWrapper& body0,
                      const btCollisionObjectWrapper& body1, bool asksTriangles, float travel) {
  const float maxSeparation = pair.sizes.speculative + travel;
  if (!pair.subject.isKnown() || !pair.contacts.mayBeSeparated(maxSeparation)) return false;
  const PairSides sides = PairSides::of(body0, body1, pair.treeIsBody0);
  const SphereTreeShape* const tree = sides.shape();
  if (!tree || !pair.subject.is(*tree, sides.otherShape())) return false;
  return pair.contacts.isStillSeparated(PairMotion::placementOf(sides), maxSeparation, asksTriangles);
}

// Most pairs are culled step after step; they keep the statistics of their last answer for when they no longer are.
void noteDistant(TreePair& pair, const PairSides& sides) {
  pair.handles.note(sides.tree);
  pair.distantBy = toVec3(sides.tree.getCollisionObject()->getWorldTransform().getOrigin() -
                          sides.other.getCollisionObject()->getWorldTransform().getOrigin());
  if (pair.is(PairStage::distant) && pair.subject.is(*sides.shape(), sides.otherShape())) return;
  pair.adopt(sides);
  pair.forgetWaiting();
  pair.contacts.cullSeparated(pair.distantBy);
}

}  // namespace

bool cullSeparated(TreePair& pair, const btCollisionObjectWrapper& body0, const btCollisionObjectWrapper& body1,
                   bool alsoFromGround, const StepHorizon& horizon) {
  const float fast = fastTravel(body0, body1, horizon.sweptTime);
  const float travel = std::max(fast, wallTravel(body0, body1, horizon.wallTime));
  pair.trajectory.isFast = fast > 0 || pair.trajectory.isAnchored();
  PairStage culled = PairStage::separated;
  if (!isStillSeparated(pair, body0, body1, horizon.asksTriangles, travel)) {
    if (cullNonFinite(pair, body0, body1)) return true;
    const std::optional<RootSpheres> roots = rootSpheres(body0, body1);
    if ((!roots && !alsoFromGround) || !areRootsSeparated(body0, body1, roots, btScalar(travel))) {
      pair.motion.roots = roots;
      if (pair.is(PairStage::distant)) pair.contacts.cullSeparated(pair.distantBy);
      return false;
    }
    pair.treeIsBody0 = asSphereTree(body0.getCollisionShape()) != nullptr;
    noteDistant(pair, PairSides::of(body0, body1, pair.treeIsBody0));
    culled = PairStage::distant;
  }
  pair.clearManifolds();  // a guard may remain
  pair.enter(culled);
  return true;
}

bool cullNonFinite(TreePair& pair, const btCollisionObjectWrapper& body0, const btCollisionObjectWrapper& body1) {
  if (!isNonFinite(body0) && !isNonFinite(body1)) return false;
  forgetNonFinite(pair);
  return true;
}

bool isLeftOver(const TreePair& pair) {
  return pair.reported.mayHavePoints && pair.manifolds.areOfNonFinite();
}

void forgetNonFinite(TreePair& pair) {
  pair.forget();
  pair.enter(PairStage::nonFinite);
}

}  // namespace cairn::bullet

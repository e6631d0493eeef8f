// SPDX-License-Identifier: Zlib
#include "pairs/pair_settle.h"

#include <algorithm>

#include "pairs/body_motion.h"
#include "placement/bullet_math.h"

namespace cairn::bullet {

namespace {

bool isStillApart(const TreePair& pair, const btCollisionObjectWrapper& body0, const btCollisionObjectWrapper& body1,
                  bool asksTriangles, float travel) {
  const float reach = pair.sizes.speculative + travel;
  if (!pair.subject.isKnown() || !pair.contacts.mayBeApart(reach)) return false;
  const PairSides sides = PairSides::of(body0, body1, pair.treeIsBody0);
  const SphereTreeShape* const tree = sides.shape();
  if (!tree || !pair.subject.is(*tree, sides.otherShape())) return false;
  return pair.contacts.stillApart(PairMotion::placementOf(sides), reach, asksTriangles);
}

// Most pairs are so step after step: what they said then is theirs when they no longer are.
void noteAway(TreePair& pair, const PairSides& sides) {
  pair.handles.note(sides.tree);
  pair.awayBy = toVec3(sides.tree.getCollisionObject()->getWorldTransform().getOrigin() -
                       sides.other.getCollisionObject()->getWorldTransform().getOrigin());
  if (pair.is(PairStage::away) && pair.subject.is(*sides.shape(), sides.otherShape())) return;
  pair.adopt(sides);
  pair.forgetWaiting();
  pair.contacts.settleApart(pair.awayBy);
}

}  // namespace

bool settleApart(TreePair& pair, const btCollisionObjectWrapper& body0, const btCollisionObjectWrapper& body1,
                 bool alsoFromGround, const Outlook& outlook) {
  const float fast = fastTravel(body0, body1, outlook.sweptTime);
  const float travel = std::max(fast, wallTravel(body0, body1, outlook.wallTime));
  pair.course.isFast = fast > 0 || pair.course.isAnchored();
  PairStage settled = PairStage::apart;
  if (!isStillApart(pair, body0, body1, outlook.asksTriangles, travel)) {
    if (settleBroken(pair, body0, body1)) return true;
    const std::optional<RootSpheres> roots = rootSpheres(body0, body1);
    if ((!roots && !alsoFromGround) || !areRootsApart(body0, body1, roots, btScalar(travel))) {
      pair.motion.roots = roots;
      if (pair.is(PairStage::away)) pair.contacts.settleApart(pair.awayBy);
      return false;
    }
    pair.treeIsBody0 = asSphereTree(body0.getCollisionShape()) != nullptr;
    noteAway(pair, PairSides::of(body0, body1, pair.treeIsBody0));
    settled = PairStage::away;
  }
  pair.clearManifolds();  // a guard may have been left
  pair.enter(settled);
  return true;
}

bool settleBroken(TreePair& pair, const btCollisionObjectWrapper& body0, const btCollisionObjectWrapper& body1) {
  if (!isBroken(body0) && !isBroken(body1)) return false;
  forgetBroken(pair);
  return true;
}

bool isLeftOver(const TreePair& pair) {
  return pair.said.mayHavePoints && pair.manifolds.areOfBroken();
}

void forgetBroken(TreePair& pair) {
  pair.forget();
  pair.enter(PairStage::broken);
}

}  // namespace cairn::bullet

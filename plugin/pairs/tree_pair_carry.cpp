// SPDX-License-Identifier: Zlib
// Pairs that lie still: what was said of them is said again.
#include "kernel/contact_tuning.h"
#include "pairs/tree_pair.h"
#include "placement/bullet_math.h"

namespace cairn::bullet {

std::optional<PairReport> TreePair::carryOver() {
  if (isFast_ || wasAhead_ || isHeld_ || !isPlaced_ || !contacts_.isOfKernel()) return {};
  const btCollisionObjectWrapper &treeBody = treeIsBody0_ ? body0() : body1(),
                                 &otherBody = treeIsBody0_ ? body1() : body0();
  const SphereTreeShape* const tree = asSphereTree(treeBody.getCollisionShape());
  const btCollisionShape& other = *otherBody.getCollisionShape();
  if (!tree || !isSubject(*tree, asSphereTree(&other), other)) return {};
  const RelativePlacement now = relativePlacement(*tree, treeBody.getWorldTransform(), otherBody.getWorldTransform());
  const auto moved = static_cast<float>(now.displacementSince(motion_.placement));
  if (moved > tuning::kCarried * speculative_) return {};
  seenAt_ = now;
  origin_ = treeBody.getWorldTransform().getOrigin();
  center_ = toVec3d((treeIsBody0_ == treeIsSmaller_ ? body0() : body1()).getWorldTransform().getOrigin());
  carryPoints(true, false);
  countSaid();
  PairReport report;
  report.contacts = report.exactContacts = saidContacts_;
  report.manifolds = saidManifolds_;
  report.errorFraction = heldError_ + double(moved / smallerSize_);
  return report;
}

}  // namespace cairn::bullet

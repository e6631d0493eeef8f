// SPDX-License-Identifier: Zlib
#include "pairs/pair_collect.h"

namespace cairn::bullet {

bool collect(TreePair& pair, const btCollisionObjectWrapper& body0, const btCollisionObjectWrapper& body1) {
  pair.age.repeatsLast = false;
  pair.enter(PairStage::collected);
  pair.handles.note(PairSides::of(body0, body1).tree);
  return pair.bodies.take(body0, body1);
}

bool follow(TreePair& pair) {
  pair.age.repeatsLast = false;
  pair.enter(PairStage::collected);
  return pair.bodies.follow();
}

}  // namespace cairn::bullet

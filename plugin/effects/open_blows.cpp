// SPDX-License-Identifier: Zlib
#include "open_blows.h"

#include <BulletDynamics/Dynamics/btRigidBody.h>

#include <algorithm>
#include <utility>

#include "cairn/effects/effect_set.h"
#include "surface_motion.h"

namespace cairn::effects {
namespace {

// Smallest blow, as a fraction of the closing momentum. A contact that is still a whole step ahead and has no say still
// gets the step's gravity. A blow at the end of a long rod is a hundredth.
constexpr btScalar kMinPart = btScalar(1e-3);

bool isSame(const Impact& a, const Impact& b) {
  const btCollisionObject *a0 = a.sides[0].object, *a1 = a.sides[1].object;
  const btCollisionObject *b0 = b.sides[0].object, *b1 = b.sides[1].object;
  return (a0 == b0 && a1 == b1) || (a0 == b1 && a1 == b0);
}

bool hasBite(const Impact& impact) {
  return impact.impulse * impact.closingSpeed > kMinPart * 2 * impact.energy();
}

// The surfaces still close fast, where they closed fastest.
bool stillCloses(const Impact& impact) {
  const btVector3 now =
      velocityAt(*impact.sides[0].object, impact.place) - velocityAt(*impact.sides[1].object, impact.place);
  return -now.dot(impact.normal) > EffectSet::kImpactSpeed;
}

}  // namespace

void OpenBlows::inherit(std::span<Impact> pending) {
  for (Impact& impact : pending) {
    const auto found = std::ranges::find_if(open_, [&](const Blow& blow) { return isSame(blow.impact, impact); });
    if (found == open_.end()) continue;
    found->goesOn = true;
    impact = found->impact;
  }
}

void OpenBlows::drop(const btCollisionObject& object) {
  std::erase_if(open_, [&](const Blow& blow) {
    return blow.impact.sides[0].object == &object || blow.impact.sides[1].object == &object;
  });
}

std::span<const Impact> OpenBlows::settle(std::span<const Impact> pending) {
  over_.clear();
  next_.clear();
  for (const Blow& blow : open_)
    if (!blow.goesOn) over_.push_back(blow.impact);
  for (const Impact& impact : pending) {
    if (!hasBite(impact)) continue;
    if (stillCloses(impact))
      next_.push_back({impact});
    else
      over_.push_back(impact);
  }
  std::swap(open_, next_);
  return over_;
}

}  // namespace cairn::effects

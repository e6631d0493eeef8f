// SPDX-License-Identifier: Zlib
#include "cairn/effects/fragmentation.h"

#include <BulletDynamics/Dynamics/btRigidBody.h>

#include <algorithm>
#include <utility>

namespace cairn::effects {

void Fragmentation::dismiss(Body& body) {
  breakable_.erase(body.id);
  std::erase_if(breaks_, [&](const Break& b) { return b.bodyId == body.id; });
}

void Fragmentation::setBreakable(std::uint32_t bodyId, FragmentPart part, std::uint32_t generation) {
  if (part.pieces.size() > 1 && generation < options_.maxGenerations)
    breakable_.insert_or_assign(bodyId, Breakable{std::move(part), generation});
}

const FragmentPart* Fragmentation::partOf(std::uint32_t bodyId) const {
  const auto found = breakable_.find(bodyId);
  return found == breakable_.end() ? nullptr : &found->second.part;
}

std::uint32_t Fragmentation::afterImpacts(std::span<const Impact> impacts, const Step& /*step*/) {
  std::uint32_t broken = 0;
  if (breakable_.empty()) return broken;
  for (const Impact& impact : impacts)
    for (const Side& side : impact.sides)
      if (side.body != nullptr && strike(*side.body, impact)) ++broken;
  return broken;
}

bool Fragmentation::strike(const Body& body, const Impact& impact) {
  const btScalar energyPerMass = impact.energy() * body.body->getInvMass();
  if (!(energyPerMass > options_.energyPerMass)) return false;
  const auto found = breakable_.find(body.id);
  if (found == breakable_.end()) return false;
  if (std::ranges::any_of(breaks_, [&](const Break& b) { return b.bodyId == body.id; })) return false;
  const Breakable& breakable = found->second;
  breaks_.push_back({body.body, body.id, nearestPiece(*body.body, breakable.part, impact.place), breakable.generation,
                     energyPerMass, impact.place});
  return true;
}

}  // namespace cairn::effects

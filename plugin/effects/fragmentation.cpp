// SPDX-License-Identifier: Zlib
#include "cairn/effects/fragmentation.h"

#include <BulletCollision/NarrowPhaseCollision/btManifoldPoint.h>
#include <BulletDynamics/Dynamics/btRigidBody.h>

#include <algorithm>
#include <utility>

namespace cairn::effects {

void Fragmentation::dismiss(Body& body) {
  breakable_.erase(body.id);
  std::erase_if(breaks_, [&](const Break& b) { return b.bodyId == body.id; });
  std::erase_if(siblings_, [&](const Siblings& s) { return s.ids[0] == body.id || s.ids[1] == body.id; });
}

void Fragmentation::setSiblings(std::span<const std::uint32_t> bodyIds) {
  for (std::size_t i = 0; i < bodyIds.size(); ++i)
    for (std::size_t j = i + 1; j < bodyIds.size(); ++j)
      siblings_.push_back({{std::min(bodyIds[i], bodyIds[j]), std::max(bodyIds[i], bodyIds[j])}});
}

// The solver gets depth zero: it stops closing, and pushes nothing out.
bool Fragmentation::holdApart(Contact& contact) {
  if (contact.sides[0].body == nullptr || contact.sides[1].body == nullptr) return false;
  const auto ids = std::minmax(contact.sides[0].body->id, contact.sides[1].body->id);
  const auto found = std::ranges::find_if(
      siblings_, [&](const Siblings& s) { return s.ids[0] == ids.first && s.ids[1] == ids.second; });
  if (found == siblings_.end()) return false;
  found->touch = true;
  contact.point->m_distance1 = std::max(contact.point->m_distance1, btScalar(0));
  return true;
}

std::uint32_t Fragmentation::changeContacts(std::span<Contact> contacts, const Step& /*step*/) {
  if (siblings_.empty()) return 0;
  for (Siblings& siblings : siblings_) siblings.touch = false;
  for (Contact& contact : contacts) holdApart(contact);
  std::erase_if(siblings_, [](const Siblings& s) { return !s.touch; });
  return 0;  // breaks count
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

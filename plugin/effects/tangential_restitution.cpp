// SPDX-License-Identifier: Zlib
#include "cairn/effects/tangential_restitution.h"

#include <BulletCollision/NarrowPhaseCollision/btManifoldPoint.h>
#include <BulletDynamics/Dynamics/btRigidBody.h>

namespace cairn::effects {

TangentialRestitution::TangentialRestitution(PairTable<btScalar> parts)
    : parts_(std::move(parts)), acts_(parts_.holds([](btScalar part) { return part < 1; })) {}

void TangentialRestitution::welcome(Body& body) {
  if (flights_.size() <= body.id) flights_.resize(body.id + 1);
  flights_[body.id] = {step_.number, false};
}

const Body* TangentialRestitution::bouncerOf(const std::array<Side, 2>& sides) const {
  if (!(parts_.at(sides[0].material, sides[1].material) < 1)) return nullptr;
  const bool stands0 = sides[0].object->isStaticObject(), stands1 = sides[1].object->isStaticObject();
  if (stands0 == stands1) return nullptr;
  return sides[stands0 ? 1 : 0].body;
}

// In this step: it has flown, or its bounce takes more than one step.
bool TangentialRestitution::mayBounce(const Body& body) const {
  const Flight& flight = flights_[body.id];
  const std::uint64_t steps = step_.number - flight.touched;
  if (steps <= 1) return flight.bounces;
  const btScalar flown = static_cast<btScalar>(steps) * step_.timeStep;
  return flown * flown * step_.gravity.length() >= 2 * kFallenRadii * body.radius;
}

std::uint32_t TangentialRestitution::changeContacts(std::span<Contact> contacts, const Step& step) {
  step_ = step;
  changed_.clear();
  for (Contact& contact : contacts) {
    if (contact.impact < 0) continue;
    const Body* body = bouncerOf(contact.sides);
    if (body == nullptr || !mayBounce(*body)) continue;
    btManifoldPoint& point = *contact.point;
    changed_.push_back(
        {&point, point.m_combinedFriction, point.m_combinedRollingFriction, point.m_combinedSpinningFriction});
    point.m_combinedFriction = point.m_combinedRollingFriction = point.m_combinedSpinningFriction = 0;
    contact.rollingLength = contact.spinningLength = 0;
    contact.ordersBlow = false;  // without friction the order of corners takes no spin
  }
  return 0;  // the bounces count, once they have come
}

void TangentialRestitution::restoreContacts(std::span<Contact> contacts) {
  for (const Changed& changed : changed_) {
    changed.point->m_combinedFriction = changed.friction;
    changed.point->m_combinedRollingFriction = changed.rolling;
    changed.point->m_combinedSpinningFriction = changed.spinning;
  }
  const auto bears = [](const Contact& contact) { return contact.point->getAppliedImpulse() > 0; };
  for (const Contact& contact : contacts)
    if (const Body* body = bouncerOf(contact.sides); contact.impact >= 0 && body != nullptr && bears(contact))
      flights_[body->id].bounces = mayBounce(*body);
  for (const Contact& contact : contacts)
    for (const Side& side : contact.sides)
      if (side.body != nullptr && bears(contact)) flights_[side.body->id].touched = step_.number;
}

std::uint32_t TangentialRestitution::afterImpacts(std::span<const Impact> impacts, const Step& /*step*/) {
  std::uint32_t acted = 0;
  for (const Impact& impact : impacts) {
    const Body* bouncer = bouncerOf(impact.sides);
    const bool bounces = bouncer != nullptr && flights_[bouncer->id].bounces;
    for (const Side& side : impact.sides)
      if (side.body != nullptr) flights_[side.body->id].bounces = false;
    if (!bounces) continue;
    btRigidBody& body = *bouncer->body;
    const std::size_t side = impact.sides[0].body == bouncer ? 0 : 1;
    const btScalar part = parts_.at(impact.sides[0].material, impact.sides[1].material);
    const auto along = [&](const btVector3& v) { return v - impact.normal * impact.normal.dot(v); };
    const btVector3 now = body.getLinearVelocity();
    // Impulses of other contacts in the meantime stay.
    const btVector3 before = along(impact.linearBefore[side]), after = along(now);
    const btVector3 kept = after.length2() < before.length2() ? after : before;
    body.setLinearVelocity(now - after + kept * part);
    ++acted;
  }
  return acted;
}

}  // namespace cairn::effects

// SPDX-License-Identifier: Zlib
#include "blow_order.h"

#include <BulletCollision/NarrowPhaseCollision/btManifoldPoint.h>
#include <BulletDynamics/Dynamics/btRigidBody.h>

#include <algorithm>

#include "cairn/effects/effect_set.h"
#include "surface_motion.h"

namespace cairn::effects {
namespace {

// m; what is so far off does not touch in a step, however fast.
constexpr btScalar kNoSay = btScalar(1e6);

bool isInBlow(const Contact& contact) {
  return contact.impact >= 0 && contact.closingSpeed > EffectSet::kImpactSpeed;
}

// Had the surfaces come on like this.
btScalar sinceTouch(const Contact& contact) {
  return -contact.distance / contact.closingSpeed;
}

// Of the smaller one that has a volume; zero if none has.
btScalar radiusOf(const Contact& contact) {
  btScalar least = 0;
  for (const Side& side : contact.sides)
    if (side.body != nullptr && side.body->radius > 0)
      least = least > 0 ? std::min(least, side.body->radius) : side.body->radius;
  return least;
}

// A place on a body that its spin carries on, against its centre.
btVector3 turned(const btCollisionObject& object, const btVector3& place, btScalar time) {
  const btRigidBody* body = btRigidBody::upcast(&object);
  if (body == nullptr || body->isStaticOrKinematicObject()) return place;
  const btVector3 &spin = body->getAngularVelocity(), &center = body->getCenterOfMassPosition();
  const btScalar rate = spin.length();
  if (rate * time < SIMD_EPSILON) return place;
  return center + (place - center).rotate(spin / rate, rate * time);
}

}  // namespace

void BlowOrder::arrange(std::span<Contact> contacts, const Step& step) {
  changed_.clear();
  findFirst(contacts);
  if (std::ranges::none_of(firsts_, &First::isAsked)) return;
  for (Contact& contact : contacts) {
    const btScalar radius = radiusOf(contact);
    if (!isInOrder(contact) || !(radius > 0)) continue;
    const First& first = firstOf(contact);
    if (!first.isAsked || first.isDeep) continue;
    const btScalar later = first.sinceTouch - sinceTouch(contact);
    if (later * contact.closingSpeed > kTogetherRadii * radius)
      actLater(contact);
    else if (contact.distance > 0)
      actAtTouch(contact, step);
  }
}

BlowOrder::First& BlowOrder::firstOf(const Contact& contact) {
  return firsts_[static_cast<std::size_t>(contact.impact)];
}

bool BlowOrder::isInOrder(const Contact& contact) {
  return isInBlow(contact) && contact.closingSpeed >= kSlowestPart * firstOf(contact).fastest;
}

void BlowOrder::findFirst(std::span<const Contact> contacts) {
  firsts_.clear();
  for (const Contact& contact : contacts) {
    if (!isInBlow(contact)) continue;
    if (const auto impacts = static_cast<std::size_t>(contact.impact) + 1; firsts_.size() < impacts)
      firsts_.resize(impacts);
    First& first = firstOf(contact);
    first.fastest = std::max(first.fastest, contact.closingSpeed);
  }
  for (const Contact& contact : contacts)
    if (isInOrder(contact)) note(contact);
}

void BlowOrder::note(const Contact& contact) {
  First& first = firstOf(contact);
  first.sinceTouch = first.isKnown ? std::max(first.sinceTouch, sinceTouch(contact)) : sinceTouch(contact);
  first.isKnown = true;
  first.isAsked = first.isAsked || contact.ordersBlow;
  first.isDeep = first.isDeep || -contact.distance > radiusOf(contact);
}

void BlowOrder::remember(const Contact& contact) {
  const btManifoldPoint& point = *contact.point;
  changed_.push_back({contact.point, point.m_distance1, point.m_positionWorldOnA, point.m_positionWorldOnB});
}

// The solver passes it over, and leaves the impulses that it had: they are none of this step's.
void BlowOrder::actLater(Contact& contact) {
  remember(contact);
  btManifoldPoint& point = *contact.point;
  point.m_distance1 = kNoSay;
  point.m_appliedImpulse = point.m_appliedImpulseLateral1 = point.m_appliedImpulseLateral2 = 0;
}

// A corner that comes down ahead of a rolling body is under it by then. Contacts that do not touch within the step stay
// unchanged.
void BlowOrder::actAtTouch(Contact& contact, const Step& step) {
  const btScalar time = -sinceTouch(contact);
  if (time > step.timeStep) return;
  btManifoldPoint& point = *contact.point;
  const btCollisionObject &a = *contact.sides[0].object, &b = *contact.sides[1].object;
  const btVector3 onA = turned(a, point.m_positionWorldOnA, time), onB = turned(b, point.m_positionWorldOnB, time);
  const btVector3 velocity = velocityAt(a, onA) - velocityAt(b, onB);
  const btScalar closing = -velocity.dot(point.m_normalWorldOnB);
  if (closing <= EffectSet::kImpactSpeed) return;
  remember(contact);
  point.m_distance1 = 0;
  point.m_positionWorldOnA = onA;
  point.m_positionWorldOnB = onB;
  contact.relativeVelocity = velocity;
  contact.closingSpeed = closing;
}

void BlowOrder::restore() {
  for (const Changed& changed : changed_) {
    changed.point->m_distance1 = changed.distance;
    changed.point->m_positionWorldOnA = changed.onA;
    changed.point->m_positionWorldOnB = changed.onB;
  }
  changed_.clear();
}

}  // namespace cairn::effects

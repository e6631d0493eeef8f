// SPDX-License-Identifier: Zlib
#include "step_contacts.h"

#include <BulletCollision/BroadphaseCollision/btDispatcher.h>
#include <BulletCollision/NarrowPhaseCollision/btPersistentManifold.h>
#include <BulletDynamics/Dynamics/btRigidBody.h>

#include <algorithm>
#include <utility>

#include "cairn/effects/effect_set.h"
#include "surface_motion.h"

namespace cairn::effects {
namespace {

std::uint64_t pairOf(const btPersistentManifold& manifold) {
  auto a = static_cast<std::uint32_t>(manifold.getBody0()->getWorldArrayIndex());
  auto b = static_cast<std::uint32_t>(manifold.getBody1()->getWorldArrayIndex());
  if (a > b) std::swap(a, b);
  return std::uint64_t(a) << 32 | b;
}

void rememberMotion(Impact& impact) {
  for (std::size_t i = 0; i < 2; ++i) {
    const btRigidBody* body = btRigidBody::upcast(impact.sides[i].object);
    impact.linearBefore[i] = body != nullptr ? body->getLinearVelocity() : btVector3(0, 0, 0);
    impact.angularBefore[i] = body != nullptr ? body->getAngularVelocity() : btVector3(0, 0, 0);
  }
}

}  // namespace

void StepContacts::gather(btDispatcher& dispatcher, const SideBook& book) {
  contacts_.clear();
  ranges_.clear();
  for (int i = 0; i < dispatcher.getNumManifolds(); ++i) add(*dispatcher.getManifoldByIndexInternal(i), book);
  formImpacts();
}

void StepContacts::add(btPersistentManifold& manifold, const SideBook& book) {
  if (manifold.getNumContacts() == 0) return;
  const btCollisionObject &a = *manifold.getBody0(), &b = *manifold.getBody1();
  if ((a.isStaticOrKinematicObject() || !a.isActive()) && (b.isStaticOrKinematicObject() || !b.isActive())) return;
  if (!a.hasContactResponse() || !b.hasContactResponse()) return;
  const SideBook::Entry *first = book.find(a), *second = book.find(b);
  if (first == nullptr || second == nullptr) return;
  Range range{pairOf(manifold), contacts_.size(), 0, false};
  for (int i = 0; i < manifold.getNumContacts(); ++i) {
    btManifoldPoint& point = manifold.getContactPoint(i);
    Contact contact;
    contact.point = &point;
    contact.sides = {first->side(a, point.getPositionWorldOnA()), second->side(b, point.getPositionWorldOnB())};
    contact.relativeVelocity = velocityAt(a, point.getPositionWorldOnA()) - velocityAt(b, point.getPositionWorldOnB());
    contact.closingSpeed = -contact.relativeVelocity.dot(point.m_normalWorldOnB);
    range.isFast = range.isFast || contact.closingSpeed > EffectSet::kImpactSpeed;
    contacts_.push_back(contact);
  }
  range.end = contacts_.size();
  ranges_.push_back(range);
}

void StepContacts::formImpacts() {
  pairs_.clear();
  for (const Range& range : ranges_)
    if (range.isFast) pairs_.push_back(range.pair);
  std::sort(pairs_.begin(), pairs_.end());
  pairs_.erase(std::unique(pairs_.begin(), pairs_.end()), pairs_.end());
  impacts_.assign(pairs_.size(), Impact{});
  if (pairs_.empty()) return;
  for (const Range& range : ranges_) {
    const auto found = std::lower_bound(pairs_.begin(), pairs_.end(), range.pair);
    if (found == pairs_.end() || *found != range.pair) continue;
    const auto number = static_cast<std::int32_t>(found - pairs_.begin());
    join(range, impacts_[static_cast<std::size_t>(number)], number);
  }
  for (Impact& impact : impacts_) rememberMotion(impact);
  blows_.inherit(impacts_);
}

void StepContacts::join(const Range& range, Impact& impact, std::int32_t number) {
  for (std::size_t i = range.first; i < range.end; ++i) {
    Contact& contact = contacts_[i];
    contact.impact = number;
    if (contact.closingSpeed <= impact.closingSpeed) continue;
    impact.sides = contact.sides;
    impact.place = contact.point->getPositionWorldOnB();
    impact.normal = contact.point->m_normalWorldOnB;
    impact.relativeVelocity = contact.relativeVelocity;
    impact.closingSpeed = contact.closingSpeed;
  }
}

std::span<const Impact> StepContacts::finish() {
  for (const Contact& contact : contacts_)
    if (contact.impact >= 0)
      impacts_[static_cast<std::size_t>(contact.impact)].impulse += contact.point->getAppliedImpulse();
  return blows_.settle(impacts_);
}

}  // namespace cairn::effects

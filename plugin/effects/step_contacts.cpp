// SPDX-License-Identifier: Zlib
#include "step_contacts.h"

#include <BulletCollision/BroadphaseCollision/btDispatcher.h>
#include <BulletCollision/CollisionShapes/btCollisionShape.h>
#include <BulletCollision/NarrowPhaseCollision/btPersistentManifold.h>
#include <BulletDynamics/Dynamics/btRigidBody.h>

#include <algorithm>
#include <utility>

#include "cairn/effects/effect_set.h"
#include "memory/fetch_ahead.h"
#include "surface_motion.h"

namespace cairn::effects {
namespace {

// How an object moves in this step, forces not counted.
struct Motion {
  explicit Motion(const btCollisionObject& object) {
    const btRigidBody* body = btRigidBody::upcast(&object);
    isMoving = body != nullptr && !body->isStaticObject();
    if (!isMoving) return;
    linear = body->getLinearVelocity();
    angular = body->getAngularVelocity();
    center = body->getCenterOfMassPosition();
  }
  btVector3 at(const btVector3& place) const { return linear + angular.cross(place - center); }

  bool isMoving;
  btVector3 linear{0, 0, 0}, angular{0, 0, 0}, center{0, 0, 0};
};

btScalar closingSpeed(const btManifoldPoint& point, const Motion& a, const Motion& b) {
  return (b.at(point.getPositionWorldOnB()) - a.at(point.getPositionWorldOnA())).dot(point.m_normalWorldOnB);
}

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

void WantedContacts::add(const Hooks& hooks) {
  hooks_.push_back(hooks);
  known_ = PairTable<unsigned>(kUnknown);
  version_ = 0;
}

unsigned WantedContacts::of(MaterialId a, MaterialId b) {
  if (const unsigned known = known_.at(a, b); known != kUnknown) return known;
  unsigned wishes = kNothing;
  for (const Hooks& hooks : hooks_) {
    if (hooks.material != nullptr && hooks.material->concerns(a, b)) wishes |= kContacts;
    if (hooks.event != nullptr || (hooks.impact != nullptr && hooks.impact->concerns(a, b))) wishes |= kImpacts;
  }
  known_.set(a, b, wishes);
  return wishes;
}

bool WantedContacts::anyOf(const SideBook& book) {
  if (version_ != book.version()) {
    version_ = book.version();
    any_ = !hooks_.empty() && book.anyTwo([&](MaterialId a, MaterialId b) { return of(a, b) != kNothing; });
  }
  return any_;
}

void StepContacts::gather(btDispatcher& dispatcher, SideBook& book, WantedContacts& wanted) {
  contacts_.clear();
  ranges_.clear();
  impacts_.clear();
  if (!wanted.anyOf(book)) return;
  ++step_;
  const int count = dispatcher.getNumManifolds();
  btPersistentManifold** manifolds = dispatcher.getInternalManifoldPointer();
  // Whom a manifold is about it says behind its points, in the 32 bytes before this field, far from the next one's.
  constexpr int kAhead = 6, kBytes = 32;
  for (int i = 0; i < count; ++i) {
    if (i + kAhead < count) {
      const auto* behind = reinterpret_cast<const char*>(&manifolds[i + kAhead]->m_companionIdA);
      bullet::fetchAhead(behind - kBytes, kBytes);
    }
    add(*manifolds[i], book, wanted);
  }
  formImpacts();
}

void StepContacts::add(btPersistentManifold& manifold, SideBook& book, WantedContacts& wanted) {
  if (manifold.getNumContacts() == 0) return;
  const btCollisionObject &a = *manifold.getBody0(), &b = *manifold.getBody1();
  if ((a.isStaticOrKinematicObject() || !a.isActive()) && (b.isStaticOrKinematicObject() || !b.isActive())) return;
  if (!a.hasContactResponse() || !b.hasContactResponse()) return;
  const SideBook::Entry *first = book.find(a), *second = book.find(b);
  if (first == nullptr || second == nullptr) return;
  const bool isMapped = first->traits.map != nullptr || second->traits.map != nullptr;
  const unsigned wishes =
      isMapped ? WantedContacts::kContacts : wanted.of(first->traits.material, second->traits.material);
  Range range{pairOf(manifold), &manifold, first, second, 0, 0, false};
  if ((wishes & WantedContacts::kContacts) != 0)
    list(range);
  else if ((wishes & WantedContacts::kImpacts) != 0)
    range.isFast = hasFast(manifold);
  else
    return;
  ranges_.push_back(range);
}

// Bullet keeps contacts until they are a fiftieth of the disc off it.
btScalar StepContacts::speedOf(const btCollisionObject& object) {
  constexpr btScalar kBeyondTheDisc = btScalar(1.05);
  if (object.getWorldArrayIndex() < 0) return BT_LARGE_FLOAT;  // in no world's list: its contacts are looked at
  const auto place = static_cast<std::size_t>(object.getWorldArrayIndex());
  if (speeds_.size() <= place) speeds_.resize(place + 1);
  Speed& known = speeds_[place];
  if (known.step == step_) return known.speed;
  const Motion motion(object);
  known = {step_, 0};
  if (!motion.isMoving) return 0;
  known.speed = motion.linear.length();
  if (!motion.angular.fuzzyZero())
    known.speed += motion.angular.length() * object.getCollisionShape()->getAngularMotionDisc() * kBeyondTheDisc;
  return known.speed;
}

// Whether a contact closes at the speed of a blow.
bool StepContacts::hasFast(const btPersistentManifold& manifold) {
  const btCollisionObject &a = *manifold.getBody0(), &b = *manifold.getBody1();
  if (speedOf(a) + speedOf(b) <= EffectSet::kImpactSpeed) return false;
  const Motion one(a), two(b);
  for (int i = 0; i < manifold.getNumContacts(); ++i)
    if (closingSpeed(manifold.getContactPoint(i), one, two) > EffectSet::kImpactSpeed) return true;
  return false;
}

void StepContacts::list(Range& range) {
  btPersistentManifold& manifold = *range.manifold;
  const btCollisionObject &a = *manifold.getBody0(), &b = *manifold.getBody1();
  const Motion one(a), two(b);
  range.first = contacts_.size();
  for (int i = 0; i < manifold.getNumContacts(); ++i) {
    btManifoldPoint& point = manifold.getContactPoint(i);
    Contact& contact = contacts_.emplace_back();
    contact.point = &point;
    contact.sides = {range.sideA->side(a, point.getPositionWorldOnA()),
                     range.sideB->side(b, point.getPositionWorldOnB())};
    contact.relativeVelocity = one.at(point.getPositionWorldOnA()) - two.at(point.getPositionWorldOnB());
    contact.closingSpeed = -contact.relativeVelocity.dot(point.m_normalWorldOnB);
    range.isFast = range.isFast || contact.closingSpeed > EffectSet::kImpactSpeed;
  }
  range.end = contacts_.size();
}

void StepContacts::formImpacts() {
  pairs_.clear();
  for (const Range& range : ranges_)
    if (range.isFast) pairs_.push_back(range.pair);
  std::sort(pairs_.begin(), pairs_.end());
  pairs_.erase(std::unique(pairs_.begin(), pairs_.end()), pairs_.end());
  impacts_.assign(pairs_.size(), Impact{});
  if (pairs_.empty()) return;
  for (Range& range : ranges_) {
    const auto found = std::lower_bound(pairs_.begin(), pairs_.end(), range.pair);
    if (found == pairs_.end() || *found != range.pair) continue;
    if (range.first == range.end) list(range);
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

// SPDX-License-Identifier: Zlib
#include "step_contacts.h"

#include <BulletCollision/BroadphaseCollision/btDispatcher.h>
#include <BulletCollision/CollisionShapes/btCollisionShape.h>
#include <BulletCollision/NarrowPhaseCollision/btPersistentManifold.h>
#include <BulletDynamics/Dynamics/btRigidBody.h>

#include <algorithm>
#include <array>
#include <utility>

#include "cairn/effects/effect_set.h"
#include "platform/prefetch.h"
#include "surface_motion.h"

namespace cairn::effects {
namespace {

// How an object moves in this step, forces not counted.
struct Motion {
  explicit Motion(const btCollisionObject& object) {
    const btRigidBody* body = btRigidBody::upcast(&object);
    // An object that is both static and kinematic moves: Bullet derives its speed from its poses.
    isMoving = body != nullptr && (!body->isStaticObject() || body->isKinematicObject());
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

bool rests(const btCollisionObject& object) {
  return object.isStaticOrKinematicObject() || !object.isActive();
}

std::uint64_t pairOf(const btPersistentManifold& manifold) {
  auto a = static_cast<std::uint32_t>(manifold.getBody0()->getWorldArrayIndex());
  auto b = static_cast<std::uint32_t>(manifold.getBody1()->getWorldArrayIndex());
  if (a > b) std::swap(a, b);
  return std::uint64_t(a) << 32 | b;
}

/// Tells at a glance that a number is in none of those added; what it does not tell so may be in.
class Glance {
 public:
  void add(std::uint64_t pair) { word(pair) |= bit(pair); }
  bool mayHold(std::uint64_t pair) { return (word(pair) & bit(pair)) != 0; }

 private:
  static std::uint64_t mixed(std::uint64_t pair) { return (pair >> 32) * 31 + pair; }
  static std::uint64_t bit(std::uint64_t pair) { return std::uint64_t(1) << (mixed(pair) % 64); }
  std::uint64_t& word(std::uint64_t pair) { return words_[(mixed(pair) / 64) % words_.size()]; }

  std::array<std::uint64_t, 64> words_{};
};

void rememberMotion(Impact& impact) {
  for (std::size_t i = 0; i < 2; ++i) {
    const btRigidBody* body = btRigidBody::upcast(impact.sides[i].object);
    impact.linearBefore[i] = body != nullptr ? body->getLinearVelocity() : btVector3(0, 0, 0);
    impact.angularBefore[i] = body != nullptr ? body->getAngularVelocity() : btVector3(0, 0, 0);
  }
}

// Whom a manifold is about and how many points it has it says behind its points, in the 32 bytes before this field, far
// from the next one's; where there are points, the first one's places and its normal are looked at too.
void prefetch(btPersistentManifold* const* manifolds, int i, int count) {
  constexpr int kFirst = 8, kSecond = 4, kBytes = 32;
  if (i + kFirst >= count) return;
  const auto* behind = reinterpret_cast<const char*>(&manifolds[i + kFirst]->m_companionIdA);
  bullet::prefetch(behind - kBytes, kBytes);
  const btPersistentManifold& near = *manifolds[i + kSecond];
  if (near.getNumContacts() == 0) return;
  const btManifoldPoint& point = near.getContactPoint(0);
  bullet::prefetch(&point.m_positionWorldOnB, 3 * sizeof(btVector3));
}

}  // namespace

void WantedContacts::add(const Hooks& hooks) {
  hooks_.push_back(hooks);
  known_ = PairTable<unsigned>(kUnknown);
  version_ = 0;
  onlyImpacts_ = onlyImpacts_ && hooks.material == nullptr;
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
  const int count = dispatcher.getNumManifolds();
  btPersistentManifold** manifolds = dispatcher.getInternalManifoldPointer();
  for (int i = 0; i < count; ++i) {
    prefetch(manifolds, i, count);
    add(*manifolds[i], book, wanted);
  }
  formImpacts(book, wanted);
}

void StepContacts::add(btPersistentManifold& manifold, SideBook& book, WantedContacts& wanted) {
  if (manifold.getNumContacts() == 0) return;
  if (rests(*manifold.getBody0()) && rests(*manifold.getBody1())) return;
  Range range{pairOf(manifold), &manifold, 0, 0, false};
  if (wanted.onlyImpacts()) {
    // Most close slowly, and no more is asked of these, unless another manifold of their pair is fast.
    range.isFast = hasFast(manifold) && wishesFor(manifold, book, wanted) != WantedContacts::kNothing;
  } else {
    const unsigned wishes = wishesFor(manifold, book, wanted);
    if (wishes == WantedContacts::kNothing) return;
    if ((wishes & WantedContacts::kContacts) != 0)
      list(range, book);
    else
      range.isFast = hasFast(manifold);
  }
  ranges_.push_back(range);
}

unsigned StepContacts::wishesFor(const btPersistentManifold& manifold, SideBook& book, WantedContacts& wanted) {
  const btCollisionObject &a = *manifold.getBody0(), &b = *manifold.getBody1();
  if (!a.hasContactResponse() || !b.hasContactResponse()) return WantedContacts::kNothing;
  const SideBook::Entry *first = book.find(a), *second = book.find(b);
  if (first == nullptr || second == nullptr) return WantedContacts::kNothing;
  const bool isMapped = first->traits.map != nullptr || second->traits.map != nullptr;
  return isMapped ? WantedContacts::kContacts : wanted.of(first->traits.material, second->traits.material);
}

// Whether a contact closes at the speed of a blow.
bool StepContacts::hasFast(const btPersistentManifold& manifold) {
  const Motion one(*manifold.getBody0()), two(*manifold.getBody1());
  for (int i = 0; i < manifold.getNumContacts(); ++i)
    if (closingSpeed(manifold.getContactPoint(i), one, two) > EffectSet::kImpactSpeed) return true;
  return false;
}

void StepContacts::list(Range& range, SideBook& book) {
  btPersistentManifold& manifold = *range.manifold;
  const btCollisionObject &a = *manifold.getBody0(), &b = *manifold.getBody1();
  const SideBook::Entry &sideA = *book.find(a), &sideB = *book.find(b);
  const Motion one(a), two(b);
  range.first = static_cast<std::uint32_t>(contacts_.size());
  for (int i = 0; i < manifold.getNumContacts(); ++i) {
    btManifoldPoint& point = manifold.getContactPoint(i);
    Contact& contact = contacts_.emplace_back();
    contact.point = &point;
    contact.distance = point.m_distance1;
    contact.sides = {sideA.side(a, point.getPositionWorldOnA()), sideB.side(b, point.getPositionWorldOnB())};
    contact.relativeVelocity = one.at(point.getPositionWorldOnA()) - two.at(point.getPositionWorldOnB());
    contact.closingSpeed = -contact.relativeVelocity.dot(point.m_normalWorldOnB);
    range.isFast = range.isFast || contact.closingSpeed > EffectSet::kImpactSpeed;
  }
  range.end = static_cast<std::uint32_t>(contacts_.size());
}

void StepContacts::formImpacts(SideBook& book, WantedContacts& wanted) {
  pairs_.clear();
  for (const Range& range : ranges_)
    if (range.isFast) pairs_.push_back(range.pair);
  std::sort(pairs_.begin(), pairs_.end());
  pairs_.erase(std::unique(pairs_.begin(), pairs_.end()), pairs_.end());
  impacts_.assign(pairs_.size(), Impact{});
  if (pairs_.empty()) return;
  Glance fast;
  for (const std::uint64_t pair : pairs_) fast.add(pair);
  for (Range& range : ranges_) {
    if (!fast.mayHold(range.pair)) continue;
    const auto found = std::lower_bound(pairs_.begin(), pairs_.end(), range.pair);
    if (found == pairs_.end() || *found != range.pair) continue;
    const bool isListed = range.first != range.end;
    // Objects in no world, or in another, may have the places of those that strike.
    if (!isListed && wishesFor(*range.manifold, book, wanted) == WantedContacts::kNothing) continue;
    if (!isListed) list(range, book);
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

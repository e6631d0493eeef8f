// SPDX-License-Identifier: Zlib
#pragma once

#include <BulletCollision/CollisionDispatch/btManifoldResult.h>

#include <array>
#include <span>

#include "cairn/bullet/contact_points.h"
#include "contacts/contact.h"
#include "contacts/reduction.h"
#include "contacts/relative_motion.h"

namespace cairn::bullet {

/// Flags of a locked pair's points, beside `kGuardFlag`: of all, and of those that forbid parting.
inline constexpr int kLockedFlag = 1 << 28, kOppositeFlag = 1 << 27;

/// The ids of the contacts that a manifold holds now.
struct ManifoldContacts {
  std::array<ContactId, kMaxPoints> id;
  int count = 0;

  std::span<const ContactId> span() const { return {id.data(), static_cast<std::size_t>(count)}; }
};

/// Reads the ids of a manifold's points, the tree's side first. `treeIsBody0`: the tree is the manifold's body 0.
ManifoldContacts contactsIn(const btPersistentManifold& manifold, bool treeIsBody0);

/// Changes Bullet's manifolds of one pair to the contacts chosen in this step.
///
///     ManifoldWriter writer(result, origin, treeIsBody0, inheritance, motion);
///     writer.write(manifold, chosen);
///
/// Bullet recognises an old point by its position alone. So the writer first gives each new contact the old point that
/// it continues:
///
/// 1. the nearest within `inheritance` that has the same id,
/// 2. else the nearest within `inheritance`,
/// 3. else the nearest with the same id.
///
/// It moves that point onto the contact, and `addContactPoint` replaces exactly this point. The point keeps its
/// impulses, its age and its user data, and friction and callbacks remain Bullet's work. Old points without a contact
/// are removed. A manifold that stays in contact is never empty in between. Points of slow bodies end in the order of
/// `putDeepestLast`.
class ManifoldWriter {
 public:
  /// `origin`: of the pair frame, in the world. `treeIsBody0`: the tree is the manifolds' body 0. `inheritance`: the
  /// distance (world length, in body 0's frame) by which a contact may move in a step and still inherit by position.
  /// `motion` gives the closing speeds; it must outlive the writer.
  ManifoldWriter(btManifoldResult& result, const btVector3& origin, bool treeIsBody0, float inheritance,
                 const RelativeMotion& motion)
      : result_(result), origin_(origin), treeIsBody0_(treeIsBody0), inheritance_(inheritance), motion_(motion) {}

  /// Precondition: `chosen` holds at most `kMaxPoints` contacts.
  void write(btPersistentManifold& manifold, std::span<const Contact> chosen);

 private:
  struct Matching;

  btVector3 localOnBody0(const btPersistentManifold& manifold, const Contact& contact) const;
  template <class MayJoin>
  static void joinNearest(Matching& matching, const btPersistentManifold& manifold, std::size_t choice,
                          btScalar nearestSq, const MayJoin& mayJoin);
  Matching match(const btPersistentManifold& manifold, std::span<const Contact> chosen) const;
  void add(btPersistentManifold& manifold, const Contact& contact);
  static void placeSpeculative(const btPersistentManifold& manifold, btManifoldPoint& point, const Contact& contact,
                               const btVector3& onBody1);
  void setSolverDistance(btManifoldPoint& point, const Contact& contact) const;

  btManifoldResult& result_;
  btVector3 origin_;
  bool treeIsBody0_;
  float inheritance_;
  const RelativeMotion& motion_;
};

}  // namespace cairn::bullet

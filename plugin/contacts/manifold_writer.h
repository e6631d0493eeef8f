// SPDX-License-Identifier: Zlib
#pragma once

#include <BulletCollision/CollisionDispatch/btManifoldResult.h>

#include <array>
#include <span>

#include "contacts/contact.h"
#include "contacts/reduction.h"
#include "contacts/relative_motion.h"

namespace cairn::bullet {

/// Of a point's flags: its contact is a guard. None of Bullet's own.
inline constexpr int kGuardFlag = 1 << 29;

/// The ids of the contacts a manifold holds now.
struct ManifoldContacts {
  std::array<ContactId, kMaxPoints> id;
  int count = 0;

  std::span<const ContactId> span() const { return {id.data(), static_cast<std::size_t>(count)}; }
};

/// The ids of a manifold's points, the tree's first. `treeIsBody0`: in the order of its bodies.
ManifoldContacts contactsIn(const btPersistentManifold& manifold, bool treeIsBody0);

/// Brings Bullet's manifolds of one pair to the contacts chosen in this step.
///
/// Bullet recognises an old point by its position alone. So each new contact is first given the old point it continues
/// (the nearest within `inheritance`, of the same id before others, else one of the same id that is farther away), that
/// point is moved onto it, and `addContactPoint` then replaces exactly that one: it keeps its impulses, its age and its
/// user's data, and friction and callbacks are Bullet's own business. Points that are continued by no contact are
/// removed; a manifold that stays in contact is never empty in between. Where the bodies are slow, what comes of it
/// is in the order of `putDeepestLast`.
class ManifoldWriter {
 public:
  /// `origin`: the pair frame's, in the world. `treeIsBody0`: in the order of the manifolds' bodies. `inheritance`: how
  /// far (world length, in body 0's frame) a contact may have moved in a step and still inherit by position. `motion`
  /// says how fast contacts close; it must outlive the writer.
  ManifoldWriter(btManifoldResult& result, const btVector3& origin, bool treeIsBody0, float inheritance,
                 const RelativeMotion& motion)
      : result_(result), origin_(origin), treeIsBody0_(treeIsBody0), inheritance_(inheritance), motion_(motion) {}

  /// `chosen`: at most as many as a manifold holds.
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
  void tellSolver(btManifoldPoint& point, const Contact& contact) const;

  btManifoldResult& result_;
  btVector3 origin_;
  bool treeIsBody0_;
  float inheritance_;
  const RelativeMotion& motion_;
};

}  // namespace cairn::bullet

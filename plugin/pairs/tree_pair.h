// SPDX-License-Identifier: Zlib
#pragma once

#include <BulletCollision/CollisionDispatch/btManifoldResult.h>

#include <atomic>
#include <memory>
#include <span>
#include <utility>

#include "contacts/manifold_writer.h"
#include "pairs/collider_kinds.h"
#include "pairs/pair_age.h"
#include "pairs/pair_bodies.h"
#include "pairs/pair_contacts.h"
#include "pairs/pair_handles.h"
#include "pairs/pair_manifolds.h"
#include "pairs/pair_motion.h"
#include "pairs/pair_notes.h"
#include "pairs/pair_subject.h"
#include "pairs/pair_trajectory.h"
#include "pairs/pair_work.h"

namespace cairn::bullet {

/// How far a pair has come in a step. It is culled or collected. A collected pair is reused, or carried over, or begun
/// and finished.
enum class PairStage : std::uint8_t {
  idle,       ///< not asked about in this step
  separated,  ///< culled by cached separations
  distant,    ///< culled by bounding spheres; nothing else is known
  nonFinite,  ///< culled because a body is non-finite
  collected,  ///< its bodies are copied
  estimated,  ///< its cost and urgency are known
  begun,      ///< its collider is placed, its traversal started or resumed
};

/// Whether a pair is at rest: Bullet does not ask about sleeping bodies.
enum class PairRest : std::uint8_t {
  asked,    ///< since the last look
  unasked,  ///< not since the last look
  trimmed,  ///< not since the last two looks: it gave unused memory back
};

/// All that is known of one sphere-tree and its collider from step to step, from the creation of Bullet's algorithm to
/// its destruction. Each action on a pair is a file: pair_cull.h, pair_collect.h, pair_estimation.h, pair_reuse.h,
/// pair_begin.h, pair_measure.h, pair_write.h, pair_finish.h, pair_carry_over.h. The first members decide whether
/// anything has to be done in a step: for most pairs of a heap nothing else is read.
struct alignas(64) TreePair {
  /// Points that follow their bodies lose their meaning after this motion, as a fraction of the smaller body's size.
  static constexpr float kMaxFollowed = 0.04F;

  explicit TreePair(ColliderKind colliderKind) : kind(colliderKind), collider(makeCollider(colliderKind)) {}

  ColliderKind kind;
  bool treeIsBody0 = true;
  std::atomic<PairStage> stage{PairStage::idle};  // atomic, because threads prefetch each other's pairs
  PairRest rest = PairRest::asked;
  ReportedContacts reported;
  PairSizes sizes;
  PairTrajectory trajectory;
  PairHandles handles;
  Vec3 distantBy;  ///< from the other body's centre to the tree's
  PairSubject subject;
  PairContacts contacts;
  // Then the data for the estimate, which is read where there is not enough for all pairs.
  PairMotion motion;
  std::unique_ptr<Collider> collider;
  PairAge age;
  PairWork work;
  PairNotes notes;
  PairManifolds manifolds;
  PairBodies bodies;

  /// Prepares for a new pair of bodies and releases the trees. Precondition: no manifolds.
  void reset();
  void enter(PairStage next) { stage.store(next, std::memory_order_relaxed); }
  bool is(PairStage asked) const { return stage.load(std::memory_order_relaxed) == asked; }
  bool isCulled() const { return is(PairStage::separated) || is(PairStage::distant) || is(PairStage::nonFinite); }
  bool isBegun() const { return is(PairStage::begun); }
  /// The copied bodies, tree first.
  PairSides sides() const { return PairSides::of(bodies.body0(), bodies.body1(), treeIsBody0); }
  Traversal& traversal() { return collider->traversal(); }
  bool isDone() const { return std::as_const(*collider).traversal().done(); }
  /// Whether the other body is ground, from which bodies come up however deep they are.
  bool isOnGround() const { return kind == ColliderKind::terrain || kind == ColliderKind::plane; }
  /// Whether the pair may repeat its last answer until its traversal is done.
  bool mayRepeatLast() const { return motion.roots && age.repeatsLast && !trajectory.isFast; }

  /// Takes these shapes and forgets knowledge about others. False, and nothing known, where the shapes cannot meet.
  /// Where only vertices moved, manifolds keep their points, whose impulses the next contacts of the same features
  /// inherit.
  bool adopt(const PairSides& sides);
  /// Forgets all knowledge about the shapes; contacts end.
  void forget();
  /// Forgets where the surfaces were. Contacts stay as they are, and a body that has sunk in is still looked for from
  /// where it had not.
  void forgetPlaces();
  void forgetAges();
  /// Called now and then: a pair at rest gives unused memory back.
  void lookAtRest();
  void forgetWaiting();
  void forgetSpeculativeImpulses();
  /// Detects bodies that were placed elsewhere. The overlap that their guards were allowed means nothing there.
  void lookForJump(const RelativePlacement& now, const PairSides& sides, btScalar timeStep);

  void clearManifolds();
  /// Counts the contacts that Bullet holds; users may have removed some.
  void countReported();
  /// Lets points that only follow their bodies outlive Bullet's own refresh.
  void surviveRefresh() { manifolds.surviveRefresh(btScalar(kMaxFollowed * sizes.smaller)); }
  /// Keeps bodies awake that rest on guards.
  void keepGuardedAwake();
  /// Largest separation of a manifold's points: a little more than the contact distance, so that rounding rejects none.
  btScalar breakingThreshold() const;
  /// The manifold of a cluster. It is null only when Bullet's pool is used up and may not grow.
  btPersistentManifold* manifold(btDispatcher& dispatcher, int cluster);
  ManifoldWriter writerOf(btManifoldResult& result) const;
  /// Chooses the contacts of a manifold for Bullet, moves them to the front and returns them. They are so far apart
  /// that Bullet does not take two for one. Precondition: deepest first.
  std::span<Contact> choose(int manifold, std::span<Contact> members) const;
};

}  // namespace cairn::bullet

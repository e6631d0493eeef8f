// SPDX-License-Identifier: Zlib
#pragma once

#include <BulletCollision/CollisionDispatch/btManifoldResult.h>

#include <atomic>
#include <memory>
#include <span>
#include <utility>

#include "contacts/manifold_writer.h"
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

/// How far a pair has come in a step: it is settled, or collected; then it is carried over, or begun and finished, or
/// held.
enum class PairStage : std::uint8_t {
  idle,       ///< nobody has asked yet
  apart,      ///< settled: by what was measured last there can be no contacts
  away,       ///< settled: the same by the spheres around the bodies, and nothing else is known
  nonFinite,  ///< settled: a body is no number
  collected,  ///< its bodies are copied
  estimated,  ///< its need is known
  begun,      ///< its collider is placed, its traversal started or resumed
};

/// Whether a pair rests: Bullet does not ask about bodies that sleep.
enum class PairRest : std::uint8_t {
  asked,    ///< since the last look
  unasked,  ///< not since then
  trimmed,  ///< nor since the one before: it gave back memory it does not use
};

/// One sphere-tree and its collider, from the moment Bullet creates their algorithm until it destroys it: all that
/// is known of them from step to step. What is done with it stands in files of their own: pair_cull.h,
/// pair_collect.h, pair_estimation.h, pair_reuse.h, pair_begin.h, pair_measure.h, pair_write.h, pair_carry_over.h. What
/// tells whether anything has to be done in a step comes first: of most pairs of a heap nothing else is looked at.
struct alignas(64) TreePair {
  /// How far bodies may move before points that followed them mean nothing any more, of the smaller one's size.
  static constexpr float kMaxFollowed = 0.04F;

  explicit TreePair(ColliderKind colliderKind) : kind(colliderKind), collider(makeCollider(colliderKind)) {}

  ColliderKind kind;
  bool treeIsBody0 = true;
  std::atomic<PairStage> stage{PairStage::idle};  // threads look at others' pairs to fetch them
  PairRest rest = PairRest::asked;
  ReportedContacts reported;
  PairSizes sizes;
  PairTrajectory trajectory;
  PairHandles handles;
  Vec3 awayBy;  ///< from the other body's centre to the tree's
  PairSubject subject;
  PairContacts contacts;
  // Then what tells what it needs where there is not enough for all.
  PairMotion motion;
  std::unique_ptr<Collider> collider;
  PairAge age;
  PairWork work;
  PairNotes notes;
  PairManifolds manifolds;
  PairBodies bodies;

  /// For use by a new pair of bodies; lets go of the trees. Precondition: no manifolds.
  void reset();
  void enter(PairStage next) { stage.store(next, std::memory_order_relaxed); }
  bool is(PairStage asked) const { return stage.load(std::memory_order_relaxed) == asked; }
  bool isCulled() const { return is(PairStage::apart) || is(PairStage::away) || is(PairStage::nonFinite); }
  bool isBegun() const { return is(PairStage::begun); }
  /// Of the copied bodies.
  PairSides sides() const { return PairSides::of(bodies.body0(), bodies.body1(), treeIsBody0); }
  Traversal& traversal() { return collider->traversal(); }
  bool isDone() const { return std::as_const(*collider).traversal().done(); }
  /// What everything comes up from, however deep it is.
  bool isOnGround() const { return kind == ColliderKind::terrain || kind == ColliderKind::plane; }
  /// Begun or not, until it is done.
  bool mayRepeatLast() const { return motion.roots && age.repeatsLast && !trajectory.isFast; }

  /// Takes these shapes. What is known of others is forgotten first. False, and nothing known, where they cannot meet.
  bool adopt(const PairSides& sides);
  /// All that is known of the shapes; contacts end.
  void forget();
  /// A look at it, now and then: if it rests, it gives back memory that it does not use.
  void lookAtRest();
  void forgetWaiting();
  void forgetSpeculativeImpulses();
  /// The bodies stand elsewhere: how far spheres had overlapped, and were allowed to, means nothing here.
  void lookForJump(const RelativePlacement& now, const PairSides& sides, btScalar timeStep);

  void clearManifolds();
  /// Of what Bullet holds; users may have taken some away.
  void countReported();
  /// What only follows the bodies is to outlive Bullet's own refresh.
  void surviveRefresh() { manifolds.surviveRefresh(btScalar(kMaxFollowed * sizes.smaller)); }
  /// Bodies that guards bear stay awake.
  void keepGuardedAwake();
  /// How far apart points of a manifold may be: a little more than contacts reach, so that rounding refuses none.
  btScalar breakingThreshold() const;
  /// Null only when Bullet's pool is used up and the user forbade it to grow.
  btPersistentManifold* manifold(btDispatcher& dispatcher, int cluster);
  ManifoldWriter writerOf(btManifoldResult& result) const;
  /// Moves to the front, and returns, those of a manifold's contacts that Bullet gets, so far apart that it does not
  /// take two for one. Precondition: deepest first.
  std::span<Contact> choose(int manifold, std::span<Contact> members) const;
};

}  // namespace cairn::bullet

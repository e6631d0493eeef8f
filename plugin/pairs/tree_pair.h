// SPDX-License-Identifier: Zlib
#pragma once

#include <BulletCollision/BroadphaseCollision/btCollisionAlgorithm.h>
#include <BulletCollision/CollisionDispatch/btManifoldResult.h>

#include <array>
#include <atomic>
#include <compare>
#include <memory>
#include <optional>
#include <span>
#include <utility>

#include "cairn/bullet/sphere_tree_shape.h"
#include "cairn/bullet/step.h"
#include "cairn/core/scheduler.h"
#include "contacts/manifold_writer.h"
#include "continuous/sweep.h"
#include "pairs/body_snapshot.h"
#include "pairs/emission_pace.h"
#include "pairs/pair_contacts.h"
#include "pairs/pair_need.h"
#include "pairs/root_spheres.h"

class btDispatcher;

namespace cairn::bullet {

/// What one pair contributes to the statistics of a step.
struct PairReport {
  std::uint32_t contacts = 0;
  std::uint32_t exactContacts = 0;  ///< of these, measured between source triangles
  std::uint32_t manifolds = 0;
  bool isUnresolved = false;
  double errorFraction = 0;  ///< worst certified error of its contacts and its front, of the smaller body's size
  double seenError = 0;      ///< the same as an angle in radians at which the viewer sees it; 0 without one
  Budget::Clock::duration onTriangles{};  ///< time spent past the leaves; measured only under a deadline
};

/// How far ahead a step looks, and how closely.
struct Outlook {
  btScalar timeStep = 0;      ///< seconds
  btScalar sweptTime = 0;     ///< seconds that fast bodies look ahead, see `fastTravel`; 0: they do not
  btScalar wallTime = 0;      ///< the same of bodies that are fast for thin walls, see `wallTravel`
  bool asksTriangles = true;  ///< what leaves say is not enough
};

/// What orders new pairs within a step: never an address. `arrival` decides only between children of compounds whose
/// paths collide.
struct PairKey {
  std::uint64_t bodies = 0;
  std::uint64_t children = 0;
  std::size_t arrival = 0;

  friend auto operator<=>(const PairKey&, const PairKey&) = default;
};

/// One sphere-tree and its counterpart, from the moment Bullet creates their algorithm until it destroys it: the
/// traversal in progress, the contacts of the last step and up to four manifolds.
class alignas(64) TreePair {
 public:
  explicit TreePair(CounterpartKind kind) : kind_(kind), counterpart_(makeCounterpart(kind)) {}

  CounterpartKind kind() const { return kind_; }
  /// For use by a new pair of bodies; lets go of the trees. Precondition: no manifolds.
  void reset();

  /// True when there can be no contacts, because the bodies' spheres are apart, or nothing touched in an earlier step
  /// and nothing moved far since, or `settleBroken`: the pair then has none, and needs no more work in this step.
  /// Cheap. `alsoFromGround`: whether the sphere of a body above a plane or a terrain is looked at as well. Where
  /// nothing is interrupted a traversal says it once for many steps, and pairs keep the order they always had.
  bool settleApart(const btCollisionObjectWrapper& body0, const btCollisionObjectWrapper& body1, bool alsoFromGround,
                   const Outlook& outlook);
  /// True when one of the bodies `isBroken`: the pair then forgets what it knew and has no contacts, as if settled.
  bool settleBroken(const btCollisionObjectWrapper& body0, const btCollisionObjectWrapper& body1);
  /// Whether it has points of an earlier step between bodies of which one `isBroken` now. It may not be asked about in
  /// this step: Bullet passes over children of compounds whose boxes are apart in the compound's frame, and leaves them
  /// their points. Precondition: the bodies live.
  bool isLeftOver() const;
  /// What `settleBroken` does to a pair of a broken body. Contacts end: users' callbacks are called.
  void forgetBroken();
  /// Whether one of its sides was a child of a compound. `noteCompound`: from now on.
  bool isOfCompound() const { return isOfCompound_; }
  void noteCompound() { isOfCompound_ = true; }
  /// Whether it was settled for that the last time it was.
  bool isBrokenPair() const { return isBroken_; }
  /// Whether `settleApart` said so for the copies last taken.
  bool isSettled() const { return isSettled_.load(std::memory_order_relaxed); }
  /// Copies the bodies for a deferred answer; false when they are nested too deep for that.
  bool collect(const btCollisionObjectWrapper& body0, const btCollisionObjectWrapper& body1);
  /// For pairs whose answer is not deferred but prepared: takes the copies to where the bodies are now (false when
  /// their shapes have changed), tells whether they are elsewhere, and whether they are these. Precondition: `collect`
  /// succeeded; for the first two, the bodies live.
  bool follow();
  bool hasMoved() const { return bodies_[0].hasMoved() || bodies_[1].hasMoved(); }
  bool isOf(const btCollisionObjectWrapper& body0, const btCollisionObjectWrapper& body1) const {
    return bodies_[0].isOf(body0) && bodies_[1].isOf(body1);
  }
  const btCollisionObject* object0() const { return body0().getCollisionObject(); }
  const btCollisionObject* object1() const { return body1().getCollisionObject(); }
  PairKey key(std::size_t arrival) const;
  const btCollisionObjectWrapper& body0() const { return bodies_[0].wrapper(); }
  const btCollisionObjectWrapper& body1() const { return bodies_[1].wrapper(); }

  /// Instead of all that follows, for a pair that triangles answered: where the bodies have hardly moved against each
  /// other since (`tuning::kCarried`), the manifolds' points follow them as they are. Nothing where that does not do.
  /// Precondition: collected in this step.
  std::optional<PairReport> carryOver();
  /// Whether it will. Precondition: as for `carryOver`.
  bool mayBeCarriedOver() const { return standsStill().has_value(); }
  /// Places the counterpart and starts or resumes its traversal. `threshold` (world length): contacts this far apart
  /// are wanted, beyond the speculative distance. When a shape was replaced, what is known of the old one is forgotten
  /// first. `remeasured`: of an answer that is kept. False, and no contacts, when the shapes
  /// are no longer a sphere-tree and something it can meet.
  bool begin(const btCollisionObjectWrapper& body0, const btCollisionObjectWrapper& body1, const Outlook& outlook,
             btScalar threshold, Remeasured remeasured, Budget& budget, ContactScratch& scratch);
  /// What a priority is told. Precondition: `begin` succeeded in this step.
  ScheduledPair scheduled();
  Progress refine(Budget& budget) { return counterpart_->traversal().refine(budget); }

  bool isDone() const { return std::as_const(*counterpart_).traversal().done(); }

  /// Holds back what finishing the pair would take now, in place of what was held back for it before.
  void promise(Budget& budget, const EmissionPace& pace);
  void withdrawPromise(Budget& budget) { budget.redeem(std::exchange(promised_, {})); }
  /// Brings the manifolds up to date through `result`, and redeems the promise.
  PairReport finish(btDispatcher& dispatcher, btManifoldResult& result, const AnswerPolicy& policy, Budget& budget,
                    ContactScratch& scratch);

  /// Finds what the pair needs in this step. Precondition: collected by `settleApart` and `collect`, or by `follow`.
  /// `usualOperations`: what pairs were resolved with lately. `isTimed`: whether the step ends at a time; then bodies
  /// on planes can wait as well, however far they have moved.
  void survey(std::uint64_t usualOperations, bool isTimed);
  /// Whether that was done since it was collected, and what it found.
  bool isSurveyed() const { return isSurveyed_; }
  const PairNeed& need() const { return need_; }
  /// What a priority is told before anything is done for the pair. Precondition: as for `survey`.
  ScheduledPair described() const;
  /// Instead of all the above: the manifolds' points follow the bodies, and where the last answer no longer counts the
  /// spheres of whole bodies, which may not approach further, stand in, or on a terrain or a plane a few of the body's
  /// points. `isLate`: the time is up; what was said stays as it was where bodies hardly move. See
  /// docs/algorithms/narrow-phase.md. Precondition: `survey` said it can be, or `isBetterHeld`.
  PairReport hold(btDispatcher& dispatcher, btManifoldResult& result, btScalar timeStep, bool isLate);
  /// Where it is seen, and how large: what statistics need. Precondition: `hold` was called in this step.
  ScheduledPair seenHeld() const { return {.id = id_, .center = center_, .size = smallerSize_}; }
  /// So much was charged for the pair, in this step or one before.
  std::uint64_t charged(std::uint64_t operations);
  /// Whether `begin` was called since it was collected.
  bool isBegun() const { return isBegun_; }
  /// Whether what it said last serves better than what was resolved in this step: it is to be held, begun or not.
  /// Of begun pairs only two trees': what stands in for the others sees more than their last contacts.
  bool isBetterHeld() const { return !isBegun_ || (saysItsLast() && !isDone()); }
  /// Before `hold`, of what was begun.
  void measureFound(Budget& budget, ContactScratch& scratch) { contacts_.measureFound(*counterpart_, budget, scratch); }

  // See `fetchAhead`; none of these changes anything.

  /// What `settleApart` looks at.
  void fetchSubject() const { fetchAhead(this, kSubjectBytes); }
  /// Bullet's handle on the pair, the body whose tree it is, its shape, and unless the pair was settled in the last
  /// step what `collect` writes, and if that is to follow what `survey` looks at. Looks at the former.
  void fetchCopies(bool forSurvey) const {
    fetchAhead(algorithm_.load(std::memory_order_relaxed), 1);
    fetchBody();
    if (isSettled()) return;
    for (const BodySnapshot& body : bodies_) fetchAhead(&body, kCopyBytes);
    if (forSurvey) fetchAhead(&motion_, kSurveyBytes);
  }
  /// What `setId` and `need` look at.
  void fetchName() const { fetchAhead(this, 1); }
  /// What is looked at from `begin` to `finish`, in three goes, each of which looks at what the one before fetches.
  void fetchState() const;
  void fetchLists() const;
  void fetchLeafPairs() const;
  /// What `hold` looks at, likewise in three goes.
  void fetchHeld() const;
  void fetchHeldBodies() const;
  void fetchBody() const {
    fetchAhead(treeObject_.load(std::memory_order_relaxed), kBodyBytes);
    fetchAhead(treeShape_.load(std::memory_order_relaxed), sizeof(SphereTreeShape));
  }
  void fetchPoints() const;

  /// The algorithm in Bullet's hands whose pair this is.
  void setAlgorithm(const void* algorithm) { algorithm_.store(algorithm, std::memory_order_relaxed); }
  /// Allocates now what else a first step on a budget would.
  void expectInterruptions() { contacts_.makeRoomForRetests(); }

  void appendManifolds(btManifoldArray& manifolds) const;
  void releaseManifolds(btDispatcher& dispatcher);

  std::uint64_t id() const { return id_; }
  void setId(std::uint64_t id) { id_ = id; }
  bool isUnnamed() const { return id_ == kUnnamed; }
  /// Position among the pairs collected in the current dispatch, or `kNotCollected`.
  std::size_t collectedAt() const { return collectedAt_; }
  void setCollectedAt(std::size_t index) { collectedAt_ = index; }

  /// What is held back for finishing this pair.
  const Promise& promised() const { return promised_; }
  /// Position among the pairs an open step knows, or `kUnknown`, and the last such step that answered this one.
  std::size_t knownAt() const { return knownAt_; }
  void setKnownAt(std::size_t index) { knownAt_ = index; }
  std::uint64_t answeredIn() const { return answeredIn_; }
  void setAnsweredIn(std::uint64_t step) { answeredIn_ = step; }
  /// What it said when an open step last answered it: stands until it is answered again.
  const PairReport& lastReport() const { return lastReport_; }
  void setLastReport(const PairReport& report) { lastReport_ = report; }

  static constexpr std::uint64_t kUnnamed = ~std::uint64_t{0};
  static constexpr std::size_t kNotCollected = ~std::size_t{0};
  static constexpr std::size_t kUnknown = ~std::size_t{0};

 private:
  // What the state is about. A body's shape may be replaced between steps, and the old one destroyed; the traversal
  // refers to its tree, and its answer may be kept.
  struct Subject {
    std::shared_ptr<const SphereTree> tree, otherTree;  // the second is null if the other shape is no tree
    btScalar treeScale = 0, otherScale = 0, treeMargin = 0, otherMargin = 0;  // the other's if it is a tree
    BodyFrame treeFrame{}, otherFrame{};
    const btCollisionShape* otherShape = nullptr;  // never followed: it may be gone
    btVector3 planeNormal{0, 0, 0};                // if it is a plane: another may stand at the same address
    btScalar planeConstant = 0;
    std::uint64_t fieldMark = 0;  // if it is a field, which may be given other data: see `DistanceField::mark`
  };

  static constexpr std::size_t kSubjectBytes = 384, kCopyBytes = 192, kSurveyBytes = 512, kHeldBytes = 832;
  static constexpr std::size_t kBodyBytes = 512;  // up to a rigid body's velocities

  struct StandsStill {
    RelativePlacement placement;
    float moved;  // against each other, since it was answered
  };

  PairNeed surveyed(std::uint64_t usualOperations, bool isTimed);
  std::optional<StandsStill> standsStill() const;
  void rememberBody(const btCollisionObjectWrapper& tree);
  std::uint64_t expectedOperations(std::uint64_t usualOperations) const;
  void noticeSetDown(const RelativePlacement& now, const btCollisionObjectWrapper& tree,
                     const btCollisionObjectWrapper& other, btScalar timeStep);
  static float speedInOther(const SphereTreeShape& shape, const btCollisionObjectWrapper& tree,
                            const btCollisionObjectWrapper& other);
  void beginHeld(btScalar timeStep, bool isLate);
  void countStepAsWaited();
  void lookForJump(btScalar timeStep);
  bool hasStandIn(bool isTimed) const;
  // Begun or not, until it is done.
  bool saysItsLast() const { return roots_ && isHoldingStill_ && !isFast_; }
  // What everything comes up from, however deep it is.
  bool isOnGround() const { return kind_ == CounterpartKind::terrain || kind_ == CounterpartKind::plane; }
  bool mayStay(btScalar timeStep);
  void standIn(btScalar timeStep, btDispatcher& dispatcher, btManifoldResult& result);
  bool areGuardsLoaded();
  void stayAwake() const;
  void standOnGround(btScalar timeStep, btDispatcher& dispatcher, btManifoldResult& result);
  Contact aheadOf(Contact contact) const;
  void chooseForWhole();
  void dropFollowed();
  void carryPoints(bool dropsParted, bool writesWhole);
  void surviveRefresh();
  void writeStandIn(std::span<Contact> contacts, btDispatcher& dispatcher, btManifoldResult& result);
  void bringPoints(bool standsIn);
  void countSaid();
  PairReport reportHeld(bool isWhole) const;
  bool saysWhole() const;
  double standInErrorFraction() const;
  static RelativePlacement relativePlacement(const SphereTreeShape& shape, const btTransform& tree,
                                             const btTransform& other);
  // How far a contact may wander in a step, as a fraction of the smaller body's size, and still be the same one.
  static constexpr float kInheritanceFraction = 0.02F;
  // Bullet matches points closer than the breaking threshold: chosen points keep half as much again between them.
  static constexpr float kSeparationFactor = 1.5F;

  void forgetWaiting();
  void tellOfWaiting(const btCollisionObjectWrapper& treeBody, const btCollisionObjectWrapper& otherBody);
  void clearManifolds();
  bool isSubject(const SphereTreeShape& tree, const SphereTreeShape* otherTree, const btCollisionShape& other) const;
  bool stillApart(const btCollisionObjectWrapper& body0, const btCollisionObjectWrapper& body1, bool asksTriangles,
                  float travel) const;
  bool adopt(const SphereTreeShape* tree, const btCollisionShape& other);
  void forget();
  PairPlacement place(const btCollisionObjectWrapper& treeBody, const btCollisionObjectWrapper& otherBody,
                      btScalar threshold);
  void setSizes(const SphereTreeShape& tree, const btCollisionShape& other, btScalar threshold);
  // Where the smaller body is, in the world: the middle of its root sphere, or the origin of a shape that is no tree.
  Vec3d smallerCenter(const PairPlacement& placement) const;
  void setMotion(const SphereTreeShape& shape, const btCollisionObjectWrapper& treeBody,
                 const btCollisionObjectWrapper& otherBody, btScalar timeStep);
  void setVelocities(const btCollisionObjectWrapper& treeBody, const btCollisionObjectWrapper& otherBody,
                     btScalar timeStep);
  btPersistentManifold* manifold(btDispatcher& dispatcher, int cluster);
  btScalar breakingThreshold() const;
  // The contacts of this step, by manifold.
  using Clusters = std::array<std::span<Contact>, kMaxClusters>;
  static Clusters clustersOf(ClusteredContacts& contacts);
  ManifoldWriter writerOf(btManifoldResult& result) const;
  void lookAhead(const PairPlacement& placement, const btCollisionObjectWrapper& treeBody,
                 const btCollisionObjectWrapper& otherBody, btScalar sweptTime, Budget& budget);
  void forgetImpulsesAhead();
  void writeCluster(int k, std::span<Contact> members, const AnswerPolicy& policy, btDispatcher& dispatcher,
                    btManifoldResult& result, PairReport& report);

  // First what tells whether anything has to be done in a step. Of most pairs of a heap nothing else is looked at.
  CounterpartKind kind_;
  bool treeIsBody0_ = true;
  std::atomic<bool> isSettled_{false};  // in this step; threads look at others' pairs to fetch them
  bool mayHavePoints_ = false;
  float speculative_ = 0;
  std::uint64_t id_ = kUnnamed;
  std::size_t collectedAt_ = kNotCollected;
  PairNeed need_;            // of this step, if it was surveyed
  bool isSurveyed_ = false;  // in this step
  bool isFast_ = false;      // in this step
  bool isBroken_ = false;    // when it was last settled
  bool isOfCompound_ = false;
  bool wasDone_ = true;  // the traversal, when a step last ended in which something was done for it
  // For bodies that move far in a step.
  std::unique_ptr<Sweep> sweep_;  // made when it is first needed
  // Bullet's handle on the pair. Only fetched, like those that follow.
  std::atomic<const void*> algorithm_{nullptr};
  // The tree's, when Bullet last asked. Only fetched, also by other threads, and never followed: they may be gone.
  std::atomic<const btCollisionObject*> treeObject_{nullptr};
  std::atomic<const btCollisionShape*> treeShape_{nullptr};
  Subject subject_;
  PairContacts contacts_;

  // Then what tells what it needs where there is not enough for all.
  RelativeMotion motion_;
  RelativePlacement seenAt_, seenNow_;  // in the last step; in this, if it was surveyed
  RelativePlacement answeredAt_;        // when it was last finished
  std::optional<RootSpheres> roots_;    // of this step
  float smallerSize_ = 0;
  float reach_ = 0;  // contacts with a gap below this are wanted
  std::unique_ptr<Counterpart> counterpart_;
  // For steps in which the pair has to wait.
  bool isPlaced_ = false;        // `motion_` tells where the bodies were when it was last begun
  bool isBegun_ = false;         // in this step
  bool isHeld_ = false;          // in the step before
  bool isHoldingStill_ = false;  // what was said last suffices
  float moved_ = 0;              // world length, by which the bodies moved since it was begun
  float untold_ = 0;             // the same, when it was begun in this step: nobody has counted it yet
  float unseenWay_ = 0;          // world length, at most, in steps that were late for it
  std::uint32_t saidContacts_ = 0, saidManifolds_ = 0;
  double waited_ = 0;                 // steps
  double heldError_ = 0;              // of what was said last, as a fraction of the smaller body's size
  std::uint64_t spent_ = 0;           // operations, on the traversal at hand
  std::uint64_t fullOperations_ = 0;  // that the last complete one took

  std::array<btPersistentManifold*, kMaxClusters> manifolds_{};
  const btCollisionObject* objects_[2] = {};       // in the manifolds' order
  btMatrix3x3 axes_ = btMatrix3x3::getIdentity();  // of the second object, where the manifolds' normals stand
  btVector3 origin_{0, 0, 0};
  int wholeAt_ = -1;  // which manifold holds the spheres of whole bodies
  bool treeIsSmaller_ = true;
  bool wasAhead_ = false;         // contacts ahead were written in the last step
  bool areGuardsLoaded_ = false;  // in the step that was looked at last
  float closingSpeed_ = 0;
  float reducedMass_ = 0;
  Vec3d center_;  // of the smaller body, world frame
  Promise promised_;
  std::span<const Contact> ahead_;  // of this step

  std::size_t knownAt_ = kUnknown;
  std::uint64_t answeredIn_ = 0;  // open steps count from 1
  PairReport lastReport_;
  std::array<BodySnapshot, 2> bodies_;  // last, because they hardly ever need all their room
};

}  // namespace cairn::bullet

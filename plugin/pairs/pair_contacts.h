// SPDX-License-Identifier: Zlib
#pragma once

#include <algorithm>
#include <vector>

#include "cairn/bullet/step.h"
#include "cairn/core/budget.h"
#include "colliders/collider.h"
#include "contacts/normal_clusters.h"
#include "contacts/relative_motion.h"
#include "pairs/answer_age.h"
#include "pairs/common_normals.h"
#include "pairs/contact_cache.h"
#include "pairs/found_pairs.h"
#include "pairs/known_pairs.h"
#include "pairs/pair_guards.h"

namespace cairn::bullet {

/// How the pairs of a step answer.
struct AnswerPolicy {
  Unresolved unresolved = Unresolved::guard;
  Finest finest = Finest::leaves;
  bool mayBeInterrupted = false;  ///< the next step can stop half-way
};

/// Working memory that a thread uses for its pairs, one after the other.
struct ContactScratch {
  ClusteredContacts contacts;  ///< of the present pair
  std::vector<Contact> guards, rootContacts;
  std::vector<Contact> chosen;    ///< for Bullet's manifolds, of all pairs since it was last cleared
  std::vector<Contact> retested;  ///< all of them, before only the deepest are kept
  Outliers outliers;
  ContactKernel kernel;
};

/// Makes contacts from one pair's traversal, and keeps the pair's knowledge between steps: leaf pairs in contact and
/// normals of clusters.
class PairContacts {
 public:
  /// Forgets everything, for a new pair.
  void reset();
  /// Forgets everything but the clusters' normals, for surfaces that moved: a cluster keeps its manifold.
  void forgetPlaces();

  /// The bodies are too far apart for contacts, which counts as an answer. Everything else is forgotten. `centers`:
  /// from the other body's centre to the tree's.
  void cullSeparated(const Vec3& centers);

  /// Whether the last answer had no contacts and the bodies have not moved enough to change it. `asksTriangles`:
  /// separations of leaves are not enough.
  bool isStillSeparated(const RelativePlacement& now, float maxSeparation, bool asksTriangles) const {
    return cache_.isSeparatedAt(now, maxSeparation, asksTriangles);
  }
  /// A cheap test: false where `isStillSeparated` is false at all poses.
  bool mayBeSeparated(float maxSeparation) const { return cache_.mayBeSeparated(maxSeparation); }

  /// How a pair begins its work in a step.
  struct Beginning {
    RefreshPolicy refresh = RefreshPolicy::all;
    bool isCarriedOver = false;  ///< until it is done it repeats its last answer, see `measureFound`
  };
  /// Starts or resumes the traversal at the collider's poses. True when it was started. A resumed pair that is not
  /// carried over measures its known contacts again before anything is refined, and charges them to the budget. Where
  /// they would take most of the budget, it measures them when it is finished.
  bool begin(Collider& collider, const RelativeMotion& motion, const Beginning& beginning, Budget& budget,
             ContactScratch& scratch);

  /// The operations that `finish` would charge now for resolved leaf pairs. Operation budgets reserve them.
  std::uint64_t measuringCost(const Collider& collider) const;
  /// The operations that `finish` would charge in addition for an unresolved pair's known contacts and guards.
  std::uint64_t fallbackCost(const Collider& collider) const;

  /// Gathers the traversal's contacts into `scratch`, by cluster. Work beyond the traversal is charged even if the
  /// budget is spent. `speculative`: further contacts to add, see `Contact::isSpeculative`.
  void finish(Collider& collider, const AnswerPolicy& policy, const RelativeMotion& motion, float maxSeparation,
              std::span<const Contact> speculative, Budget& budget, ContactScratch& scratch);
  /// Replaces `finish` for a pair that is carried over: measures the leaf pairs found in this step and remembers the
  /// deepest. The cost is reserved before refinement. If all measuring were left to the end, a pair with many leaf
  /// pairs would never be finished.
  void measureFound(Collider& collider, Budget& budget, ContactScratch& scratch);
  /// The error of an unfinished traversal's front, world length, at the poses where the traversal began.
  static float frontError(Collider& collider);
  /// After `finish`: bound on the bodies' motion, world length, since the leaf pairs that were not measured again were
  /// measured.
  float staleness() const { return staleness_; }
  /// In steps without `begin` and `finish`: whether the last answer or its guards still keep the bodies from each
  /// other. `moved`: see `AnswerAge`.
  bool holds(float moved, float smallerSize) const;
  AnswerAge& age() { return age_; }
  const AnswerAge& age() const { return age_; }
  PairGuards& guards() { return guards_; }
  KnownPairs& known() { return known_; }
  /// Whether `begin` would use the cache at these poses. `cachedCost`: about how many operations finishing would take
  /// then. `kCachedCostIfFew`: the most it takes with `RefreshPolicy::allIfFew`.
  bool keepsAt(const Collider& collider, const RelativePlacement& now, float maxSeparation) const;
  std::uint64_t cachedCost(const Collider& collider, const RelativePlacement& now, float maxSeparation) const;
  static constexpr std::uint64_t kCachedCostIfFew = kContactCost * ContactCache::kFewLeafPairs;
  bool isCached() const { return isCached_; }
  /// Time that the last `finish` spent on triangles under a deadline; 0 without a deadline.
  Budget::Clock::duration onTriangles() const { return onTriangles_; }
  /// Whether the last contacts are of triangles, not of leaves.
  bool isOfTriangles() const { return isOfTriangles_; }

  /// Prefetches the lists that a step reads besides this object.
  void prefetchLists() const {
    known_.prefetchData();
    cache_.prefetchLists();
  }

  /// Whether the last answer still says anything about the present poses.
  bool hasAnswer(const RelativeMotion& motion) const;

  /// Frees unused memory of a pair at rest.
  void shrinkToFit() { cache_.shrinkToFit(); }
  /// Allocates the memory that only interruptible steps need, once. It is most of a pair's memory.
  void expectInterruptions();

 private:
  bool useCache(Collider& collider, const RelativeMotion& motion, RefreshPolicy refresh);
  bool isDoneUnreported(const Collider& collider, const RelativeMotion& motion);
  void start(Collider& collider, const RelativeMotion& motion);
  std::span<const NodePair> unmeasured(const Collider& collider) const;
  void appendFound(Collider& collider, Budget& budget, std::vector<Contact>& contacts);
  void appendUnmeasured(Collider& collider, const RelativeMotion& motion, Budget& budget,
                        std::vector<Contact>& contacts);
  // The front that answers for an unfinished traversal. For bodies of like size it covers them completely, however
  // coarse it is. Else it is the front's head, which holds the coarsest pairs because the front is breadth-first.
  static std::span<const NodePair> reportedFront(const Collider& collider);
  static void appendFront(Collider& collider, bool compensate, float maxSeparation, Budget& budget,
                          std::vector<Contact>& contacts);
  bool appendOfMesh(Collider& collider, const RelativeMotion& motion, const MeshQuery& question,
                    std::vector<Contact>& contacts);
  void appendGuards(Collider& collider, const RelativeMotion& motion, float maxSeparation, Budget& budget,
                    ContactScratch& scratch);
  bool needsRootContacts(Collider& collider, float smallerSize, std::span<const Contact> rootContacts) const;
  bool isWanted(const Contact& guard, const RelativeMotion& motion, float maxSeparation) const;

  // One comparison of bounding spheres moves one of the two.
  static constexpr std::uint32_t kSphereCost = kSphereUpdateCost + kOverlapTestCost;
  static_assert(KnownPairs::kMaxOfAll <= ContactCache::kFewLeafPairs);

  // First the data that every step reads.
  PairGuards guards_;
  AnswerAge age_;
  bool isCached_ = false;
  bool isAtRest_ = false;  // cached, and the bodies hardly moved: only leaf pairs in contact were measured
  bool started_ = false;
  bool isReported_ = false;  // `finish` came after the present traversal was done
  bool isResumed_ = false;
  bool isOfTriangles_ = false;
  float staleness_ = 0;
  Budget::Clock::duration onTriangles_{};
  ContactCache cache_;
  KnownPairs known_;
  FoundPairs found_;
  CommonNormals normals_;
  std::size_t seenLeafPairs_ = 0;
};

}  // namespace cairn::bullet

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

/// How pairs answer in a step.
struct AnswerPolicy {
  Unresolved unresolved = Unresolved::guard;
  Finest finest = Finest::leaves;
  bool mayBeInterrupted = false;  ///< whether the next step can stop half-way
};

/// Working memory that the pairs a thread works on share, one after the other.
struct ContactScratch {
  ClusteredContacts contacts;  ///< of the pair at hand
  std::vector<Contact> guards, rootContacts;
  std::vector<Contact> chosen;    ///< for Bullet's manifolds, of all pairs since it was last cleared
  std::vector<Contact> retested;  ///< before all but the deepest are dropped
  Outliers outliers;
  ContactKernel kernel;
};

/// From the traversal of one pair to its contacts, and what has to be remembered between steps for it: the resolved
/// pairs that were in contact last, and the directions of the clusters.
class PairContacts {
 public:
  /// Forgets everything; for a pair that is new.
  void reset();

  /// Everything is too far apart for contacts: that is an answer, and nothing else need be remembered. `centers`: from
  /// the other body's centre to the tree's.
  void cullSeparated(const Vec3& centers);

  /// True when the last answer was that nothing touches, and the bodies have not moved far enough since to change it.
  /// `asksTriangles`: what leaves said is not enough.
  bool isStillSeparated(const RelativePlacement& now, float maxSeparation, bool asksTriangles) const {
    return cache_.isSeparatedAt(now, maxSeparation, asksTriangles);
  }
  /// False where `isStillSeparated` is, wherever the bodies are. Cheap.
  bool mayBeSeparated(float maxSeparation) const { return cache_.mayBeSeparated(maxSeparation); }

  /// How a pair is begun.
  struct Beginning {
    RefreshPolicy refresh = RefreshPolicy::all;
    bool isCarriedOver = false;  ///< until it is done it says what it said last: see `measureFound`
  };
  /// Starts or resumes the traversal at the poses the collider was placed at. A resumed pair that is not held over
  /// re-tests what it knows now, before anything is refined, and charges that to the budget; unless that is most of it:
  /// then when it is finished. True when it was started.
  bool begin(Collider& collider, const RelativeMotion& motion, const Beginning& beginning, Budget& budget,
             ContactScratch& scratch);

  /// What `finish` would be charged now for what the traversal resolved: within an operation budget that is held back.
  std::uint64_t measuringCost(const Collider& collider) const;
  /// And what it would be charged beyond: for what a pair that stays unresolved knew before, and for its guards.
  std::uint64_t fallbackCost(const Collider& collider) const;

  /// Gathers the contacts the traversal stands for into `scratch`, by cluster. Work beyond the traversal is charged to
  /// the budget whatever is left of it. `speculative`: contacts that are joined to them, see `Contact::isSpeculative`.
  void finish(Collider& collider, const AnswerPolicy& policy, const RelativeMotion& motion, float maxSeparation,
              std::span<const Contact> speculative, Budget& budget, ContactScratch& scratch);
  /// Instead of `finish`, for a pair that is held over: measures what its traversal found in this step, and remembers
  /// the deepest of it. What measuring will cost is held back from refinement: were all of it left to the end, a pair
  /// with more leaf pairs than a step can measure would never come to it.
  void measureFound(Collider& collider, Budget& budget, ContactScratch& scratch);
  /// How far off what an unfinished traversal tells may be, world length: where the bodies were when it began.
  static float frontError(Collider& collider);
  /// After `finish`: how far the bodies may have come, world length, since what was not measured anew was.
  float staleness() const { return staleness_; }
  /// In steps without `begin` and `finish`, in which contacts only follow the bodies: whether what was last said still
  /// keeps them from each other, an answer or guards. `moved`: see `AnswerAge`.
  bool holds(float moved, float smallerSize) const;
  AnswerAge& age() { return age_; }
  const AnswerAge& age() const { return age_; }
  PairGuards& guards() { return guards_; }
  KnownPairs& known() { return known_; }
  /// Whether `begin` would keep the answer at these poses, and what finishing would be charged then, about; and at
  /// most, with `RefreshPolicy::allIfFew`.
  bool keepsAt(const Collider& collider, const RelativePlacement& now, float maxSeparation) const;
  std::uint64_t cachedCost(const Collider& collider, const RelativePlacement& now, float maxSeparation) const;
  static constexpr std::uint64_t kCachedCostIfFew = kContactCost * ContactCache::kFewLeafPairs;
  bool isCached() const { return isCached_; }
  /// How long the last `finish` was with the triangles, under a deadline; else 0.
  Budget::Clock::duration onTriangles() const { return onTriangles_; }
  /// Whether triangles told the last contacts, not leaves.
  bool isOfTriangles() const { return isOfTriangles_; }

  /// See `prefetch`: what a step looks at besides the object itself.
  void prefetchLists() const {
    known_.prefetchData();
    cache_.prefetchLists();
  }

  /// Whether the last answer still says anything about where the bodies are now.
  bool hasAnswer(const RelativeMotion& motion) const;

  /// Frees memory that is not in use, of a pair that rests.
  void shrinkToFit() { cache_.shrinkToFit(); }
  /// Allocates, once, what only steps that may be interrupted need: more than all the rest of a pair.
  void expectInterruptions();

 private:
  bool useCache(Collider& collider, const RelativeMotion& motion, RefreshPolicy refresh);
  bool isDoneUnreported(const Collider& collider, const RelativeMotion& motion);
  void start(Collider& collider, const RelativeMotion& motion);
  std::span<const NodePair> unmeasured(const Collider& collider) const;
  void appendFound(Collider& collider, Budget& budget, std::vector<Contact>& contacts);
  void appendUnmeasured(Collider& collider, const RelativeMotion& motion, Budget& budget,
                        std::vector<Contact>& contacts);
  // Bodies of like size, without wholes to fall back on: a front that holds all of them, however coarse. Else the head,
  // which holds the coarsest pairs, as it is breadth-first: these reach farthest.
  static std::span<const NodePair> reportedFront(const Collider& collider);
  static void appendFront(Collider& collider, bool compensate, float maxSeparation, Budget& budget,
                          std::vector<Contact>& contacts);
  bool appendOfMesh(Collider& collider, const RelativeMotion& motion, const MeshQuestion& question,
                    std::vector<Contact>& contacts);
  void appendGuards(Collider& collider, const RelativeMotion& motion, float maxSeparation, Budget& budget,
                    ContactScratch& scratch);
  bool needsRootContacts(Collider& collider, float smallerSize, std::span<const Contact> rootContacts) const;
  bool isWanted(const Contact& guard, const RelativeMotion& motion, float maxSeparation) const;

  // Comparing two bounding spheres moves one of them.
  static constexpr std::uint32_t kSphereCost = kSphereUpdateCost + kOverlapTestCost;
  static_assert(KnownPairs::kMaxOfAll <= ContactCache::kFewLeafPairs);

  // First what a step looks at in any case.
  PairGuards guards_;
  AnswerAge age_;
  bool isCached_ = false;
  bool isAtRest_ = false;  // and the bodies hardly moved: only what was in contact was measured
  bool started_ = false;
  bool isReported_ = false;  // what the traversal at hand found: `finish` came after it was done
  bool isResumed_ = false;
  bool isOfTriangles_ = false;
  float staleness_ = 0;
  Budget::Clock::duration onTriangles_{};
  ContactCache cache_;  // its beginning as well, see there
  KnownPairs known_;
  FoundPairs found_;
  CommonNormals normals_;
  std::size_t seenLeafPairs_ = 0;
};

}  // namespace cairn::bullet

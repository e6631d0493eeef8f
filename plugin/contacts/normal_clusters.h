// SPDX-License-Identifier: Zlib
#pragma once

#include <array>
#include <span>
#include <vector>

#include "contacts/contact.h"

namespace cairn::bullet {

/// Clusters a pair can have: each has a manifold of its own, because four points can only resist one direction.
inline constexpr int kMaxClusters = 4;
/// Cosine of the 50 degrees within which normals share a cluster (the angle that let every heap fall asleep).
inline constexpr float kClusterCosine = 0.642787610F;

/// Cosine of the 45 degrees within which two bounding spheres' contacts hold against the same motion.
inline constexpr float kSameWayCosine = 0.707106781F;

/// Cosine of the 10 degrees within which normals are of one surface and resist the same motion.
inline constexpr float kSameNormalCosine = 0.984807753F;

/// The direction a cluster had in the last step, so that contacts stay in the manifold that holds their impulses.
struct ClusterSeed {
  Vec3 normal;
  bool active = false;
};

using ClusterSeeds = std::array<ClusterSeed, kMaxClusters>;

/// The contacts of one pair: first a list, then, once `group` was called, by cluster and deepest first within one.
/// Buffers are reused from pair to pair.
class ClusteredContacts {
 public:
  /// The list, to be filled before `group`. Its order does not matter.
  std::vector<Contact>& list() { return list_; }
  const std::vector<Contact>& list() const { return list_; }

  /// Groups the list by normal: first around last step's seeds, then greedily from the deepest contact left over; what
  /// finds no free cluster joins the nearest one. Then each seed is the depth-weighted mean normal of its members, or
  /// inactive. Every gap must be below `maxSeparation`. O(n log n).
  /// `cosine`: of the angle within which normals share a cluster.
  void group(ClusterSeeds& seeds, float maxSeparation, float cosine = kClusterCosine);

  /// Valid until the list changes.
  std::span<Contact> cluster(int k) {
    const auto i = static_cast<std::size_t>(k);
    return std::span(list_).subspan(begin_[i], end_[i] - begin_[i]);
  }
  /// Sorts a cluster anew after its gaps changed, and drops those that are not below `maxSeparation` any more.
  void resort(int k, float maxSeparation);
  /// Puts contacts into a cluster that is empty, sorted.
  void fill(int k, std::span<const Contact> contacts);
  /// Moves the second cluster's contacts into the first, which is sorted anew; the second is empty then.
  void join(int into, int from);

 private:
  void keepLastClusters(ClusterSeeds& seeds, float cosine);
  void openNewClusters(ClusterSeeds& seeds, float cosine);
  void gather();

  std::vector<Contact> list_;
  std::vector<Contact> grouped_;
  std::vector<int> clusterOf_;  // by position in the list
  std::array<std::size_t, kMaxClusters> begin_{}, end_{};
};

}  // namespace cairn::bullet

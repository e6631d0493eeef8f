// SPDX-License-Identifier: Zlib
#pragma once

#include <array>
#include <span>
#include <vector>

#include "contacts/contact.h"

namespace cairn::bullet {

/// Most clusters of a pair. Each has its own manifold, because four points resist one direction only.
inline constexpr int kMaxClusters = 4;
/// Cosine of the 50 degrees within which normals share a cluster. At this angle every heap falls asleep.
inline constexpr float kClusterCosine = 0.642787610F;

/// Cosine of the 45 degrees within which contacts of two bounding spheres resist the same motion.
inline constexpr float kSameMotionCosine = 0.707106781F;

/// Cosine of the 10 degrees within which normals belong to one surface and resist the same motion.
inline constexpr float kSameNormalCosine = 0.984807753F;

/// A cluster's direction in the last step, so that contacts stay in the manifold that has their impulses.
struct ClusterSeed {
  Vec3 normal;
  bool active = false;
};

using ClusterSeeds = std::array<ClusterSeed, kMaxClusters>;

/// The contacts of one pair: at first a plain list; after `group`, sorted by cluster, and deepest first within one.
///
///     contacts.list().push_back(contact);
///     contacts.group(seeds, maxSeparation);
///     for (int k = 0; k < kMaxClusters; ++k) write(contacts.cluster(k));
///
/// Buffers are reused from pair to pair.
class ClusteredContacts {
 public:
  /// The list, to be filled before `group`, in any order.
  std::vector<Contact>& list() { return list_; }
  const std::vector<Contact>& list() const { return list_; }

  /// Groups the list by normal: first around last step's seeds, then greedily from the deepest contact that is left. A
  /// contact that finds no free cluster joins the nearest one. Each seed becomes the mean normal of its members,
  /// weighted by depth, or inactive. `cosine`: of the angle within which normals share a cluster. Precondition: every
  /// separation is below `maxSeparation` (world length). Cost: n log n.
  void group(ClusterSeeds& seeds, float maxSeparation, float cosine = kClusterCosine);

  /// Valid until the list changes.
  std::span<Contact> cluster(int k) {
    const auto i = static_cast<std::size_t>(k);
    return std::span(list_).subspan(begin_[i], end_[i] - begin_[i]);
  }
  /// Sorts a cluster again after its separations changed, and drops contacts that are no longer below `maxSeparation`.
  void resort(int k, float maxSeparation);
  /// Sorts contacts into a cluster. Precondition: the cluster is empty.
  void fill(int k, std::span<const Contact> contacts);
  /// Moves the second cluster's contacts into the first and sorts that; the second is then empty. Precondition: into <
  /// from.
  void join(int into, int from);

 private:
  void keepLastClusters(ClusterSeeds& seeds, float cosine);
  void openNewClusters(ClusterSeeds& seeds, float cosine);
  void gather();

  std::vector<Contact> list_;
  std::vector<Contact> grouped_;
  std::vector<int> clusterOf_;  // by index in the list
  std::array<std::size_t, kMaxClusters> begin_{}, end_{};
};

}  // namespace cairn::bullet

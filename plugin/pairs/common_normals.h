// SPDX-License-Identifier: Zlib
#pragma once

#include <array>
#include <span>
#include <vector>

#include "colliders/collider.h"
#include "contacts/normal_clusters.h"

namespace cairn::bullet {

/// Contacts that do not fit the direction found for their cluster: at hand, and left over by the next one. Working
/// memory.
struct Outliers {
  std::vector<Contact> now, next;
};

/// The directions of a pair's clusters of contacts, from step to step: one for each cluster between flat faces.
class CommonNormals {
 public:
  void forget() { *this = {}; }
  /// Where clusters began in the last step; grouping moves them.
  ClusterSeeds& seeds() { return seeds_; }
  /// Zero where a cluster has none.
  const std::array<Vec3, kMaxClusters>& normals() const { return normals_; }
  /// Whether every contact of the last step has one.
  bool areFlat() const { return isFlat_; }

  /// What the meshes said has its directions already.
  void keep(ClusteredContacts& contacts);
  /// Finds one for each cluster of leaves' contacts.
  void alignNormals(Collider& collider, float maxSeparation, ClusteredContacts& contacts, Outliers& outliers);

 private:
  void clusterOutliers(Collider& collider, float maxSeparation, std::span<const Vec3> lasts,
                       ClusteredContacts& contacts, Outliers& outliers);
  void joinSameNormals(ClusteredContacts& contacts);

  ClusterSeeds seeds_{};
  std::array<Vec3, kMaxClusters> normals_{};
  bool isFlat_ = false;
};

}  // namespace cairn::bullet

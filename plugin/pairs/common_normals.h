// SPDX-License-Identifier: Zlib
#pragma once

#include <array>
#include <span>
#include <vector>

#include "colliders/collider.h"
#include "contacts/normal_clusters.h"

namespace cairn::bullet {

/// Working memory: contacts that do not fit their cluster's normal. `now`: to be clustered; `next`: left over for the
/// next cluster.
struct Outliers {
  std::vector<Contact> now, next;
};

/// The normals of a pair's contact clusters, kept from step to step. A cluster between flat faces has one common
/// normal.
class CommonNormals {
 public:
  void forget() { *this = {}; }
  /// The seeds of the last step's clusters; grouping moves them.
  ClusterSeeds& seeds() { return seeds_; }
  /// Common normals by cluster; zero where a cluster has none.
  const std::array<Vec3, kMaxClusters>& normals() const { return normals_; }
  /// Whether every contact of the last step has a common normal.
  bool areFlat() const { return isFlat_; }

  /// Takes the normals of contacts from meshes, which need no alignment.
  void keep(ClusteredContacts& contacts);
  /// Finds a common normal for each cluster of contacts from leaves.
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

// SPDX-License-Identifier: Zlib
#include "pairs/common_normals.h"

#include <algorithm>

namespace cairn::bullet {

namespace {

// The present contacts, deepest first. Speculative contacts, whose normals are known, come after them.
std::span<Contact> ofNow(std::span<Contact> cluster) {
  const auto end = std::partition(cluster.begin(), cluster.end(), [](const Contact& c) { return !c.isSpeculative; });
  const auto now = cluster.first(static_cast<std::size_t>(end - cluster.begin()));
  if (now.size() < cluster.size()) std::sort(now.begin(), now.end(), deeper);
  return now;
}

}  // namespace

// Contacts of meshes have their normals already, and speculative contacts have normals of their own.
void CommonNormals::keep(ClusteredContacts& contacts) {
  isFlat_ = !contacts.list().empty();
  for (int k = 0; k < kMaxClusters; ++k) {
    const std::span<Contact> cluster = contacts.cluster(k);
    const auto measured = std::ranges::find(cluster, false, &Contact::isSpeculative);
    normals_[static_cast<std::size_t>(k)] = measured == cluster.end() ? Vec3() : measured->normal;
  }
}

void CommonNormals::alignNormals(Collider& collider, float maxSeparation, ClusteredContacts& contacts,
                                 Outliers& outliers) {
  outliers.now.clear();
  const std::array<Vec3, kMaxClusters> lasts = normals_;
  for (int k = 0; k < kMaxClusters; ++k) {
    const std::span<Contact> cluster = contacts.cluster(k), now = ofNow(cluster);
    Vec3& common = normals_[static_cast<std::size_t>(k)];
    common = now.empty() ? Vec3() : collider.alignNormals(now, lasts, outliers.now);
    // Along the common normal some contacts are farther apart than wanted.
    if (lengthSq(common) > 0 || now.size() < cluster.size()) contacts.resort(k, maxSeparation);
  }
  clusterOutliers(collider, maxSeparation, lasts, contacts, outliers);
  joinSameNormals(contacts);
  isFlat_ = !contacts.list().empty();
  for (int k = 0; k < kMaxClusters; ++k)
    if (!contacts.cluster(k).empty() && lengthSq(normals_[static_cast<std::size_t>(k)]) == 0) isFlat_ = false;
}

// Faces at a shallow angle share a cluster, but each needs its own while clusters are free: two sides of a groove
// resist different motions.
void CommonNormals::clusterOutliers(Collider& collider, float maxSeparation, std::span<const Vec3> lasts,
                                    ClusteredContacts& contacts, Outliers& outliers) {
  std::sort(outliers.now.begin(), outliers.now.end(), deeper);  // they come from several clusters
  for (int k = 0; k < kMaxClusters && !outliers.now.empty(); ++k) {
    if (!contacts.cluster(k).empty()) continue;
    Vec3& common = normals_[static_cast<std::size_t>(k)];
    outliers.next.clear();
    common = collider.alignNormals(outliers.now, lasts, outliers.next);
    if (lengthSq(common) == 0) return;
    contacts.fill(k, outliers.now);
    contacts.resort(k, maxSeparation);
    seeds_[static_cast<std::size_t>(k)] = {common, true};
    outliers.now.swap(outliers.next);
  }
}

// Tilted lines between centres can divide the contacts of one pair of faces among several clusters.
void CommonNormals::joinSameNormals(ClusteredContacts& contacts) {
  for (std::size_t k = 0; k < normals_.size(); ++k)
    for (std::size_t j = k + 1; j < normals_.size(); ++j) {
      if (dot(normals_[k], normals_[j]) < kSameNormalCosine) continue;
      contacts.join(static_cast<int>(k), static_cast<int>(j));
      normals_[j] = {};
      seeds_[j].active = false;
    }
}

}  // namespace cairn::bullet

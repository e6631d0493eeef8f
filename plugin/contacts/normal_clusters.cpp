// SPDX-License-Identifier: Zlib
#include "contacts/normal_clusters.h"

#include <algorithm>

namespace cairn::bullet {

namespace {

struct Nearest {
  int cluster = -1;
  float cosine = -2;
};

Nearest nearestSeed(const ClusterSeeds& seeds, const Vec3& normal) {
  Nearest best;
  for (int k = 0; k < kMaxClusters; ++k) {
    const ClusterSeed& seed = seeds[static_cast<std::size_t>(k)];
    if (!seed.active) continue;
    const float cosine = dot(seed.normal, normal);
    if (cosine > best.cosine) best = {k, cosine};
  }
  return best;
}

int freeCluster(const ClusterSeeds& seeds) {
  for (int k = 0; k < kMaxClusters; ++k)
    if (!seeds[static_cast<std::size_t>(k)].active) return k;
  return -1;
}

// Weights are positive, because every separation is below `maxSeparation`.
void recenter(std::span<const Contact> cluster, ClusterSeed& seed, float maxSeparation) {
  Vec3 sum;
  for (const Contact& c : cluster) sum += c.normal * (maxSeparation - c.separation);
  const float norm = length(sum);
  if (norm > 0) seed.normal = sum / norm;
}

}  // namespace

void ClusteredContacts::group(ClusterSeeds& seeds, float maxSeparation, float cosine) {
  std::sort(list_.begin(), list_.end(), deeper);
  clusterOf_.assign(list_.size(), -1);
  keepLastClusters(seeds, cosine);
  openNewClusters(seeds, cosine);
  gather();
  for (int k = 0; k < kMaxClusters; ++k) recenter(cluster(k), seeds[static_cast<std::size_t>(k)], maxSeparation);
}

void ClusteredContacts::keepLastClusters(ClusterSeeds& seeds, float cosine) {
  std::array<bool, kMaxClusters> used{};
  for (std::size_t i = 0; i < list_.size(); ++i) {
    const Nearest nearest = nearestSeed(seeds, list_[i].normal);
    if (nearest.cosine < cosine) continue;
    clusterOf_[i] = nearest.cluster;
    used[static_cast<std::size_t>(nearest.cluster)] = true;
  }
  for (std::size_t k = 0; k < seeds.size(); ++k) seeds[k].active = used[k];
}

void ClusteredContacts::openNewClusters(ClusterSeeds& seeds, float cosine) {
  for (std::size_t i = 0; i < list_.size(); ++i) {
    if (clusterOf_[i] >= 0) continue;
    const Vec3& normal = list_[i].normal;
    const Nearest nearest = nearestSeed(seeds, normal);
    const int unused = nearest.cosine >= cosine ? -1 : freeCluster(seeds);
    clusterOf_[i] = unused >= 0 ? unused : nearest.cluster;
    if (unused >= 0) seeds[static_cast<std::size_t>(unused)] = {normal, true};
  }
}

// Stable: each cluster keeps the order by depth.
void ClusteredContacts::gather() {
  end_.fill(0);
  for (const int k : clusterOf_) ++end_[static_cast<std::size_t>(k)];
  std::size_t sum = 0;
  for (std::size_t k = 0; k < end_.size(); ++k) {
    begin_[k] = sum;
    sum += end_[k];
    end_[k] = begin_[k];
  }
  grouped_.resize(list_.size());
  for (std::size_t i = 0; i < list_.size(); ++i) grouped_[end_[static_cast<std::size_t>(clusterOf_[i])]++] = list_[i];
  list_.swap(grouped_);
}

void ClusteredContacts::fill(int k, std::span<const Contact> contacts) {
  const auto first = static_cast<std::size_t>(k);
  const auto at = list_.begin() + static_cast<std::ptrdiff_t>(begin_[first]);
  const auto added = list_.insert(at, contacts.begin(), contacts.end());
  std::sort(added, added + static_cast<std::ptrdiff_t>(contacts.size()), deeper);
  end_[first] = begin_[first] + contacts.size();
  for (std::size_t j = first + 1; j < begin_.size(); ++j) {
    begin_[j] += contacts.size();
    end_[j] += contacts.size();
  }
}

void ClusteredContacts::join(int into, int from) {
  const auto first = static_cast<std::size_t>(into), second = static_cast<std::size_t>(from);
  const auto at = [&](std::size_t i) { return list_.begin() + static_cast<std::ptrdiff_t>(i); };
  // The second cluster's contacts move behind the first's; clusters between them shift.
  const std::size_t moved = end_[second] - begin_[second], end = end_[first];
  std::rotate(at(end), at(begin_[second]), at(end_[second]));
  for (std::size_t k = first + 1; k < second; ++k) {
    begin_[k] += moved;
    end_[k] += moved;
  }
  end_[first] += moved;
  begin_[second] = end_[second];
  std::sort(at(begin_[first]), at(end_[first]), deeper);
}

void ClusteredContacts::resort(int k, float maxSeparation) {
  const std::span<Contact> members = cluster(k);
  if (!std::is_sorted(members.begin(), members.end(), deeper)) std::sort(members.begin(), members.end(), deeper);
  std::size_t& end = end_[static_cast<std::size_t>(k)];
  while (end > begin_[static_cast<std::size_t>(k)] && list_[end - 1].separation >= maxSeparation) --end;
}

}  // namespace cairn::bullet

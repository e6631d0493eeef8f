// SPDX-License-Identifier: Zlib
#pragma once

#include <array>

#include "cairn/core/tree_pair_traversal.h"
#include "colliders/collider.h"
#include "colliders/planar_normal.h"
#include "contacts/normal_clusters.h"

namespace cairn::bullet {

/// Contacts with another sphere-tree. In a `NodePair`, a is a node of the pair's tree and b a node of the collider.
class TreeCollider final : public Collider {
 public:
  void reset() override;
  void place(const PairPlacement& placement) override;
  void start(std::vector<NodePair>& known, float skin) override;
  bool resume() override;
  Traversal& traversal() override { return traversal_; }
  void shrinkToFit() override;
  bool isCacheable() const override { return true; }
  void appendContacts(std::span<const NodePair> pairs, std::vector<Contact>& contacts) override;
  void appendContacts(std::span<const NodePair> pairs, std::span<float> separations,
                      std::vector<Contact>& contacts) override;
  Contact boundingContact(const NodePair& pair) override;
  /// Where one tree is much larger, its root says little. So the larger tree is opened down to spheres about as large
  /// as the smaller root, by at most eight families.
  std::uint32_t appendRootContacts(std::vector<Contact>& contacts) override;
  bool hasSimilarSize() const override { return isOfLikeSize_; }
  void expect(std::span<const Vec3> normals) override;
  Vec3 alignNormals(std::span<Contact> cluster, std::span<const Vec3> lasts, std::vector<Contact>& outliers) override;
  NodePair leavesOf(const Contact& contact) const override;
  std::optional<float> appendOfMesh(const MeshQuery& question, std::vector<Contact>& contacts) override;
  float meshError() const override { return a_.contactMeshError() + b_.contactMeshError(); }
  std::optional<std::uint64_t> expectedMeshCost(const RelativePlacement& placement) const override;
  float size(const btCollisionShape& shape) const override;

 private:
  std::optional<float> appendOfKernel(const MeshQuery& question, std::vector<Contact>& contacts);
  bool isMuchLarger(const Sphere& large, const Sphere& small) const;
  Vec3 centerLine(const Sphere& a, const Sphere& b) const;
  // Whether there is a contact. Sets its separation in either case, to a lower bound on the surfaces' separation. The
  // bound may stop at any value that is at least `atMost`.
  bool touch(Contact& contact, float atMost) const;
  // The centre line of planar regions depends on where the leaves lie, more than on where the surfaces meet. So the
  // contact is measured along the best separating one of the centre line and the planar regions' normals. Returns false
  // when that reaches `maxSeparation_`, or when the two do not face each other.
  bool preferPlanes(Contact& contact) const;
  // The answer of the pair's last common normals for two regions of flat faces.
  enum class Expected : std::uint8_t { nothing, apart, touching };
  Expected touchAsExpected(Contact& contact, const Sphere& a, const Sphere& b) const;
  void setId(Contact& contact) const;
  // Lower bound on the separation of the two regions along a unit vector.
  float separation(const NodePair& pair, const Vec3& along) const;
  // Sets separation and position along the contact's normal. Returns false when the separation reaches
  // `maxSeparation_`. A separation of `atMost` or more may be larger than the value set.
  bool measure(Contact& contact, float atMost) const;
  // Like `touch` for each pair, in order, but many at a time; `separations` may be empty.
  void appendMeasured(std::span<const NodePair> pairs, float atMost, std::span<float> separations,
                      std::vector<Contact>& contacts) const;
  // A bit for each pair that the common normals may decide; these are tested one by one.
  std::uint32_t expectedOf(std::span<const NodePair> pairs) const;
  // The end of `touch` for a pair found near along its centre line.
  bool touchAsMeasured(Contact& contact, const RegionSeparations& measured, std::uint32_t lane) const;
  bool areFaceted(const NodePair& pair) const;

  PlacedTree a_, b_;
  float margins_ = 0;
  float maxSeparation_ = 0;
  float contactDistance_ = 0;
  KernelMemory kernelMemory_;
  TreePairTraversal traversal_;
  bool isOfLikeSize_ = true;
  std::vector<Contact> rootContacts_;  // working memory of `appendRootContacts`
  PlanarNormal planarNormal_;
  std::array<Vec3, kMaxClusters> expected_;
  std::size_t expectedCount_ = 0;
};

}  // namespace cairn::bullet

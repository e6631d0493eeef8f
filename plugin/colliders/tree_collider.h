// SPDX-License-Identifier: Zlib
#pragma once

#include <array>

#include "cairn/core/tree_pair_traversal.h"
#include "colliders/collider.h"
#include "colliders/planar_normal.h"
#include "contacts/normal_clusters.h"

namespace cairn::bullet {

/// Another sphere-tree. In a `NodePair`, a is a node of the pair's tree and b one of the collider.
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
  /// Where one tree is much larger, its root says little: the larger one is followed down to spheres about as large as
  /// the smaller one's, at most eight families.
  std::uint32_t appendRootContacts(std::vector<Contact>& contacts) override;
  bool isOfLikeSize() const override { return isOfLikeSize_; }
  void expect(std::span<const Vec3> normals) override;
  Vec3 alignNormals(std::span<Contact> cluster, std::span<const Vec3> lasts, std::vector<Contact>& outliers) override;
  NodePair leavesOf(const Contact& contact) const override;
  std::optional<float> appendOfMesh(const MeshQuestion& question, std::vector<Contact>& contacts) override;
  std::optional<std::uint64_t> expectedMeshCost(const RelativePlacement& placement) const override;
  float size(const btCollisionShape& shape) const override;

 private:
  std::optional<float> appendOfKernel(const MeshQuestion& question, std::vector<Contact>& contacts);
  bool isMuchLarger(const Sphere& large, const Sphere& small) const;
  Vec3 centerLine(const Sphere& a, const Sphere& b) const;
  // Whether there is a contact; its gap is set either way, to what the surfaces are apart at least, or at least to
  // something not below `atMost`.
  bool touch(Contact& contact, float atMost) const;
  // Where a region is planar, the centre line says more about where the leaves lie than about where the surfaces meet:
  // the contact is then measured along whichever of it and the planar regions' normals separates best. False when that
  // is not below the reach, or when the two do not face each other.
  bool preferPlanes(Contact& contact) const;
  // What the pair's last common normals say of two regions of flat faces.
  enum class Expected : std::uint8_t { nothing, apart, touching };
  Expected touchAsExpected(Contact& contact, const Sphere& a, const Sphere& b) const;
  void name(Contact& contact) const;
  // How far apart the two regions are along a unit vector, at least.
  float separation(const NodePair& pair, const Vec3& along) const;
  // Gap and position along the contact's normal; false when the gap is not below the reach. A gap of `atMost` or more
  // is larger than what is set.
  bool measure(Contact& contact, float atMost) const;
  // What `touch` says of each pair, in order, but many at a time; `separations` may be empty.
  void appendMeasured(std::span<const NodePair> pairs, float atMost, std::span<float> separations,
                      std::vector<Contact>& contacts) const;
  // A bit for each of the pairs of which the common normals may say something: these are asked one by one.
  std::uint32_t expectedOf(std::span<const NodePair> pairs) const;
  // The end of `touch` for a pair that was found near along its centre line.
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

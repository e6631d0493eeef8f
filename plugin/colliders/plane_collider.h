// SPDX-License-Identifier: Zlib
#pragma once

#include <limits>

#include "cairn/core/obstacle_traversal.h"
#include "colliders/collider.h"

namespace cairn::bullet {

/// The half-space below a plane as the traversal of a tree tests it: one element. Exact.
class PlaneObstacle final : public Obstacle {
 public:
  /// In the tree's frame and unit: points p with dot(normal, p) < offset are below. `margin` is added to every sphere.
  void place(const Vec3& normal, float offset, float margin);

  std::uint32_t elementCount() const override { return 1; }
  std::uint32_t touches(const Family& family, std::uint32_t familySize, std::uint32_t element) const override;

 private:
  Vec3 normal_;
  float limit_ = 0;
};

/// Contacts with a btStaticPlaneShape.
class PlaneCollider final : public Collider {
 public:
  /// Meshes of at most so many vertices touch with their vertices. A larger mesh may be meant to be round, and rolls
  /// better on its leaves.
  static constexpr std::size_t kMaxVertices = 48;

  void reset() override;
  void place(const PairPlacement& placement) override;
  void start(std::vector<NodePair>& known, float skin) override;
  bool resume() override;
  Traversal& traversal() override { return traversal_; }
  bool isCacheable() const override { return true; }
  using Collider::appendContacts;
  void appendContacts(std::span<const NodePair> pairs, std::vector<Contact>& contacts) override;
  std::optional<float> appendOfMesh(const MeshQuery& question, std::vector<Contact>& contacts) override;
  Contact boundingContact(const NodePair& pair) override;
  std::uint32_t appendCoarse(std::vector<Contact>& contacts) override;
  float size(const btCollisionShape& /*shape*/) const override { return std::numeric_limits<float>::infinity(); }

 private:
  void placeObstacle();
  bool hasFewVertices() const;
  void findVertices();
  void appendContact(const NodePair& pair, const Vec3& onTree, int pointIndex, std::vector<Contact>& contacts) const;

  PlacedTree tree_;
  int otherIndex_ = -1;  // of the shape, among its compound's children
  float margin_ = 0;
  float maxSeparation_ = 0;
  bool isQuery_ = false;  // looks farther than the contact distance
  float skin_ = 0;
  Vec3 normal_;  // pair frame; the plane is dot(normal_, p) == offset_
  float offset_ = 0;
  PlaneObstacle obstacle_;
  ObstacleTraversal traversal_;
  struct NearVertex {
    std::uint32_t vertex;
    NodeId leaf;
  };
  std::vector<NearVertex> nearVertices_;  // of the current traversal, once it is done
  bool areFound_ = false;
  std::vector<NodeId> leafOf_;  // by vertex; working memory
};

}  // namespace cairn::bullet

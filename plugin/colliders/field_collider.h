// SPDX-License-Identifier: Zlib
#pragma once

#include <optional>

#include "cairn/core/obstacle_traversal.h"
#include "colliders/collider.h"
#include "colliders/distance_field.h"

namespace cairn::bullet {

/// A signed distance field as the traversal of a tree tests it: one element. Conservative under the assumption of
/// `DistanceField`. Cost: one query for each sphere, about a microsecond.
class FieldObstacle final : public Obstacle {
 public:
  /// `toShape` maps the tree's frame to the shape's. `margin` (world length) is added to every sphere. The field must
  /// outlive its use here.
  void place(const Similarity& toShape, const DistanceField& field, float margin);

  std::uint32_t elementCount() const override { return 1; }
  std::uint32_t touches(const Family& family, std::uint32_t familySize, std::uint32_t element) const override;

 private:
  Similarity toShape_;
  const DistanceField* field_ = nullptr;
  float margin_ = 0;
};

/// Contacts with a btSdfCollisionShape. They are measured where a leaf is lowest in the field, at its support points or
/// between them, along the field's gradient there.
class FieldCollider final : public Collider {
 public:
  void place(const PairPlacement& placement) override;
  void start(std::vector<NodePair>& known, float skin) override;
  bool resume() override;
  Traversal& traversal() override { return traversal_; }
  /// The owner detects another field by its fingerprint.
  bool isCacheable() const override { return true; }
  void appendContacts(std::span<const NodePair> pairs, std::vector<Contact>& contacts) override;
  void appendContacts(std::span<const NodePair> pairs, std::span<float> separations,
                      std::vector<Contact>& contacts) override;
  Contact boundingContact(const NodePair& pair) override;
  /// Appends nothing where the field has no value at the tree's centre.
  std::uint32_t appendRootContacts(std::vector<Contact>& contacts) override;
  std::uint32_t appendCoarse(std::vector<Contact>& contacts) override;
  float size(const btCollisionShape& shape) const override;

 private:
  // A point of a leaf, and the field there with its gradient in the pair frame.
  struct Place {
    Vec3 point;
    DistanceField::Sample field;
    bool isSupport = true;  // one of the leaf's support points, not between them
  };

  void placeObstacle();
  std::optional<Place> placeAt(const Vec3& point) const;
  // Returns a lower bound on the separation of the leaf and the surface.
  float appendLeaf(NodeId leaf, std::vector<Contact>& contacts) const;
  // `place`, or the leaf's farthest point against the gradient there if that is lower.
  Place lowerExtreme(NodeId leaf, const Place& place) const;
  // In the domain, and where the field has a direction: nothing touches elsewhere.
  static bool canTouch(const Place& place);
  // `middle`: the centre of the leaf's ball.
  std::optional<Place> lowest(NodeId leaf, const std::optional<Place>& middle) const;
  std::optional<Place> lowestSupport(NodeId leaf, const std::optional<Place>& middle) const;
  std::optional<Place> descend(NodeId leaf, const Place& from) const;
  static bool seeOtherSides(const Place& middle, const Place& lowest);
  void appendCorners(NodeId leaf, const Place& lowest, std::vector<Contact>& contacts) const;
  void appendContact(NodeId leaf, const Place& place, int pointIndex, std::vector<Contact>& contacts) const;

  PlacedTree tree_;
  int otherIndex_ = -1;  // of the shape, among its compound's children
  float margin_ = 0;
  float maxSeparation_ = 0;
  float skin_ = 0;
  Similarity shapeFromPair_, shapeFromTree_;
  Mat3 pairFromShapeAxes_;
  DistanceField field_;
  FieldObstacle obstacle_;
  ObstacleTraversal traversal_;
};

}  // namespace cairn::bullet

// SPDX-License-Identifier: Zlib
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "cairn/core/obstacle_traversal.h"
#include "colliders/collider.h"
#include "colliders/convex_surface.h"
#include "contacts/facing_corners.h"
#include "placement/triangle.h"

namespace cairn::bullet {

/// A convex shape as the traversal of a tree tests it: one element, the shape's box in its own frame. Exact for boxes,
/// conservative for other shapes. Only leaves ask for the true distance, because GJK costs as much as some hundred of
/// these tests.
class ConvexObstacle final : public Obstacle {
 public:
  /// `toShape` maps the tree's frame to the shape's. `margin` (world length) is added to every sphere.
  void place(const Similarity& toShape, const Vec3& boxCenter, const Vec3& boxHalfExtents, float margin);

  std::uint32_t elementCount() const override { return 1; }
  std::uint32_t touches(const Family& family, std::uint32_t familySize, std::uint32_t element) const override;

 private:
  Similarity toShape_;
  Vec3 center_, halfExtents_;
  float margin_ = 0;
};

/// Contacts with any convex shape of Bullet: between meshes and shape where `ConvexContacts` can answer, else between
/// leaves and shape.
class ConvexCollider final : public Collider, private ConvexBody {
 public:
  void place(const PairPlacement& placement) override;
  void start(std::vector<NodePair>& known, float skin) override;
  bool isUnchanged(const btCollisionShape& other) const override;
  bool resume() override { return true; }
  Traversal& traversal() override { return traversal_; }
  using Collider::appendContacts;
  void appendContacts(std::span<const NodePair> pairs, std::vector<Contact>& contacts) override;
  Contact boundingContact(const NodePair& pair) override;
  std::uint32_t appendCoarse(std::vector<Contact>& contacts) override;
  float size(const btCollisionShape& shape) const override;
  std::optional<float> appendOfMesh(const MeshQuery& question, std::vector<Contact>& contacts) override;
  float meshError() const override { return tree_.contactMeshError(); }
  NodePair leavesOf(const Contact& contact) const override;

 private:
  struct Plane {
    Vec3 normal;
    float offset;
  };
  // The relation of a leaf and the shape, apart or overlapping.
  struct Touch {
    Plane plane;   // supports the shape; the one tried so far that the leaf lies highest above
    float height;  // height of the leaf's lowest point above the plane
    Vec3 point;    // point of the leaf that is about the nearest to the shape
  };
  static constexpr std::size_t kMaxPlanes = 8;

  bool isCertainlySeparated(const Sphere& sphere) const;
  NearestPoint nearest(const Vec3& pointInPair) override;
  float apartFrom(const Vec3& pointInPair) override { return surface_.apartFrom(shapeFromPair_ * pointInPair); }
  Vec3 support(const Vec3& direction) const override;
  Vec3 middle() const override { return boxMiddle_; }
  void appendLeaf(NodeId leaf, const Sphere& sphere, std::vector<Contact>& contacts);
  Touch touchAlong(NodeId leaf, const Plane& plane) const;
  // Replaces the plane if the leaf lies higher above another.
  void improve(NodeId leaf, Touch& touch);
  // Nearest point of the shape to the hull of a leaf's known points, in the shape's frame; empty when GJK gives up.
  std::optional<NearestPoint> nearestToLeaf(NodeId leaf);
  void offer(NodeId leaf, const Plane& plane, Touch& touch) const;
  void offerFaces(NodeId leaf, Touch& touch) const;
  // For a leaf that is large against the shape. Contacts are the parts of the shape's face,
  // edge or point over the leaf's triangles, seen along the normal. The leaf's own points on the shape are contacts
  // too. Returns false when there is neither.
  bool appendCommon(NodeId leaf, const Touch& touch, std::vector<Contact>& contacts);
  void appendOnTriangle(NodeId leaf, const Vec3& normal, const Triangle& triangle, std::span<const Vec3> face,
                        std::vector<Contact>& contacts) const;
  bool isOnShape(const Vec3& onTree, float height);
  void appendContact(NodeId leaf, const Touch& touch, const Vec3& onTree, int pointIndex,
                     std::vector<Contact>& contacts);
  void append(NodeId leaf, const Vec3& normal, const Vec3& position, float separation, int pointIndex,
              std::vector<Contact>& contacts) const;
  // Measures leaves again along the face if they touch across borders that are no edges of the body; see `InnerEdges`.
  void measureInnerEdges(std::size_t first, std::vector<Contact>& contacts);
  void appendAlong(const Vec3& normal, const Contact& inner, std::vector<Contact>& contacts);
  Vec3 pulledOntoShape(const Vec3& onTree, const Vec3& anchor, float height);
  NearestPoint inPair(const NearestPoint& inShape) const;

  PlacedTree tree_;
  int otherIndex_ = -1;  // of the shape, among its compound's children
  float margin_ = 0;
  float maxSeparation_ = 0, contactDistance_ = 0;
  float size_ = 0;        // of the shape
  bool isSmall_ = false;  // the shape against the tree: it may land on one of the tree's faces
  FacingCorners facing_;
  Similarity shapeFromPair_;
  Mat3 pairFromShapeAxes_;
  Vec3 shapeOrigin_, boxMiddle_;
  Box box_;  // of the shape in its own frame, margin included
  ConvexSurface surface_;
  std::vector<Plane> planes_;  // of this step, pair frame: the shape lies behind each
  ConvexObstacle obstacle_;
  ObstacleTraversal traversal_;
};

}  // namespace cairn::bullet

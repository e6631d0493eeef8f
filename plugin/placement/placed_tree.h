// SPDX-License-Identifier: Zlib
#pragma once

#include <span>

#include "cairn/core/pose.h"
#include "cairn/core/region_separation.h"
#include "cairn/core/sphere_tree.h"
#include "placement/face_cone.h"

namespace cairn::bullet {

/// A sphere-tree at a pose: its nodes and their regions, in the pair frame.
///
///     const PlacedTree tree(shape.tree(), treePose(shape, body));
///     const Sphere ball = tree.sphere(node);
class PlacedTree {
 public:
  PlacedTree() = default;
  /// The tree must outlive this object. `contactLevel`: see `SphereTreeShape::contactLevel`; 0: the source.
  PlacedTree(const SphereTree& tree, const Pose& pose, std::uint32_t contactLevel = 0);

  const SphereTree& tree() const { return *tree_; }
  const Pose& pose() const { return pose_; }
  const Similarity& toPair() const { return toPair_; }
  /// Rotation from the pair frame's axes to the tree's.
  const Mat3& axesFromPair() const { return axesFromPair_; }
  float scale() const { return toPair_.scale; }
  /// The mesh that contacts are measured on, tree frame.
  SurfaceView contactMesh() const {
    return contactLevel_ == 0 ? tree_->surfaceView() : tree_->levelView(contactLevel_);
  }
  /// Certified: no point of that mesh or of the source is farther from the other, world length.
  float contactMeshError() const {
    return contactLevel_ == 0 ? 0 : tree_->levelMesh(contactLevel_).distance * toPair_.scale;
  }
  /// How thick the body is where it is thin, world length; see `TreeSurface::thickness`.
  float thickness() const { return contactMesh().derived->thickness * toPair_.scale; }

  /// A point of the pair frame in the tree's frame and unit.
  Vec3 toTree(const Vec3& p) const { return axesFromPair_ * (p - toPair_.translation) * (1 / toPair_.scale); }

  PlacedRegions regions() const { return {*tree_, toPair_, axesFromPair_}; }
  Sphere sphere(NodeId node) const { return regions().sphere(node); }
  /// Radius of a ball around the sphere's centre that lies inside the solid; 0 if the centre is outside.
  float innerRadius(NodeId node) const { return tree_->innerRadius(node) * toPair_.scale; }
  /// Whether the node's region lies in one plane, see `SphereTree::isPlanar`.
  bool isPlanar(NodeId node) const { return tree_->isPlanar(node); }
  /// Whether the node's region consists of flat faces that the tree names, see `SphereTree::isFaceted`.
  bool isFaceted(NodeId node) const { return tree_->isFaceted(node); }
  /// The middle of the node's outward normals: unit, pair frame.
  Vec3 facing(NodeId node) const {
    const Vec3& axis = tree_->node(node).normalCone.axis;
    return toPair_.linear * axis * (1 / toPair_.scale);
  }
  /// Whether the node's region certainly faces along `direction` (unit), by 18 degrees or more.
  bool facesAlong(NodeId node, const Vec3& direction) const {
    return tree_->node(node).normalCone.cosine > 0 && dot(facing(node), direction) > 0.3F;
  }
  /// Whether the region's extreme point along `direction` (unit) is the body's too: the direction is one of the
  /// region's normals, see `isAmongNormals`.
  bool faces(NodeId node, const Vec3& direction) const {
    return !isFaceted(node) || isAmongNormals(tree_->faceNormals(node), axesFromPair_ * direction);
  }
  /// The region's support points, tree frame; for a planar leaf they are the corners of its patch.
  std::span<const Vec3> supportPoints(NodeId node) const { return tree_->supportPoints(node); }
  /// The point of the node's region that lies farthest along `direction`.
  Vec3 support(NodeId node, const Vec3& direction) const { return regions().support(node, direction); }
  /// The farthest along `direction` of the region's support points and, where the tree lists them, its corners. It is a
  /// point of the body. With many corners it costs as much as six contacts.
  Vec3 farthestCorner(NodeId node, const Vec3& direction) const;
  /// Lower bound on how far the body reaches along `direction` (unit) near the node, as a point. It is the region's
  /// farthest support point, or the farthest point of its ball less the certified error. The body has points as far out
  /// as this.
  Vec3 certainReach(NodeId node, const Vec3& direction) const;
  /// Like `certainReach`, but considers the region's corners too, where the tree lists them. With many corners it costs
  /// as much as six contacts.
  Vec3 extreme(NodeId node, const Vec3& direction) const;
  /// A leaf whose ball holds the point, or is near it. Descends to the child with most room around the point.
  NodeId leafAt(const Vec3& point) const;

 private:
  Vec3 certainReach(NodeId node, const Vec3& direction, const Vec3& point) const;
  Vec3 farthestOf(std::span<const std::uint32_t> corners, const Vec3& direction, const Vec3& point) const;

  const SphereTree* tree_ = nullptr;
  std::uint32_t contactLevel_ = 0;
  Pose pose_;
  Similarity toPair_;
  Mat3 axesFromPair_;
};

}  // namespace cairn::bullet

// SPDX-License-Identifier: Zlib
#pragma once

#include <span>
#include <vector>

#include "cairn/core/obstacle_traversal.h"
#include "colliders/collider.h"
#include "colliders/mesh_ground.h"
#include "triangles/triangle_contacts.h"
#include "triangles/triangle_sides.h"
#include "triangles/triangle_soup.h"
#include "triangles/triangles_on_faces.h"

namespace cairn::bullet {

/// Contacts with any shape made of triangles: BVH mesh, scaled mesh, height field, GImpact mesh, a foreign concave
/// shape. The surface is the triangles themselves, both sides alike, without Bullet's margin. In a `NodePair`, b is an
/// index into the gathered soup.
class TriangleCollider final : public Collider {
 public:
  void reset() override;
  void place(const PairPlacement& placement) override;
  void start(std::vector<NodePair>& known, float skin) override;
  bool resume() override;
  Traversal& traversal() override { return traversal_; }
  using Collider::appendContacts;
  void appendContacts(std::span<const NodePair> pairs, std::vector<Contact>& contacts) override;
  /// A node's side of a triangle can only be decided from everything it touches.
  bool usesCurvatureCorrection() const override { return false; }
  bool measuresTogether() const override { return true; }
  Contact boundingContact(const NodePair& pair) override;
  /// Uses the nearest of the gathered triangles, and those in other directions that it does not cover, up to four.
  /// Cost: linear in the triangles; only appended contacts are counted as work.
  std::uint32_t appendRootContacts(std::vector<Contact>& contacts) override;
  /// Gives the contacts of two meshes, where the triangles are those of one solid and do not change.
  std::optional<float> appendOfMesh(const MeshQuery& question, std::vector<Contact>& contacts) override;
  float meshError() const override { return placement_.tree.contactMeshError(); }
  NodePair leavesOf(const Contact& contact) const override;
  float size(const btCollisionShape& shape) const override;

 private:
  void gather();
  void rename(std::vector<NodePair>& known) const;
  void placeTriangles();
  void divide(std::span<const NodePair> pairs);
  void measure(std::span<const NodePair> pairs, const PairPlacement& placement, std::vector<Contact>& contacts);
  void measureQuery(std::span<const NodePair> pairs, std::vector<Contact>& contacts);
  bool isNear(const NodePair& pair) const;

  PairPlacement placement_;
  btVector3 treeLower_, treeUpper_;  // the tree's box in the shape's frame
  bool outran_ = false;              // the tree left the last traversal's triangles: gather farther ahead
  TriangleSoup soup_;
  std::vector<TriangleSoup::Source> oldSources_;
  std::vector<Triangle> inPair_;
  std::vector<Contact> rootContacts_;  // working memory of `appendRootContacts`
  SoupObstacle obstacle_;
  ObstacleTraversal traversal_;
  TriangleSides sides_;
  TriangleContacts contacts_;
  TrianglesOnFaces onFaces_;
  MeshGround ground_;
  std::vector<NodePair> near_;              // working memory of `appendContacts`
  std::vector<NodePair> ofFaces_, others_;  // working memory of `divide`
};

}  // namespace cairn::bullet

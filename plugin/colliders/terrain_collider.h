// SPDX-License-Identifier: Zlib
#pragma once

#include <limits>
#include <span>
#include <vector>

#include "cairn/bullet/terrain_shape.h"
#include "cairn/core/obstacle_traversal.h"
#include "colliders/collider.h"
#include "terrain/terrain_lattice.h"
#include "triangles/triangle_contacts.h"

namespace cairn::bullet {

/// The ground below a terrain as the traversal of a tree tests it: one element. Each sphere finds the part below itself
/// (thesis 8.3.2).
class GroundObstacle final : public Obstacle {
 public:
  /// `terrainFromTree` maps from the tree's frame and unit. `margin` (world length) is added to every sphere.
  void place(const TerrainLattice& lattice, const Pose& terrainFromTree, double margin);

  std::uint32_t elementCount() const override { return 1; }
  std::uint32_t touches(const Family& family, std::uint32_t familySize, std::uint32_t element) const override;

 private:
  const TerrainLattice* lattice_ = nullptr;
  Pose terrainFromTree_;
  double margin_ = 0;
};

/// Contacts with a `TerrainShape`. All space below the surface is inside, at any depth. So the side of a body needs no
/// memory, and no triangles are collected between steps. In a contact's id, the part is 0, or one plus the number of a
/// planar leaf's support point; the index is the triangle.
class TerrainCollider final : public Collider {
 public:
  void place(const PairPlacement& placement) override;
  void start(std::vector<NodePair>& known, float skin) override;
  bool resume() override;
  Traversal& traversal() override { return traversal_; }
  using Collider::appendContacts;
  void appendContacts(std::span<const NodePair> pairs, std::vector<Contact>& contacts) override;
  Contact boundingContact(const NodePair& pair) override;
  /// Uses the nearest triangle near the root, and those in other directions that it does not cover, up to four. Cost:
  /// linear in the triangles; only appended contacts are counted as work.
  std::uint32_t appendRootContacts(std::vector<Contact>& contacts) override;
  float size(const btCollisionShape& /*shape*/) const override { return std::numeric_limits<float>::infinity(); }

 private:
  void placeObstacle();
  void forgetFrom(std::size_t count);
  void gather(NodeId node);
  void appendCorners(NodeId leaf, std::size_t firstNear, std::vector<Contact>& contacts);
  static void dropCovered(std::vector<Contact>& contacts, std::size_t first, std::size_t corners);
  std::span<TriangleTouch> measure();
  Contact contactOfBall(const TriangleTouch& touch) const;
  Triangle toPair(const TerrainLattice::Corners& t) const;
  ContactId idOf(NodeId node, int part, int triangle) const;

  PairPlacement placement_;
  const TerrainLattice* lattice_ = nullptr;
  Pose pairFromTerrain_, terrainFromPair_;
  GroundObstacle obstacle_;
  ObstacleTraversal traversal_;
  TriangleContacts contacts_;
  // Working memory, by triangle near one of the tested nodes; `b` of a pair is an index into these.
  std::vector<Triangle> inPair_;
  std::vector<int> indices_, sideOf_;
  std::vector<NodePair> pairs_;
  std::vector<int> sides_;  // by touch
  std::vector<Contact> rootContacts_;
  TerrainLattice::Corners last_;  // the triangle gathered last
  bool isComplete_ = false;       // no ground was missing below the sphere tested last
};

}  // namespace cairn::bullet

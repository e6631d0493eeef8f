// SPDX-License-Identifier: Zlib
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "contacts/contact.h"
#include "counterparts/placed_tree.h"
#include "counterparts/triangle.h"

namespace cairn::bullet {

/// Turns (leaf, triangle) pairs into contacts without being tripped by the edges inside a mesh.
///
/// For each leaf, its triangles are taken nearest first. A triangle whose nearest point lies behind the contact plane
/// of a nearer one is covered by it: on flat or convex ground only the triangle below the leaf counts. Triangles that
/// share their nearest point (an edge or a corner) make one contact, along whichever of the centre line and their face
/// normals separates the region best. A region that faces away touches nothing, but still covers what lies behind, so
/// neither the top of a plate on the ground nor the far side of a rock that has sunk into it pulls the body down. What
/// has sunk through comes back to the side of the centre of mass. Back faces are not ignored: soups need not be closed
/// or oriented.
class TriangleContacts {
 public:
  /// Appends the contacts with a gap below `reach`. `triangles` are in the pair frame; b of a pair indexes them.
  void append(const PlacedTree& tree, float margin, float reach, std::span<const Triangle> triangles,
              std::span<const NodePair> pairs, std::vector<Contact>& contacts);

 private:
  struct Touch {
    NodePair pair;
    Vec3 nearest;  // on the triangle, to the leaf's centre
    Vec3 line;     // from there to the centre; the face's normal where that is the same
    Vec3 normal;   // the line, on the region's side; zero: no touch
    Vec3 face;     // the face's normal, first on the centre's side, then on the region's
    float distance;
    bool onFace;
    bool isBeyond;          // the centre of mass is on the other side of the triangle's plane than the leaf's centre
    std::uint8_t side = 1;  // of the triangle: 1 where its normal points, else 2
  };
  struct Group {
    const Touch* first;
    Vec3 normal;  // the best so far
    float height;
    Vec3 onTree;
  };

  static Touch touchOf(const PlacedTree& tree, const Triangle& triangle, const NodePair& pair);
  void findSunk(const PlacedTree& tree, std::size_t triangleCount);
  Vec3 touchingNormal(const PlacedTree& tree, const Touch& touch, const Vec3& normal) const;
  void setNormals(const PlacedTree& tree, Touch& touch) const;
  void appendLeaf(const PlacedTree& tree, std::span<const Touch> touches, float margin, float reach,
                  std::span<const Triangle> triangles, std::vector<Contact>& contacts);
  void offer(const PlacedTree& tree, Group& group, const Vec3& normal) const;

  bool standsIn_ = false;  // a region reaches through a triangle
  std::vector<std::uint8_t>
      faced_;  // by triangle: the sides from which a leaf faces it, the centre of mass on the other
  std::vector<Touch> touches_;
  std::vector<Group> groups_;
};

}  // namespace cairn::bullet

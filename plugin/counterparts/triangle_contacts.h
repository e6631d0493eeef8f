// SPDX-License-Identifier: Zlib
#pragma once

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
/// normals separates the region best. A region that faces away touches nothing, so the far side of a rock that has sunk
/// into the ground does not pull it down. Back faces are not ignored: soups need not be closed or oriented.
class TriangleContacts {
 public:
  /// Appends the contacts with a gap below `reach`. `triangles` are in the pair frame; b of a pair indexes them.
  void append(const PlacedTree& tree, float margin, float reach, std::span<const Triangle> triangles,
              std::span<const NodePair> pairs, std::vector<Contact>& contacts);

 private:
  struct Touch {
    NodePair pair;
    Vec3 nearest;  // on the triangle, to the leaf's centre
    Vec3 normal;   // from there to the centre; the face's where that is the same; zero: no touch
    Vec3 face;     // the face's normal, on the leaf's side
    float distance;
    bool onFace;
  };
  struct Group {
    const Touch* first;
    Vec3 normal;  // the best so far
    float height;
    Vec3 onTree;
  };

  Touch touchOf(const PlacedTree& tree, const Triangle& triangle, const NodePair& pair) const;
  void appendLeaf(const PlacedTree& tree, std::span<const Touch> touches, float margin, float reach,
                  std::span<const Triangle> triangles, std::vector<Contact>& contacts);
  void offer(const PlacedTree& tree, Group& group, const Vec3& normal) const;

  std::vector<Touch> touches_;
  std::vector<Group> groups_;
};

}  // namespace cairn::bullet

// SPDX-License-Identifier: Zlib
#pragma once

#include <span>
#include <vector>

#include "contacts/contact.h"
#include "triangles/triangle_sides.h"
#include "triangles/triangle_touch.h"

namespace cairn::bullet {

/// Turns (leaf, triangle) pairs into contacts without being tripped by the edges inside a mesh.
///
/// For each leaf, its triangles are taken nearest first. A triangle whose nearest point lies behind the contact plane
/// of a nearer one is covered by it: on flat or convex ground only the triangle below the leaf counts. Triangles that
/// share their nearest point (an edge or a corner) make one contact, along whichever of the centre line and their face
/// normals separates the region best. A region that faces away touches nothing, but still covers what lies behind, so
/// neither the top of a plate on the ground nor the far side of a rock that has sunk into it pulls the body down. What
/// has sunk through a triangle comes back (`TriangleSides`). Back faces are not ignored: soups need not be closed or
/// oriented.
class TriangleContacts {
 public:
  /// Appends the contacts with a gap below the placement's reach. `triangles` are in the pair frame; b of a pair
  /// indexes them. `isComplete`: they are all pairs of their leaves.
  void append(const PairPlacement& placement, std::span<const Triangle> triangles, std::span<const NodePair> pairs,
              bool isComplete, TriangleSides& sides, std::vector<Contact>& contacts);

  /// The same in two steps, for who knows the sides. First the touches of these pairs, ordered by node and nearest
  /// first, to be changed as need be; valid until the next call.
  std::span<TriangleTouch> measure(const PairPlacement& placement, std::span<const Triangle> triangles,
                                   std::span<const NodePair> pairs);
  /// Then their contacts, with the side of each touch: see `TriangleSides::settle`.
  void appendMeasured(const PairPlacement& placement, std::span<const Triangle> triangles, std::span<const int> sides,
                      std::vector<Contact>& contacts);

 private:
  // How a region touches: the touch's line and face on the region's side, zero where it does not touch along them.
  struct Touch : TriangleTouch {
    Vec3 normal;
    Vec3 faceNormal;
  };
  struct Group {
    const Touch* first;
    Vec3 normal;  // the best so far
    float height;
    Vec3 onTree;
  };

  static Touch onSide(const PlacedTree& tree, const TriangleTouch& touch, int side);
  void appendLeaf(const PairPlacement& placement, std::span<const Touch> touches, std::span<const Triangle> triangles,
                  std::vector<Contact>& contacts);
  void group(const PlacedTree& tree, std::span<const Touch> touches);
  static void offer(const PlacedTree& tree, Group& group, const Vec3& normal);

  std::vector<TriangleTouch> all_;
  std::vector<Touch> touches_;
  std::vector<Group> groups_;
};

}  // namespace cairn::bullet

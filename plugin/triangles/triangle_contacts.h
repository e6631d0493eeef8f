// SPDX-License-Identifier: Zlib
#pragma once

#include <span>
#include <vector>

#include "contacts/contact.h"
#include "triangles/triangle_sides.h"
#include "triangles/triangle_touch.h"

namespace cairn::bullet {

/// Makes contacts of (leaf, triangle) pairs that do not catch on the edges inside a mesh.
///
///     triangleContacts.append(placement, triangles, pairs, isComplete, sides, contacts);
///
/// Each leaf's triangles are taken nearest first, by these rules:
///
/// 1. A triangle whose nearest point lies behind the contact plane of a nearer one is covered. On flat or convex ground
///    only the triangle below the leaf counts.
/// 2. Triangles that share their nearest point (an edge or a corner) make one contact. Its normal is the centre line or
///    one of their face normals, whichever separates the region best.
/// 3. A region that faces away touches nothing, but still covers what lies behind. So neither the top of a plate on the
///    ground nor the far side of a sunken rock pulls the body down.
/// 4. A region that has sunk through a triangle comes back (`TriangleSides`).
/// 5. Back faces count, because soups need not be closed or oriented.
class TriangleContacts {
 public:
  /// Appends the contacts whose separation is below the placement's `maxSeparation`. `triangles` are in the pair frame;
  /// b of a pair is their index. `isComplete`: the pairs are all pairs of their leaves.
  void append(const PairPlacement& placement, std::span<const Triangle> triangles, std::span<const NodePair> pairs,
              bool isComplete, TriangleSides& sides, std::vector<Contact>& contacts);

  /// First of two steps for callers that know the sides. Gives the touches of these pairs, sorted by node and nearest
  /// first; the caller may change them. Valid until the next call.
  std::span<TriangleTouch> measure(const PairPlacement& placement, std::span<const Triangle> triangles,
                                   std::span<const NodePair> pairs);
  /// Second step: appends the contacts of the measured touches. `sides` has one entry for each touch; see
  /// `TriangleSides::settle`.
  void appendMeasured(const PairPlacement& placement, std::span<const Triangle> triangles, std::span<const int> sides,
                      std::vector<Contact>& contacts);

 private:
  // How a region touches: line and face on the region's side, zero where the region does not touch along them.
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

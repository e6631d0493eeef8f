// SPDX-License-Identifier: Zlib
#pragma once

#include <span>
#include <vector>

#include "contacts/contact.h"
#include "placement/placed_tree.h"
#include "placement/unit_vector.h"

namespace cairn::bullet {

/// Finds the common normal of a cluster of contacts between flat faces of two trees.
///
///     const Vec3 normal = planarNormal.find(a, b, margins, cluster, lasts);
///     if (lengthSq(normal) == 0) return {};  // not flat
///
/// Centre lines between offset leaves on two flat faces are tilted. Depth along a tilted line is too large, so that
/// flat bodies would float. If at least half of a cluster's weight touches leaves of flat faces, all its contacts take
/// one direction. It is the direction of least depth, along which the bodies separate soonest.
///
/// Between polyhedra this is a face's normal or the cross product of two edges (Gottschalk's separating axes). An edge
/// is where two faces of one leaf meet. Last step's direction stays unless another is shallower by
/// `kHysteresisFraction` of the bodies' size.
class PlanarNormal {
 public:
  PlanarNormal() { candidates_.reserve(kMaxCandidates); }

  /// Returns zero when the cluster is not flat. `lasts`: the last step's common normals, zero for a cluster without
  /// one. `margins` (world length) are part of the contacts' separations. Cost: up to `kMaxCandidates` pairs of support
  /// evaluations a contact; most candidates are given up after a few.
  Vec3 find(const PlacedTree& a, const PlacedTree& b, float margins, std::span<const Contact> cluster,
            std::span<const Vec3> lasts);

  /// Whether a contact's two regions are farther apart than `minSeparation` along some direction that both of them
  /// face.
  bool isFartherAlongOther(const PlacedTree& a, const PlacedTree& b, float margins, const Contact& contact,
                           float minSeparation);

 private:
  static constexpr std::size_t kMaxFaces = 12;
  static constexpr std::size_t kMaxCandidates = 24;

  struct Candidate {
    Vec3 normal;
    float bonus;  // world length by which it may be deeper than another candidate and still win
  };

  // Precondition of the calls: deepest contact first.
  void collectFacesOfBoth(const PlacedTree& a, const PlacedTree& b, const Contact& contact);
  void collectFaces(const PlacedTree& tree, NodeId node, float side, const Vec3& towards);
  void collectEdges(const PlacedTree& a, const PlacedTree& b, const Contact& contact);
  void putLastFirst(std::span<const Vec3> lasts, float bonus);
  bool add(const Vec3& normal, const Vec3& towards, std::size_t maxCount);

  std::vector<Candidate> candidates_;
};

}  // namespace cairn::bullet

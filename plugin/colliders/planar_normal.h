// SPDX-License-Identifier: Zlib
#pragma once

#include <span>
#include <vector>

#include "contacts/contact.h"
#include "placement/placed_tree.h"
#include "placement/unit_vector.h"

namespace cairn::bullet {

/// The common normal of a cluster of contacts between flat faces of two trees.
///
/// Centre lines between offset leaves on two flat faces are tilted, and depth measured along a tilted line is too
/// large: flat bodies would float. Where at least half of a cluster's weight touches leaves that consist of flat faces,
/// all its contacts take one direction, that of least depth: the one along which the bodies separate soonest. Between
/// polyhedra it is a face's normal or the cross product of two edges (Gottschalk's separating axes), and an edge is
/// where two faces of one leaf meet. Last step's direction stays unless another is shallower by `kHysteresisFraction`
/// of the bodies' size.
class PlanarNormal {
 public:
  PlanarNormal() { candidates_.reserve(kMaxCandidates); }

  /// Zero when the cluster is not flat. `lasts`: the common normals of the last step, zero where there was none. Cost:
  /// up to `kMaxCandidates` pairs of support evaluations a contact; most candidates are given up after a few.
  /// `margins` (world length) are part of the contacts' gaps.
  Vec3 find(const PlacedTree& a, const PlacedTree& b, float margins, std::span<const Contact> cluster,
            std::span<const Vec3> lasts);

  /// Whether along some direction that the two regions of a contact face their gap is greater than `least`.
  bool isFartherAlongOther(const PlacedTree& a, const PlacedTree& b, float margins, const Contact& contact,
                           float least);

 private:
  static constexpr std::size_t kMaxFaces = 12;
  static constexpr std::size_t kMaxCandidates = 24;

  struct Candidate {
    Vec3 normal;
    float bonus;  // world length by which it may be deeper than others and still be taken
  };

  // Deepest contact first.
  void collectFacesOfBoth(const PlacedTree& a, const PlacedTree& b, const Contact& contact);
  void collectFaces(const PlacedTree& tree, NodeId node, float side, const Vec3& towards);
  void collectEdges(const PlacedTree& a, const PlacedTree& b, const Contact& contact);
  void putLastFirst(std::span<const Vec3> lasts, float bonus);
  bool add(const Vec3& normal, const Vec3& towards, std::size_t most);

  std::vector<Candidate> candidates_;
};

}  // namespace cairn::bullet

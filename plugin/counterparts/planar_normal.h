// SPDX-License-Identifier: Zlib
#pragma once

#include <span>
#include <vector>

#include "contacts/contact.h"
#include "counterparts/placed_tree.h"

namespace cairn::bullet {

/// The common normal of a cluster of contacts between flat regions of two trees.
///
/// Centre lines between offset leaves on two flat faces are tilted, and depth measured along a tilted line is too
/// large: flat bodies would float. Where at least half of a cluster's weight touches planar leaves, all its contacts
/// take the direction of least depth among the leaves' face normals (the one along which the bodies separate soonest);
/// last step's direction stays unless another is shallower by `kHysteresisFraction` of the regions' size. Scheme R3+h
/// of the measured comparison.
class PlanarNormal {
 public:
  PlanarNormal() { candidates_.reserve(kMaxCandidates); }

  /// Zero when the cluster is not flat. `last`: the cluster's common normal in the last step, or zero. Cost: up to
  /// `kMaxCandidates` support evaluations a contact.
  Vec3 find(const PlacedTree& a, const PlacedTree& b, std::span<const Contact> cluster, const Vec3& last);

 private:
  static constexpr std::size_t kMaxCandidates = 12;

  // Planar regions first (a curved one has facets enough to fill the list), the two bodies in turn, deepest contact
  // first.
  void collect(const PlacedTree& tree, NodeId node, float side, const Vec3& towards, bool ofPlanar);
  void addCandidate(const Vec3& normal, const Vec3& towards);

  std::vector<Vec3> candidates_;
};

}  // namespace cairn::bullet

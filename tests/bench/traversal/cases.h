// SPDX-License-Identifier: Zlib
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "reference_traversal.h"

namespace cairn::bench {

/// How the spheres of the next `count` family tests are moved.
struct Move {
  Similarity into;
  float margin = 0;
  std::size_t count = 0;
};

/// Two bodies of one tree in many overlapping poses, and what traversing them takes.
struct TraversalCase {
  std::string name;
  std::shared_ptr<const SphereTree> tree;
  std::vector<Pose> poses;  ///< of the second body; the first stands at the origin
  float margin = 0;

  std::vector<std::uint32_t> families;  ///< tested by all traversals, in their order
  std::vector<NodeId> others;           ///< the node each of them is tested against
  std::vector<Move> moves;              ///< what moves those, in runs
  std::uint64_t sphereTests = 0;        ///< living lanes of the families
  std::string hash;                     ///< of the leaf pairs of all poses, by the reference
};

/// A ring whose tree has `leaves` leaves or a few less; no builder needed.
std::shared_ptr<const SphereTree> ringTree(std::uint32_t leaves);

/// Random balls over a cloud of points, with families of two to eight.
std::shared_ptr<const SphereTree> cloudTree(std::uint32_t points);

/// Fills a case by running the reference at `poseCount` random poses. Aborts none: every pose overlaps at the roots.
TraversalCase makeCase(std::string name, std::shared_ptr<const SphereTree> tree, std::size_t poseCount,
                       std::uint64_t seed);

}  // namespace cairn::bench

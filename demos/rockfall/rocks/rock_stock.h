// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <vector>

#include "cairn/effects/fragments.h"
#include "rockfall/case/case.h"
#include "rockfall/rocks/tree_cache.h"

namespace cairn::rockfall {

/// A shape of rock at a sieve size of 1 m.
struct RockShape {
  std::shared_ptr<const SphereTree> tree;
  double scale = 1;                 ///< metres per mesh unit for a sieve size of 1 m
  double volume = 0;                ///< m^3
  double reach = 0;                 ///< distance from the centre of mass to the farthest point, m
  std::array<double, 3> extents{};  ///< along the principal axes, least first, m; the middle one is 1
  double inertiaRatio = 1;          ///< greatest principal moment divided by the least
  /// The pieces it breaks into; null unless the case lists fragmentation.
  std::shared_ptr<const effects::Fragments> fragments;
};

/// All shapes of all groups of a case: `groups[g]` holds the variants of group g.
struct RockStock {
  std::vector<std::vector<RockShape>> groups;
  /// SHA-256 over all trees, hexadecimal. Runs are equal only with equal trees.
  std::string hash;
};

/// Makes or imports the meshes and obtains their trees. Variant v of group g is a pure function of (seed of the case,
/// g, v). Fails as `importMesh` and `buildTree` do.
Result<RockStock> stockRocks(const Case& scene, TreeCache& cache, const builder::ProgressCallback& progress = {});

/// Measures a tree's mesh at a sieve size of 1 m. The sieve size is the middle one of the extents along the principal
/// axes.
RockShape measureRock(std::shared_ptr<const SphereTree> tree);

}  // namespace cairn::rockfall

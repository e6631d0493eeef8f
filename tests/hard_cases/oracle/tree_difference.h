// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>

#include "cairn/core/sphere_tree.h"

namespace cairn::hard {

/// How far two trees' nodes are apart, the second's taken back by a shift and a scale: lengths of the first's unit.
/// Enormous, but finite, if they do not have the same nodes.
struct TreeDifference {
  double balls = 0;   ///< the larger of the farthest centres and the most unlike radii
  double errors = 0;  ///< beyond the 1 % that errors are certified to

  TreeDifference(const SphereTree& first, const SphereTree& second, double scale = 1, const Vec3d& shift = {}) {
    constexpr double kUnlike = 1e300;
    if (first.nodeCount() != second.nodeCount()) balls = errors = kUnlike;
    for (std::uint32_t i = 0; i < first.nodeCount() && balls < kUnlike; ++i) {
      const NodeData &a = first.data().nodes[i], &b = second.data().nodes[i];
      if (a.parent != b.parent) balls = errors = kUnlike;
      const Vec3d back = (second.origin() - shift + Vec3d(b.center)) / scale;
      balls = std::max({balls, distance(first.origin() + Vec3d(a.center), back),
                        std::abs(double(a.radius) - double(b.radius) / scale)});
      const double error = double(b.error) / scale;
      errors = std::max(errors, std::abs(double(a.error) - error) - 0.01 * std::max(double(a.error), error));
    }
  }
};

}  // namespace cairn::hard

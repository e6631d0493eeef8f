// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "cairn/core/result.h"
#include "cairn/core/sphere_tree.h"
#include "still_scenes.h"
#include "test_solids.h"

namespace cairn::bench {

/// One solid in every shape Bullet can give it, a kilogram each and with the same inertia: that of the mesh.
struct TriedShapes {
  struct Named {
    std::string name;  ///< tree, own, hull, gimpact
    test::TriedBody body;
  };
  std::vector<Named> shapes;
  std::shared_ptr<const SphereTree> tree;

  const test::TriedBody& ours() const { return shapes.front().body; }
  /// About an axis of the mesh, of a kilogram.
  double moment(int axis) const { return double(ours().inertia[axis]); }
};

/// The solid's tree as `cairn build` makes it, `own` (Bullet's primitive), the exact hull and GImpact; margins as in
/// frame_budget: 1 % of the size for hulls, 0.1 % for GImpact.
Result<TriedShapes> tryShapes(const test::Solid& solid, const std::string& name, std::shared_ptr<btCollisionShape> own);

}  // namespace cairn::bench

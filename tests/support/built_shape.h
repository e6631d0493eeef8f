// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <stdexcept>
#include <utility>

#include "builder_meshes.h"
#include "bullet_world.h"
#include "cairn/builder/build.h"

namespace cairn::test {

/// A solid's tree as the builder makes it by default, of so many levels, as a shape.
inline std::shared_ptr<btCollisionShape> builtShape(const Solid& solid,
                                                    std::uint32_t depth = builder::BuildOptions().depth) {
  builder::BuildOptions options;
  options.depth = depth;
  auto tree = builder::buildTree(meshOf(solid), options);
  if (!tree) throw std::runtime_error(tree.error().message);
  return treeShape(std::make_shared<const SphereTree>(std::move(tree).value()));
}

}  // namespace cairn::test

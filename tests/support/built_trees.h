// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <stdexcept>
#include <utility>

#include "cairn/builder/build.h"

namespace cairn::test {

/// A small tree of a mesh, by the quickest method.
inline SphereTree quickTree(const builder::TriangleMesh& mesh, std::uint32_t depth = 2) {
  builder::BuildOptions options;
  options.method = builder::Method::octree;
  options.depth = depth;
  options.samples = 500;
  Result<SphereTree> tree = builder::buildTree(mesh, options);
  if (!tree) throw std::runtime_error(tree.error().message);
  return std::move(tree).value();
}

/// The tree with `change` applied to its data.
template <class Change>
SphereTree tampered(const SphereTree& tree, const Change& change) {
  SphereTreeData data = tree.data();
  change(data);
  Result<SphereTree> result = SphereTree::create(std::move(data));
  if (!result) throw std::runtime_error(result.error().message);
  return std::move(result).value();
}

}  // namespace cairn::test

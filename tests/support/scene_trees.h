// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <memory>

#include "scenes/command/tree_source.h"

namespace cairn::test {

/// The tree of a generated rock.
inline std::shared_ptr<const SphereTree> rockTree(const scenes::RockOptions& rock, std::uint32_t depth,
                                                  std::uint32_t samples) {
  scenes::TreeSource source;
  source.rock = rock;
  source.build.depth = depth;
  source.build.samples = samples;
  auto built = scenes::obtainTree(source);
  if (!built) ADD_FAILURE() << built.error().message;
  return built ? built.value().tree : nullptr;
}

/// Small enough to be built in a fraction of a second; built once for the whole program.
inline std::shared_ptr<const SphereTree> smallRockTree() {
  static const std::shared_ptr<const SphereTree> tree = rockTree({2, 2}, 2, 500);
  return tree;
}

/// As fine as the programs make them; takes seconds.
inline std::shared_ptr<const SphereTree> fineRockTree() {
  static const std::shared_ptr<const SphereTree> tree = rockTree({1, 3}, 3, 5000);
  return tree;
}

}  // namespace cairn::test

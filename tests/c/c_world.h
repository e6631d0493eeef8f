// SPDX-License-Identifier: Zlib
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "cairn/cairn.h"
#include "cairn/core/tree_file.h"
#include "test_trees.h"

namespace cairn::test {

struct FreeInC {
  void operator()(CairnTree* tree) const { cairnFreeTree(tree); }
  void operator()(CairnShape* shape) const { cairnFreeShape(shape); }
  void operator()(CairnWorld* world) const { cairnFreeWorld(world); }
};
using TreeInC = std::unique_ptr<CairnTree, FreeInC>;
using ShapeInC = std::unique_ptr<CairnShape, FreeInC>;
using WorldInC = std::unique_ptr<CairnWorld, FreeInC>;

inline TreeInC inC(const SphereTree& tree) {
  const std::vector<std::byte> bytes = encodeTree(tree);
  return TreeInC(cairnReadTree(bytes.data(), bytes.size()));
}

inline constexpr CairnPose kAtOrigin = {{0, 0, 0}, {0, 0, 0, 1}};

inline CairnPose at(float x, float y, float z) {
  return {{x, y, z}, {0, 0, 0, 1}};
}

/// A floor and bodies of one tree above it.
struct HeapInC {
  explicit HeapInC(const SphereTree& tree, int bodies)
      : shape(cairnMakeShape(inC(tree).get(), nullptr)), world(cairnMakeWorld(nullptr)) {
    const float up[3] = {0, 1, 0};
    EXPECT_EQ(cairnAddPlane(world.get(), up, 0, nullptr), 1) << cairnError();
    for (int i = 0; i < bodies; ++i) {
      const CairnPose pose = at(0.1F * float(i % 3), 1 + float(i), 0);
      EXPECT_EQ(cairnAddBody(world.get(), shape.get(), 1, &pose, nullptr), i) << cairnError();
    }
  }
  void step(int steps) {
    for (int i = 0; i < steps; ++i) ASSERT_EQ(cairnStep(world.get()), 1) << cairnError();
  }

  ShapeInC shape;
  WorldInC world;
};

}  // namespace cairn::test

// SPDX-License-Identifier: Zlib
// The contact kernel stops when its budget is spent.
#include <gtest/gtest.h>

#include "kernel/contact_kernel.h"
#include "kernel_limits.h"
#include "test_trees.h"

namespace cairn::test::contact_kernel_budget_test {
namespace {

using namespace bullet;

// Bodies that need everything: deep searches, rays, and a second look. A family's near boxes are compared with a whole
// family in any case.
TEST(ContactKernel, IsCutOffByABudget) {
  constexpr std::uint64_t kOfAFamily = kOverlapTestCost * PatchFamily::kWidth * PatchFamily::kWidth;
  const auto ring = plainTree(torus(0.3, 0.12, 16), 4);
  const auto plate = plainTree(cuboid({1, 1, 0.1}, 8), 4);
  const PlacedTree ringA(*ring, Pose{Mat3d(), {0.25, 0, 0.1}, 1}), ringB(*ring, Pose());
  const Mat3d tilted{{Vec3d(1, 0, 0.01), Vec3d(0, 1, 0), Vec3d(-0.01, 0, 1)}};
  const Pose askew{tilted, {0.01, 0.02, 0.092}, 1};
  const PlacedTree plateA(*plate, askew), plateB(*plate, Pose());
  ContactKernel kernel;
  for (const SurfacePair& pair : {SurfacePair::of(ringA, ringB), SurfacePair::of(plateA, plateB)}) {
    const auto run = [&](std::uint64_t operations) {
      KernelMemory memory;
      Budget budget = Budget::operations(operations);
      const auto answer = kernel.run(pair, limitsOf(), memory, {}, budget);
      EXPECT_LE(budget.used(), operations + kOfAFamily) << operations << " operations";
      return answer ? budget.used() : 0;
    };
    EXPECT_EQ(run(0), 0U);
    EXPECT_EQ(run(20), 0U);
    const std::uint64_t whole = run(1000000);
    EXPECT_GT(whole, 0U);
    for (std::uint64_t operations = 1; operations <= whole; operations += 1 + whole / 500) run(operations);
  }
}

}  // namespace
}  // namespace cairn::test::contact_kernel_budget_test

// SPDX-License-Identifier: Zlib
#include "cairn/core/vec3.h"

#include <gtest/gtest.h>

#include <random>

#include "random_tree.h"

namespace cairn::vec3_test {
namespace {

// GCC 12 optimises this rounding away unless told not to: see cmake/CairnTargets.cmake.
[[gnu::noinline]] Vec3d roundedToFloat(const Vec3d& v) {
  return Vec3d(Vec3(v));
}

TEST(Vec3, RoundingToFloat_SurvivesOptimisation) {
  std::mt19937_64 engine(3);
  for (int i = 0; i < 100; ++i) {
    const Vec3d exact = test::randomPoint(engine);
    const Vec3d rounded = roundedToFloat(exact);
    for (int axis = 0; axis < 3; ++axis) {
      const volatile float f = static_cast<float>(exact[axis]);
      EXPECT_EQ(rounded[axis], static_cast<double>(f)) << "axis " << axis;
    }
  }
}

}  // namespace
}  // namespace cairn::vec3_test

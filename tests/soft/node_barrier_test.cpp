// SPDX-License-Identifier: Zlib
// The plane that keeps a node out, against a look at every triangle.
#include "node_barrier.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <random>

#include "random_tree.h"
#include "solid_oracle.h"
#include "test_trees.h"

namespace cairn::soft {
namespace {

using test::SolidOracle;
using test::uniform;

constexpr int kWays = 3000;
constexpr float kMargin = 0.05F;
constexpr double kRounding = 1e-5;  // of solids some units wide, in floats: 2^-24 times a few operations

struct Crossing {
  double share = 2;  // of the way
  std::uint32_t triangle = 0;
  bool enters = false;
};

// The first triangle that the way meets, of all.
Crossing firstCrossing(const SolidOracle& oracle, const Vec3d& from, const Vec3d& to) {
  Crossing first;
  for (std::uint32_t t = 0; t < oracle.triangles.size(); ++t) {
    const auto c = oracle.corners(t);
    const Vec3d n = cross(c[1] - c[0], c[2] - c[0]);
    const double speed = dot(n, to - from);
    const double share = dot(n, c[0] - from) / speed;
    if (!(share >= 0 && share <= 1 && share < first.share)) continue;
    const Vec3d p = from + (to - from) * share;
    bool isWithin = true;
    for (std::size_t k = 0; k < 3; ++k) isWithin = isWithin && dot(cross(c[(k + 1) % 3] - c[k], p - c[k]), n) >= 0;
    if (isWithin) first = {share, t, speed < 0};
  }
  return first;
}

class NodeBarrier_ : public testing::TestWithParam<test::Solid> {
 protected:
  std::shared_ptr<const SphereTree> tree_ = test::plainTree(GetParam());
  SurfaceView surface_ = tree_->surfaceView();
  SolidOracle oracle_{tree_->vertices(), tree_->triangles()};
  NodeBarrierSearch search_;
};

TEST_P(NodeBarrier_, IsTheFaceEnteredFirstOrTheNearestPoint) {
  constexpr std::uint64_t kSeed = 45;
  SCOPED_TRACE(kSeed);
  std::mt19937_64 engine(kSeed);
  NodeTrack track;
  int entered = 0, near = 0, none = 0;
  for (int i = 0; i < kWays; ++i) {
    const Vec3 from(test::randomPoint(engine) * 1.5);
    const Vec3 to = from + Vec3(test::randomPoint(engine) * uniform(engine, 0.0, 0.6));
    const std::optional<NodeBarrier> barrier = search_.find(surface_, from, to, kMargin, track);
    const Crossing crossing = firstCrossing(oracle_, Vec3d(from), Vec3d(to));
    const double distance = oracle_.toSurface(Vec3d(to));
    if (crossing.share <= 1 && crossing.enters) {
      ++entered;
      ASSERT_TRUE(barrier);
      const auto c = oracle_.corners(crossing.triangle);
      const Vec3d n = normalized(cross(c[1] - c[0], c[2] - c[0]));
      EXPECT_NEAR(double(barrier->separation), dot(n, Vec3d(to) - c[0]), kRounding);
      EXPECT_NEAR(dot(n, Vec3d(barrier->normal)), 1, kRounding);
      continue;
    }
    const double separation = oracle_.windingNumber(Vec3d(to)) > 0.5 ? -distance : distance;
    if (separation > double(kMargin) + kRounding) {
      ++none;
      EXPECT_FALSE(barrier) << separation;
    } else if (separation < double(kMargin) - kRounding) {
      ++near;
      ASSERT_TRUE(barrier) << separation;
      EXPECT_NEAR(double(barrier->separation), separation, kRounding);
      // Out along the normal the node comes to the surface.
      EXPECT_NEAR(oracle_.toSurface(Vec3d(to) - Vec3d(barrier->normal) * separation), 0, kRounding);
    }
  }
  EXPECT_GT(entered, 10);
  EXPECT_GT(near, 10);
  EXPECT_GT(none, 10);
}

TEST_P(NodeBarrier_, DoesNotDependOnTheGuess) {
  std::mt19937_64 engine(7);
  for (int i = 0; i < 300; ++i) {
    const Vec3 point(test::randomPoint(engine));
    NodeTrack first, last;
    last.triangle = static_cast<std::uint32_t>(tree_->triangles().size()) - 1;
    const auto a = search_.find(surface_, point, point, 1, first), b = search_.find(surface_, point, point, 1, last);
    ASSERT_EQ(a.has_value(), b.has_value());
    if (a) EXPECT_EQ(a->separation, b->separation);
  }
}

// A track saves searches and changes no answer: nodes that wander, with their tracks and with new ones.
TEST_P(NodeBarrier_, DoesNotDependOnTheTrack) {
  constexpr std::uint64_t kSeed = 11;
  SCOPED_TRACE(kSeed);
  std::mt19937_64 engine(kSeed);
  for (int node = 0; node < 40; ++node) {
    NodeTrack track;
    Vec3 place(test::randomPoint(engine) * 1.5);
    for (int step = 0; step < 60; ++step) {
      const Vec3 to = place + Vec3(test::randomPoint(engine) * uniform(engine, 0.0, 0.1));
      NodeTrack fresh;
      const auto a = search_.find(surface_, place, to, kMargin, track),
                 b = search_.find(surface_, place, to, kMargin, fresh);
      ASSERT_EQ(a.has_value(), b.has_value());
      if (a) EXPECT_EQ(a->separation, b->separation);
      place = to;
    }
  }
}

// A rigid motion, where it must go with the whole mesh.
TEST_P(NodeBarrier_, CarriedPointsGoWithTheTriangle) {
  std::mt19937_64 engine(5);
  const Mat3d turn = test::randomRotation(engine);
  const Vec3d shift = test::randomPoint(engine);
  std::vector<Vec3> moved;
  for (const Vec3& v : tree_->vertices()) moved.emplace_back(turn * Vec3d(v) + shift);
  const SurfaceView second{moved, tree_->triangles(), nullptr};
  for (int i = 0; i < 100; ++i) {
    const auto triangle = static_cast<std::uint32_t>(uniform(engine) * double(tree_->triangles().size()));
    const Vec3 point(test::randomPoint(engine));
    EXPECT_LT(distance(Vec3d(carried(point, surface_, second, triangle)), turn * Vec3d(point) + shift), 1e-3)
        << "of floats a unit wide, and triangles of some hundredths";
  }
}

TEST_P(NodeBarrier_, WaysThatAreNoNumbersMeetNothing) {
  NodeTrack track;
  const float nan = std::nanf("");
  EXPECT_FALSE(search_.find(surface_, {nan, 0, 0}, {0, 0, nan}, kMargin, track));
}

INSTANTIATE_TEST_SUITE_P(Solids, NodeBarrier_,
                         testing::Values(test::torus(0.7, 0.25, 24), test::ball(1, 3),
                                         test::cuboid({1.6, 1.2, 0.05}, 2), test::bowl(1, 0.9, 24)));

}  // namespace
}  // namespace cairn::soft

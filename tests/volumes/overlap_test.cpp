// SPDX-License-Identifier: GPL-3.0-or-later
#include "volumes/overlap.h"

#include <gtest/gtest.h>

#include "volume_cases.h"
#include "volumes/random_volumes.h"

namespace cairn::bench {
namespace {

/// Brute force: the least distance from points of one core to the other, on a grid that closes in on the best point.
/// An upper bound of the cores' distance; the distance of convex sets has no other minimum to be caught in.
double coreDistance(const SweptBall& a, const SweptBall& b) {
  constexpr int kCells = 3;
  std::array<double, 3> middle{}, span = a.half;
  double least = b.distanceToCore(a.center);
  for (int round = 0; round < 60; ++round) {
    std::array<double, 3> best = middle;
    const auto last = [&](int axis) { return axis < a.dimensions() ? kCells : 0; };
    for (int i = -last(0); i <= last(0); ++i)
      for (int j = -last(1); j <= last(1); ++j)
        for (int k = -last(2); k <= last(2); ++k) {
          std::array<double, 3> at{middle[0] + span[0] * i / kCells, middle[1] + span[1] * j / kCells,
                                   middle[2] + span[2] * k / kCells};
          for (std::size_t axis = 0; axis < 3; ++axis) at[axis] = std::clamp(at[axis], -a.half[axis], a.half[axis]);
          const double away = b.distanceToCore(a.onCore(at));
          if (away >= least) continue;
          least = away;
          best = at;
        }
    middle = best;
    for (double& s : span) s *= 0.7;
  }
  return least;
}

struct PairCounts {
  int meeting = 0, apart = 0, falselyMeeting = 0;
};

void judge(const SweptBall& a, const SweptBall& b, PairCounts& counts) {
  const double gap = coreDistance(a, b) - a.radius - b.radius;
  if (gap <= 0) {
    ++counts.meeting;
    EXPECT_TRUE(mayMeet(a, b, 0)) << gap;
    EXPECT_TRUE(mayMeet(b, a, 0)) << gap;
  } else if (gap > 1e-6) {
    ++counts.apart;
    counts.falselyMeeting += mayMeet(a, b, 0) ? 1 : 0;
  }
}

class Overlap : public testing::TestWithParam<std::tuple<VolumeKind, VolumeKind>> {};
INSTANTIATE_TEST_SUITE_P(EveryTwoKinds, Overlap,
                         testing::Combine(testing::ValuesIn(test::kAllKinds), testing::ValuesIn(test::kAllKinds)));

TEST_P(Overlap, MissesNoPairThatBruteForceFinds) {
  SCOPED_TRACE(testing::Message() << "seed " << test::kVolumeSeed);
  std::mt19937_64 engine(test::kVolumeSeed);
  const auto [kindA, kindB] = GetParam();
  PairCounts counts;
  for (int i = 0; i < 1000; ++i) judge(randomVolume(kindA, engine), randomVolume(kindB, engine), counts);
  EXPECT_GT(counts.meeting, 100);
  EXPECT_GT(counts.apart, 100);
  // Exact for balls and capsules; directions between two corners are found by projections, most of them.
  const bool isExact = std::max(kindA, kindB) <= VolumeKind::capsule;
  EXPECT_LE(counts.falselyMeeting, isExact ? 0 : counts.apart / 50);
}

TEST_P(Overlap, MissesNoneThatAreLongThinAndAllButParallel) {
  SCOPED_TRACE(testing::Message() << "seed " << test::kVolumeSeed);
  std::mt19937_64 engine(test::kVolumeSeed);
  const auto [kindA, kindB] = GetParam();
  PairCounts counts;
  for (int i = 0; i < 1000; ++i) {
    SweptBall a = randomVolume(kindA, engine), b = randomVolume(kindB, engine);
    const double tilt = std::pow(10, test::uniform(engine, -9, 0));
    b.axes[0] = normalized(a.axes[0] + test::randomPoint(engine) * tilt);
    b.axes[1] = normalized(a.axes[1] - b.axes[0] * dot(a.axes[1], b.axes[0]));
    b.axes[2] = cross(b.axes[0], b.axes[1]);
    b.center = a.center + test::randomPoint(engine) * 0.05;
    for (SweptBall* v : {&a, &b}) {
      v->radius = test::uniform(engine, 0.001, 0.02);
      if (v->dimensions() > 0) v->half[0] = 1;
      for (int axis = 1; axis < v->dimensions(); ++axis) v->half[axis] = test::uniform(engine, 0.001, 1);
    }
    judge(a, b, counts);
  }
  EXPECT_GT(counts.meeting, 50);
}

TEST(OverlapOfMoved, IsThatOfPointsMoved) {
  SCOPED_TRACE(testing::Message() << "seed " << test::kVolumeSeed);
  std::mt19937_64 engine(test::kVolumeSeed);
  for (const VolumeKind kind : test::kAllKinds)
    for (int i = 0; i < 100; ++i) {
      const SweptBall volume = randomVolume(kind, engine);
      const RigidMove move{test::randomRotation(engine), test::randomPoint(engine)};
      const Vec3d point = test::randomPoint(engine);
      EXPECT_NEAR((move * volume).distanceToCore(move * point), volume.distanceToCore(point), 1e-12);
    }
}

}  // namespace
}  // namespace cairn::bench

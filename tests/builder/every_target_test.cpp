// SPDX-License-Identifier: GPL-3.0-or-later
// Loops that are compiled for several instruction sets: on every one the bits of the plain definition.
#include <gtest/gtest.h>

#include <hwy/targets.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <random>
#include <span>
#include <vector>

#include "balls/point_set.h"
#include "balls/sphere_set.h"
#include "builder_meshes.h"
#include "cover/holders.h"
#include "cover/piece_costs.h"
#include "spheres/held_sets.h"

namespace cairn::builder::every_target_test {
namespace {

using test::randomPoint;
using test::uniform;

constexpr std::uint64_t kSeed = 20261121;

/// The columns of a `HeldSets`, as lists of flags.
using Flags = std::vector<std::vector<bool>>;

void expectSame(const HeldSets& sets, const Flags& flags, const std::vector<std::size_t>& names) {
  ASSERT_EQ(sets.size(), flags.size());
  const auto isSubset = [](const std::vector<bool>& a, const std::vector<bool>& b) {
    for (std::size_t p = 0; p < a.size(); ++p)
      if (a[p] && !b[p]) return false;
    return true;
  };
  std::vector<bool> any(flags.empty() ? 0 : flags[0].size(), false);
  for (std::size_t i = 0; i < flags.size(); ++i) {
    ASSERT_EQ(sets.name(i), names[i]);
    ASSERT_EQ(sets.count(i), static_cast<std::size_t>(std::count(flags[i].begin(), flags[i].end(), true)));
    const auto subsets =
        std::count_if(flags.begin(), flags.end(), [&](const auto& f) { return isSubset(f, flags[i]); });
    ASSERT_EQ(sets.subsetsOf(i), static_cast<std::size_t>(subsets));
    for (std::size_t p = 0; p < any.size(); ++p) any[p] = any[p] || flags[i][p];
  }
  ASSERT_EQ(sets.unionCount(), static_cast<std::size_t>(std::count(any.begin(), any.end(), true)));
}

void compareHeldSets(std::mt19937_64& engine) {
  const std::size_t points = 1 + engine() % 200, candidates = 1 + engine() % 40;
  const std::size_t padded = HeldSets::paddedPoints(points);
  std::vector<double> costs(candidates * padded, std::numeric_limits<double>::infinity());
  // Steps of a tenth, so that costs and stand-off are often equal.
  for (std::size_t i = 0; i < candidates; ++i)
    for (std::size_t p = 0; p < points; ++p) costs[i * padded + p] = std::floor(10 * uniform(engine)) / 10;
  const double standOff = std::floor(10 * uniform(engine)) / 10;
  HeldSets sets(costs, padded, standOff);
  Flags flags(candidates, std::vector<bool>(points));
  for (std::size_t i = 0; i < candidates; ++i)
    for (std::size_t p = 0; p < points; ++p) flags[i][p] = costs[i * padded + p] <= standOff;
  std::vector<std::size_t> names(candidates);
  std::iota(names.begin(), names.end(), std::size_t{0});
  ASSERT_NO_FATAL_FAILURE(expectSame(sets, flags, names));
  const auto leaveOut = [&](std::size_t barred) {
    for (std::size_t i = flags.size(); i-- > 0;) {
      if (names[i] != barred && std::count(flags[i].begin(), flags[i].end(), true) > 0) continue;
      flags.erase(flags.begin() + static_cast<std::ptrdiff_t>(i));
      names.erase(names.begin() + static_cast<std::ptrdiff_t>(i));
    }
  };
  const std::vector<std::size_t> barred{engine() % candidates};
  sets.drop(barred);
  leaveOut(barred[0]);
  while (!flags.empty()) {
    ASSERT_NO_FATAL_FAILURE(expectSame(sets, flags, names));
    const std::size_t i = engine() % flags.size();
    const std::vector<bool> taken = flags[i];
    sets.take(i);
    for (std::vector<bool>& f : flags)
      for (std::size_t p = 0; p < points; ++p) f[p] = f[p] && !taken[p];
    leaveOut(candidates);
  }
  ASSERT_EQ(sets.size(), 0U);
}

class OnEveryTarget : public testing::Test {
 protected:
  void TearDown() override {
    hwy::SetSupportedTargetsForTest(0);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  }
};

template <class Check>
void onEveryTarget(const Check& check) {
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    SCOPED_TRACE(hwy::TargetName(target));
    std::mt19937_64 engine(kSeed);
    for (int round = 0; round < 30; ++round) ASSERT_NO_FATAL_FAILURE(check(engine)) << "seed " << kSeed;
  }
}

TEST_F(OnEveryTarget, CountsAndSubsets_AreThoseOfFlags) {
  onEveryTarget(compareHeldSets);
}

void compareDistances(std::mt19937_64& engine) {
  std::vector<Vec3d> list(1 + engine() % 70);
  for (Vec3d& p : list) p = randomPoint(engine);
  list.push_back(list[engine() % list.size()]);  // so that some tie
  const PointSet points(list);
  const Vec3d center = randomPoint(engine);
  const double offset = uniform(engine);
  std::vector<double> measured(list.size());
  points.distances(center, offset, measured);
  std::size_t farthest = 0;
  for (std::size_t i = 0; i < list.size(); ++i) {
    ASSERT_EQ(measured[i], distance(list[i], center) - offset) << "point " << i;
    if (lengthSq(list[i] - center) > lengthSq(list[farthest] - center)) farthest = i;
  }
  ASSERT_EQ(points.farthest(center).index, farthest);
  ASSERT_EQ(points.farthest(center).distance, distance(list[farthest], center));
  const auto along = std::max_element(list.begin(), list.end(),
                                      [&](const Vec3d& a, const Vec3d& b) { return dot(a, center) < dot(b, center); });
  ASSERT_EQ(points.farthestAlong(center), static_cast<std::size_t>(along - list.begin()));
}

TEST_F(OnEveryTarget, DistancesOfPoints_AreThoseOfEachAlone) {
  onEveryTarget(compareDistances);
}

void compareHolders(std::mt19937_64& engine) {
  const std::size_t points = 1 + engine() % 70, balls = 1 + engine() % 6;
  std::vector<std::uint32_t> which;
  const bool all = engine() % 2 == 0;
  for (std::uint32_t p = 0; p < points; ++p)
    if (all || engine() % 3 != 0) which.push_back(p);
  // Steps of a fifth, so that costs are often equal. What a ball does not reach costs it infinitely much.
  const auto someCost = [&] { return std::floor(5 * uniform(engine)) / 5; };
  const double infinity = std::numeric_limits<double>::infinity();
  std::vector<std::vector<double>> costs(balls, std::vector<double>(points, infinity));
  Holders holders(points);
  std::vector<std::uint32_t> open, duties;
  for (int step = 0; step < 20; ++step) {
    const auto i = static_cast<std::uint32_t>(engine() % balls);
    std::vector<double> changed(which.size());
    for (std::size_t k = 0; k < which.size(); ++k) costs[i][which[k]] = changed[k] = someCost();
    holders.update(i, which, changed, open);
    for (const std::uint32_t k : open) {
      Holder anew;
      for (std::uint32_t b = 0; b < balls; ++b) anew.offer(b, costs[b][which[k]]);
      holders.set(which[k], anew);
    }
    for (std::size_t p = 0; p < points; ++p) {
      std::vector<double> sorted{infinity, infinity};
      for (const auto& ofBall : costs) sorted.push_back(ofBall[p]);
      std::sort(sorted.begin(), sorted.end());
      const Holder holder = holders.at(p);
      ASSERT_EQ(holder.cost, sorted[0]) << "point " << p;
      ASSERT_EQ(holder.secondCost, sorted[1]) << "point " << p;
      if (holder.cost < infinity) ASSERT_EQ(costs[holder.ball][p], holder.cost);
      if (holder.secondCost < infinity) ASSERT_EQ(costs[holder.second][p], holder.secondCost);
      if (holder.secondCost < infinity) ASSERT_NE(holder.ball, holder.second);
    }
    const double goal = someCost();
    holders.duties(i, which, changed, goal, duties);
    std::vector<std::uint32_t> expected;
    for (std::uint32_t k = 0; k < which.size(); ++k) {
      double others = infinity;
      for (std::uint32_t b = 0; b < balls; ++b)
        if (b != i) others = std::min(others, costs[b][which[k]]);
      if (others > goal && others >= changed[k]) expected.push_back(k);
    }
    ASSERT_EQ(duties, expected);
  }
}

TEST_F(OnEveryTarget, HoldersOfPoints_AreTheCheapestTwoOfAllBalls) {
  onEveryTarget(compareHolders);
}

void comparePieceCosts(std::mt19937_64& engine) {
  std::vector<Ball> balls(1 + engine() % 20);
  for (Ball& ball : balls) ball = {randomPoint(engine), 0, uniform(engine)};
  PieceCosts costs(balls);
  const Piece piece{{randomPoint(engine), randomPoint(engine), randomPoint(engine)}, 0};
  const std::span<const double> measured = costs.of(piece);
  ASSERT_EQ(measured.size(), balls.size());
  for (std::size_t i = 0; i < balls.size(); ++i) ASSERT_EQ(measured[i], costOf(balls[i], piece)) << "ball " << i;
}

TEST_F(OnEveryTarget, CostsOfAPiece_AreThoseOfEachBallAlone) {
  onEveryTarget(comparePieceCosts);
}

}  // namespace
}  // namespace cairn::builder::every_target_test

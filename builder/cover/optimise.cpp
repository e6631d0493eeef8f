// SPDX-License-Identifier: GPL-3.0-or-later
#include "optimise.h"

#include <cstdint>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "cover/level_cover.h"

namespace cairn::builder {

namespace {

/// Fraction of the worst stand-off that justifies another round. A reduction runs the optimisation once for each of its
/// swaps, so it asks for less than a level does.
constexpr double kWorthARound = 0.02;
/// A swap is kept only if it lowers the stand-off by this factor.
constexpr double kWorthASwap = 0.998;

}  // namespace

SphereSet optimise(const CoverProblem& problem, SphereSet start) {
  std::vector<std::uint32_t> all(problem.points.size());
  std::iota(all.begin(), all.end(), 0u);
  std::vector<ChildBall> family;
  for (const Ball& ball : start) family.push_back({ball, 0});
  SphereSet set;
  for (const ChildBall& child : optimiseLevel({.points = problem.points,
                                .solid = problem.solid,
                                .reach = std::span(&all, 1),
                                .branching = problem.count,
                                .worthARound = kWorthARound},
                                              std::move(family)))
    set.push_back(child.ball);
  return set;
}

SphereSet optimiseBySwaps(const CoverProblem& problem, SphereSet start, int rounds) {
  SphereSet best = optimise(problem, std::move(start));
  double standOff = coverStandOff(problem.points, best);
  bool improved = true;
  for (int round = 0; round < rounds && improved && standOff > 0; ++round) {
    improved = false;
    for (std::size_t i = 0; i < best.size() && !improved; ++i) {
      SphereSet fewer = best;
      fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(i));
      SphereSet trial = optimise(problem, std::move(fewer));
      const double reached = coverStandOff(problem.points, trial);
      if (reached >= standOff * kWorthASwap) continue;
      improved = true;
      standOff = reached;
      best = std::move(trial);
    }
  }
  return best;
}

}  // namespace cairn::builder

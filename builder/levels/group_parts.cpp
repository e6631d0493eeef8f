// SPDX-License-Identifier: GPL-3.0-or-later
#include "group_parts.h"

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "balls/ball_fit.h"
#include "cover/capacity_assignment.h"
#include "surface/random_stream.h"

namespace cairn::builder {

namespace {

/// Number of starts, the displacement of the parents at each (fraction of their radius), and the largest number of
/// rounds of assignment and fit.
constexpr std::uint64_t kStarts = 8;
constexpr double kDisplacement = 0.15;
constexpr int kGroupRounds = 8;
/// The rounds end when one gains less than this fraction.
constexpr double kWorthARound = 0.001;

CostTable costsOf(std::span<const PointSet> parts, const SphereSet& parents) {
  CostTable table{parents.size(), {}};
  for (const PointSet& part : parts)
    for (const Ball& parent : parents)
      table.costs.push_back(part.empty() ? 0 : part.farthest(parent.center).distance - parent.depth);
  return table;
}

/// Fits each parent to its parts; returns the worst stand-off.
double refit(SphereSet& parents, std::span<const PointSet> parts, const std::vector<std::uint32_t>& parentOf,
             const DepthField& field) {
  double worst = 0;
  for (std::uint32_t k = 0; k < parents.size(); ++k) {
    PointSet held;
    for (std::size_t i = 0; i < parts.size(); ++i)
      for (std::size_t p = 0; parentOf[i] == k && p < parts[i].size(); ++p) held.push(parts[i][p]);
    if (held.empty()) continue;
    parents[k] = fitBall(parents[k].center, held, field);
    worst = std::max(worst, parents[k].standOff());
  }
  return worst;
}

void displace(SphereSet& parents, RandomStream random) {
  for (Ball& parent : parents) parent.center = random.inBall(parent.center, kDisplacement * parent.radius);
}

}  // namespace

SphereSet groupParts(std::span<const PointSet> parts, const DepthField& field, SphereSet start, std::size_t branching,
                     std::uint64_t seed) {
  SphereSet best = std::move(start);
  double tightest = std::numeric_limits<double>::infinity();
  for (std::uint64_t i = 0; i < kStarts; ++i) {
    SphereSet parents = best;
    if (i > 0) displace(parents, {seed, i});
    for (Ball& parent : parents) parent.depth = field.depth(parent.center);
    double last = std::numeric_limits<double>::infinity();
    for (int round = 0; round < kGroupRounds; ++round) {
      const double reached = refit(parents, parts, assignWithin(costsOf(parts, parents), branching), field);
      if (reached < tightest) {
        tightest = reached;
        best = parents;
      }
      if (reached >= (1 - kWorthARound) * last) break;
      last = reached;
    }
  }
  return best;
}

}  // namespace cairn::builder

// SPDX-License-Identifier: GPL-3.0-or-later
#include "drop_spheres.h"

#include <cstddef>
#include <optional>
#include <utility>

#include "balls/depth_field.h"
#include "cover/optimise.h"

namespace cairn::builder {

namespace {

/// Fewest children: one would only repeat its parent.
constexpr std::size_t kMin = 2;

/// Returns the best set with one ball less: each ball is removed in turn and the rest is optimised.
SphereSet oneLess(const CoverProblem& problem, const SphereSet& balls) {
  SphereSet best;
  double least = 0;
  for (std::size_t i = 0; i < balls.size(); ++i) {
    SphereSet fewer = balls;
    fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(i));
    SphereSet trial = optimise(problem, std::move(fewer));
    const double standOff = coverStandOff(problem.points, trial);
    if (!best.empty() && standOff >= least) continue;
    least = standOff;
    best = std::move(trial);
  }
  return best;
}

/// Returns a division into one child less with errors of at most `allowed`. It is fitted against the solid first. If
/// that fails, it is fitted against the closing at about the allowed error, because a ball of that error may fill it.
std::optional<Split> withOneLess(const Split& split, const Region& region, double allowed, const SignedDistance& solid,
                                 SplitSettings settings) {
  settings.branching = split.balls.size() - 1;
  const auto tried = [&](const DepthField& field) -> std::optional<Split> {
    const CoverProblem problem{split.points, field, settings.branching};
    Split fewer = splitAmong(split, oneLess(problem, seenBy(field, split.balls)), field, solid, settings);
    if (fewer.children.size() < kMin || fewer.worst() > allowed) return std::nullopt;
    return fewer;
  };
  if (std::optional<Split> fewer = tried(SolidDepth(solid))) return fewer;
  const ClosedDepth closing(solid, kClosingScale * allowed, closingSpacing(split.balls, allowed), region.ball.center,
                            region.ball.radius + 2 * allowed);
  return closing.usable() ? tried(closing) : std::nullopt;
}

}  // namespace

Split dropSpheres(const Split& full, const Region& region, const SignedDistance& solid, const SplitSettings& settings) {
  if (!settings.balance || full.children.empty()) return full;
  const auto allowed = [&](std::size_t kept) {
    return full.worst() * allowedGrowth(*settings.balance, full.children.size(), kept);
  };
  Split best = full;
  best.allowed = full.worst() * (1 + settings.balance->excess);
  while (best.children.size() > kMin) {
    std::optional<Split> fewer = withOneLess(best, region, allowed(best.children.size() - 1), solid, settings);
    // A ball without pieces is dropped too. The allowed error need not grow with the number of dropped balls.
    if (!fewer || fewer->worst() > allowed(fewer->children.size())) break;
    fewer->allowed = allowed(fewer->children.size());
    best = *std::move(fewer);
  }
  return best;
}

}  // namespace cairn::builder

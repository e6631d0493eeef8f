// SPDX-License-Identifier: GPL-3.0-or-later
#include "drop_spheres.h"

#include <cstddef>
#include <optional>
#include <utility>

#include "balls/depth_field.h"
#include "cover/optimise.h"
#include "cover/optimise_one_by_one.h"
#include "spheres/burst.h"

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

/// One run of the thesis's Alg. 11. Its error of a set is the worst certified error of the region's division among it.
class BalanceByBurst {
 public:
  BalanceByBurst(const Split& full, const SignedDistance& solid, const SplitSettings& settings)
      : full_(full), solid_(solid), depth_(solid), settings_(settings) {}

  Split run() const {
    Split best = full_;
    best.allowed = full_.worst() * (1 + settings_.balance->excess);
    for (std::size_t count = full_.children.size() - 1; count >= kMin; --count) {
      std::optional<Split> fewer = withAtMost(count, best, allowedFor(count));
      if (!fewer) break;
      best = *std::move(fewer);
      best.allowed = allowedFor(count);
    }
    if (best.children.size() < full_.children.size()) optimiseAtLast(best);
    return best;
  }

 private:
  /// Bursts spheres of `from`, and optimises the rest only if its error is too large, as Alg. 11 has it.
  std::optional<Split> withAtMost(std::size_t count, const Split& from, double allowed) const {
    const SphereSet balls = burst({full_.points, depth_, count}, from.balls);
    Split split = splitAsTheyAre(full_, balls, solid_, settings_);
    if (!isWithin(split, allowed) && settings_.optimiser == Optimiser::thesis)
      split = splitAsTheyAre(full_, optimised(balls), solid_, settings_);
    if (!isWithin(split, allowed)) return std::nullopt;
    return split;
  }

  void optimiseAtLast(Split& best) const {
    if (settings_.optimiser != Optimiser::thesis) return;
    Split last = splitAsTheyAre(full_, optimised(best.balls), solid_, settings_);
    if (!isWithin(last, best.worst())) return;
    last.allowed = best.allowed;
    best = std::move(last);
  }

  SphereSet optimised(const SphereSet& balls) const {
    return optimiseOneByOne({full_.points, depth_, balls.size()}, balls);
  }
  /// A ball without pieces is dropped too. The allowed error need not grow with the number of dropped balls.
  bool isWithin(const Split& split, double allowed) const {
    if (split.children.size() < kMin || split.worst() > allowed) return false;
    return split.children.size() >= full_.children.size() || split.worst() <= allowedFor(split.children.size());
  }
  double allowedFor(std::size_t count) const {
    return full_.worst() * allowedGrowth(*settings_.balance, full_.children.size(), count);
  }

  const Split& full_;
  const SignedDistance& solid_;
  SolidDepth depth_;
  const SplitSettings& settings_;
};

}  // namespace

Split dropSpheres(const Split& full, const Region& region, const SignedDistance& solid, const SplitSettings& settings) {
  if (!settings.balance || full.children.empty()) return full;
  if (settings.optimiser != Optimiser::cairn) return BalanceByBurst(full, solid, settings).run();
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

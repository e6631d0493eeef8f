// SPDX-License-Identifier: GPL-3.0-or-later
#include "tool/judgement.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cairn/builder/build.h"

namespace cairn::tool {
namespace {

// From level to level the error falls by about a half; what falls less than this has another reason than its depth.
constexpr double kUsualFall = 0.5, kMinFall = 0.85;
// Deeper trees than this are no longer what a game wants in memory: 8^6 spheres.
constexpr std::uint32_t kDeepest = 6;
// Surface pieces a leaf needs to be fitted to.
constexpr double kSamplesOfALeaf = 8;

double fallOf(const std::vector<builder::LevelFit>& fits) {
  if (fits.size() < 2) return kUsualFall;
  return fits.back().certifiedMaxFraction / fits[fits.size() - 2].certifiedMaxFraction;
}

double growthOf(const BuildInfo& info, const std::vector<builder::LevelFit>& fits) {
  if (fits.size() < 2) return double(info.branching);
  return double(fits.back().spheres) / double(fits[fits.size() - 2].spheres);
}

}  // namespace

Judgement judge(const BuildInfo& info, const std::vector<builder::LevelFit>& fits) {
  Judgement judgement;
  const double error = judgement.leafErrorFraction = fits.back().certifiedMaxFraction;
  const std::string found = fmt::format("leaf error {:.1f} % of the size", 100 * error);
  if (error <= kFineLeafError) {
    judgement.words = found + ": fine for most games";
    return judgement;
  }
  const double fall = fallOf(fits);
  const bool isUsual = info.method == builder::methodName(builder::BuildOptions{}.method);
  const std::string orMethod = isUsual ? "" : fmt::format(", or no --method (this one is {})", info.method);
  if (fall > kMinFall || info.depth >= kDeepest) {
    judgement.words = fmt::format("{}: coarse, and deeper levels would hardly help; try --samples {}{}", found,
                                  std::min<std::uint64_t>(4ULL * info.samples, 1000000), orMethod);
    return judgement;
  }
  const double levels = std::ceil(std::log(kFineLeafError / error) / std::log(fall));
  const auto deeper = std::min(kDeepest - info.depth, static_cast<std::uint32_t>(std::clamp(levels, 1.0, 8.0)));
  judgement.tryDepth = info.depth + deeper;
  judgement.expectedErrorFraction = error * std::pow(fall, deeper);
  judgement.expectedSpheres = fits.back().spheres * std::pow(growthOf(info, fits), deeper);
  const double samples = kSamplesOfALeaf * judgement.expectedSpheres;
  judgement.words =
      fmt::format("{}: coarse, try --depth {}{}, for about {:.1f} % with {:.0f} leaves{}", found, *judgement.tryDepth,
                  samples > info.samples ? fmt::format(" --samples {:.0f}", std::min(samples, 1e6)) : "",
                  100 * judgement.expectedErrorFraction, judgement.expectedSpheres, orMethod);
  return judgement;
}

}  // namespace cairn::tool

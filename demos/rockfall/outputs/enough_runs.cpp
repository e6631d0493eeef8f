// SPDX-License-Identifier: GPL-3.0-or-later
#include "rockfall/outputs/enough_runs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace cairn::rockfall {
namespace {

/// Of the quantile, on either side: the width of the classes that guidelines have is coarser by far.
constexpr double kFineEnough = 0.1;
/// Of so many values one at least lies beyond their 95 % quantile, 39 times in 40: ln 0.025 / ln 0.95.
constexpr double kLeastValues = 72;

QuantileCheck check(std::string quantity, std::string unit, const Sample& sample, double scale, std::uint64_t runs) {
  QuantileCheck check{std::move(quantity), std::move(unit), sample.quantile(950) / scale, sample.confidence(950), 0};
  check.bounds.low /= scale;
  if (check.bounds.high) *check.bounds.high /= scale;
  double factor = kLeastValues / static_cast<double>(sample.size());
  if (check.bounds.high && check.quantile > 0) {
    // Widths fall with the root of the number of runs.
    const double wider = std::max(*check.bounds.high - check.quantile, check.quantile - check.bounds.low);
    const double times = wider / (kFineEnough * check.quantile);
    factor = times * times;
  }
  check.runs = static_cast<std::uint64_t>(std::ceil(factor * static_cast<double>(runs)));
  return check;
}

}  // namespace

std::vector<QuantileCheck> checkQuantiles(const Sample& runoutM, const std::vector<CollectorFigures>& collectors,
                                          std::uint64_t runs) {
  constexpr double kKilo = 1e3;
  std::vector<QuantileCheck> checks;
  if (runoutM.size() > 0) checks.push_back(check("run-out", "m", runoutM, 1, runs));
  for (const CollectorFigures& collector : collectors)
    if (collector.energyJ.size() > 0)
      checks.push_back(check("energy at " + collector.name, "kJ", collector.energyJ, kKilo, runs));
  return checks;
}

std::string enoughText(const std::vector<QuantileCheck>& checks, std::uint64_t runs) {
  std::string text;
  for (const QuantileCheck& check : checks) {
    const std::string high = check.bounds.high ? fmt::format("{:.4g}", *check.bounds.high) : "unknown";
    const std::string verdict = check.isEnough(runs) ? "the runs are enough"
                                : check.bounds.high  ? fmt::format("about {} runs would tell it to a tenth", check.runs)
                                                     : fmt::format("at least {} runs are needed to tell", check.runs);
    text += fmt::format("95 % of {} up to {:.4g} {} ({:.4g} to {} with 95 % confidence): {}\n", check.quantity,
                        check.quantile, check.unit, check.bounds.low, high, verdict);
  }
  return text;
}

}  // namespace cairn::rockfall

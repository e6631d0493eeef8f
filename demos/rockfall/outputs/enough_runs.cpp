// SPDX-License-Identifier: GPL-3.0-or-later
#include "rockfall/outputs/enough_runs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace cairn::rockfall {
namespace {

/// Of the quantile, on either side: the width of the classes that guidelines have is coarser by far.
constexpr double kFineEnough = 0.1;
/// Of so many values one at least lies beyond their 95 % quantile, 39 times in 40: ln 0.025 / ln 0.95.
constexpr double kMinValues = 72;

/// About how many runs would tell the quantile, where these runs gave `values` values of it.
std::uint64_t runsNeeded(double quantile, const Interval& bounds, std::uint64_t values, std::uint64_t runs) {
  double factor = kMinValues / static_cast<double>(values);
  if (bounds.high && quantile > 0) {
    // Widths fall with the root of the number of runs.
    const double wider = std::max(*bounds.high - quantile, quantile - bounds.low);
    const double times = wider / (kFineEnough * quantile);
    factor = times * times;
  }
  return static_cast<std::uint64_t>(std::ceil(factor * static_cast<double>(runs)));
}

QuantileCheck check(std::string quantity, std::string unit, const Sample& sample, double scale, std::uint64_t runs) {
  QuantileCheck check{std::move(quantity), std::move(unit), sample.quantile(950) / scale, sample.confidence(950)};
  check.values = sample.size();
  check.bounds.low /= scale;
  if (check.bounds.high) *check.bounds.high /= scale;
  check.runs = runsNeeded(check.quantile, check.bounds, sample.size(), runs);
  return check;
}

}  // namespace

void Runouts::add(const RockRecord& rock) {
  if (rock.ending == RockEnd::broken) return;
  metres.push_back(rock.runoutM());
  cutOff += !rock.hasWholeWay();
}

std::vector<QuantileCheck> checkQuantiles(const Runouts& runouts, const std::vector<CollectorFigures>& collectors,
                                          std::uint64_t runs) {
  constexpr double kKilo = 1e3;
  std::vector<QuantileCheck> checks;
  if (!runouts.metres.empty()) {
    checks.push_back(check("run-out", "m", Sample(runouts.metres), 1, runs));
    checks.back().cutOff = runouts.cutOff;
  }
  for (const CollectorFigures& collector : collectors)
    if (collector.energyJ.size() > 0)
      checks.push_back(check("energy at " + collector.name, "kJ", collector.energyJ, kKilo, runs));
  return checks;
}

namespace {

std::string verdictOf(const QuantileCheck& check, std::uint64_t runs) {
  if (check.isCutOff())
    return fmt::format(
        "{} of {} rocks left the map or still moved at the end, so it may be farther: give more ground "
        "or time",
        check.cutOff, check.values);
  if (check.isEnough(runs)) return "the runs are enough";
  if (check.bounds.high) return fmt::format("about {} runs would tell it to a tenth", check.runs);
  return fmt::format("at least {} runs are needed to tell", check.runs);
}

}  // namespace

std::string missingText(const std::vector<RunRange>& missing, std::uint64_t runs) {
  const std::uint64_t count = countOf(missing);
  if (count == 0) return {};
  return fmt::format("{} of {} runs are missing, and the results do without them: {}.\n", count, runs + count,
                     textOf(missing));
}

std::string enoughText(const std::vector<QuantileCheck>& checks, std::uint64_t runs) {
  std::string text;
  for (const QuantileCheck& check : checks) {
    const std::string high = check.bounds.high ? fmt::format("{:.4g}", *check.bounds.high) : "unknown";
    text += fmt::format("95 % of {} up to {:.4g} {} ({:.4g} to {} with 95 % confidence): {}\n", check.quantity,
                        check.quantile, check.unit, check.bounds.low, high, verdictOf(check, runs));
  }
  return text;
}

CellsCheck checkCells(const MergedRuns& merged) {
  CellsCheck check;
  std::map<std::uint64_t, Ranks> ranks;  // by the number of values, which many cells share
  std::vector<std::uint64_t> needed;
  for (const auto& [place, cell] : merged.cells) {
    const LogHistogram& energy = cell.of(Quantity::energy);
    if (energy.count() == 0) continue;
    const auto [found, isNew] = ranks.try_emplace(energy.count());
    if (isNew) found->second = confidenceRanks(energy.count(), 950);
    const Interval bounds = energy.bounds(found->second);
    needed.push_back(runsNeeded(energy.quantile(950), bounds, energy.count(), merged.runs));
    check.enough += bounds.high && needed.back() <= merged.runs;
  }
  check.cells = needed.size();
  if (needed.empty()) return check;
  const auto mostCells = needed.begin() + static_cast<std::ptrdiff_t>((needed.size() * 9 + 9) / 10 - 1);
  std::ranges::nth_element(needed, mostCells);
  check.runs = *mostCells;
  return check;
}

std::string enoughText(const CellsCheck& check) {
  if (check.cells == 0) return {};
  return fmt::format(
      "95 % of energy in cells: the runs are enough in {} of {} cells; for nine in ten, about {} runs are\n",
      check.enough, check.cells, check.runs);
}

}  // namespace cairn::rockfall

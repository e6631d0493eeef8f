// SPDX-License-Identifier: GPL-3.0-or-later
#include "accuracy_cost/experiments/error_against_time_claims.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "accuracy_cost/experiments/budget_claims.h"

namespace cairn::accuracy_cost {
namespace {

/// The range of errors that matter, as fractions of body size: smaller ones are invisible, larger ones unacceptable.
constexpr double kMinError = 0.001, kMaxError = 0.05;

/// A row's time divided by the tree's, with its interval.
struct Time {
  double median, low, high;
};

Time timeOf(const Table& table, std::size_t row) {
  return {table.number(row, "time_over_tree"), table.number(row, "time_over_tree_low"),
          table.number(row, "time_over_tree_high")};
}

/// The fastest setting of Cairn whose error is no larger. Errors below the least that matters count as equal to it.
std::optional<std::size_t> fastestOfOurs(const Table& table, const Where& scene, const std::string& column,
                                         double error) {
  std::optional<std::size_t> best;
  for (const std::size_t row : table.select(scene)) {
    if (table.text(row, "side") != "ours" || table.number(row, column) > std::max(error, kMinError)) continue;
    if (!best || timeOf(table, row).median < timeOf(table, *best).median) best = row;
  }
  return best;
}

std::string nameOf(const Table& table, std::size_t row) {
  return fmt::format("{} in {} of {}", table.text(row, "series"), table.text(row, "scene"), table.text(row, "model"));
}

/// The results of all other shapes against our front.
struct Fronts {
  std::size_t rivals = 0;
  std::vector<std::string> exceptions, ties;
  double leastFactor = std::numeric_limits<double>::infinity(), greatestFactor = 0;
};

void compare(const Table& table, const Where& scene, const std::string& column, Fronts& fronts) {
  for (const std::size_t row : table.select(scene)) {
    const double error = table.number(row, column);
    if (table.text(row, "side") == "ours" || !(error <= kMaxError)) continue;
    ++fronts.rivals;
    const Time rival = timeOf(table, row);
    const auto ours = fastestOfOurs(table, scene, column, error);
    if (!ours) {
      fronts.exceptions.push_back(
          fmt::format("{} ({:.3g} %: none of ours errs as little)", nameOf(table, row), 100 * error));
      continue;
    }
    const Time own = timeOf(table, *ours);
    fronts.leastFactor = std::min(fronts.leastFactor, rival.median / own.median);
    fronts.greatestFactor = std::max(fronts.greatestFactor, rival.median / own.median);
    const std::string text =
        fmt::format("{} ({:.3g} % in {:.2f} of our time)", nameOf(table, row), 100 * error, rival.median / own.median);
    if (rival.high < own.low)
      fronts.exceptions.push_back(text);
    else if (rival.low <= own.high)
      fronts.ties.push_back(text);
  }
}

/// States the uncertainty of times. It is no claim, because it depends on the machine. Statements about shapes use the
/// intervals.
std::string noiseText(const Table& table) {
  std::vector<double> widths;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const Time time = timeOf(table, row);
    if (time.median > 0) widths.push_back((time.high - time.low) / time.median);
  }
  if (widths.empty()) return {};
  std::ranges::sort(widths);
  return fmt::format(
      "; intervals of 95 % of the ratios of times are {:.1f} % of the median wide in the middle, {:.1f} "
      "% at most",
      100 * widths[widths.size() / 2], 100 * widths.back());
}

/// Notes where the 99 % quantile equals the greatest error, because fewer than a hundred pairs have one.
std::string fewPairsText(const Table& table) {
  std::size_t few = 0;
  for (std::size_t row = 0; row < table.rows(); ++row)
    if (table.number(row, "error_pairs") < 100) ++few;
  if (few == 0) return {};
  return fmt::format("; {} of {} points have fewer than 100 pairs (column error_pairs): there it is the greatest error",
                     few, table.rows());
}

void addFront(const Table& table, const std::string& column, const char* which, std::vector<Claim>& claims) {
  Fronts fronts;
  for (const std::string& model : table.texts("model"))
    for (const std::string& scene : table.texts("scene"))
      compare(table, {{"model", model}, {"scene", scene}}, column, fronts);
  if (fronts.rivals == 0) return;
  std::string found = fmt::format("by {} error of a pair {} of {} points of rivals are below and left of ours", which,
                                  fronts.exceptions.size(), fronts.rivals);
  if (!fronts.exceptions.empty()) found += fmt::format(": {}", fmt::join(fronts.exceptions, "; "));
  if (!fronts.ties.empty()) found += fmt::format("; as fast within the noise: {}", fmt::join(fronts.ties, "; "));
  if (fronts.greatestFactor > 0)
    found += fmt::format("; at no more error than a rival's ours takes 1/{:.3g} to 1/{:.3g} of its time",
                         fronts.leastFactor, fronts.greatestFactor);
  if (column == "error_p99_fraction") found += fewPairsText(table);
  found += noiseText(table);
  claims.push_back(
      {fmt::format("no rival is below and left of ours for any {} error of a pair between {} and {} % of size", which,
                   100 * kMinError, 100 * kMaxError),
       fmt::format("each pair that meets or has contacts counts once, a missed one with its whole depth, a "
                   "reported one with its worst point and its gap; for each rival that errs at most {} %, "
                   "the fastest of ours that errs no more (or at most {} %) is not slower: the interval of "
                   "its time over the tree's does not lie above the rival's",
                   100 * kMaxError, 100 * kMinError),
       found,
       fronts.exceptions.empty(),
       {},
       {.reach = Reach::every},
       static_cast<double>(fronts.exceptions.size()),
       true});
}

/// Claims that pairs without a contact are no deeper than the tree certifies.
void addMissed(const Table& table, std::vector<Claim>& claims) {
  double distinct = 0, shown = 0, missed = 0, beyond = 0, deepest = 0;
  for (const std::string& model : table.texts("model"))
    for (const std::string& scene : table.texts("scene")) {
      double meeting = 0;  // equal for all shapes that play the scene
      for (const std::size_t row : table.select({{"model", model}, {"scene", scene}, {"side", "ours"}})) {
        meeting = std::max(meeting, table.number(row, "meeting_pairs"));
        shown += table.number(row, "meeting_pairs");
        missed += table.number(row, "missed_pairs");
        beyond += table.number(row, "missed_beyond_certificate");
        deepest = std::max(deepest, table.number(row, "missed_depth_max_fraction"));
      }
      distinct += meeting;
    }
  if (shown == 0) return;
  claims.push_back(
      {"no pair of bodies that a tree misses is deeper than the worst error certified in its frame, on any budget",
       "of all pairs the exact check finds to meet none without a contact is deeper than the worst "
       "certified error of its frame",
       fmt::format("{} pairs meet in the frames checked; shown to trees of {:.3g} levels and budgets, {} "
                   "times in all, they are missed {} times, the deepest by {:.2g} % of size, {} times "
                   "deeper than certified",
                   distinct, shown / distinct, shown, missed, 100 * deepest, beyond),
       beyond == 0,
       {},
       {.reach = Reach::every},
       beyond,
       true});
}

}  // namespace

std::vector<Claim> judgeErrorAgainstTime(const Table& table) {
  std::vector<Claim> claims;
  addFront(table, "error_mean_fraction", "mean", claims);
  addFront(table, "error_p99_fraction", "99 %", claims);
  addMissed(table, claims);
  addBudgets(table, claims);
  return claims;
}

}  // namespace cairn::accuracy_cost

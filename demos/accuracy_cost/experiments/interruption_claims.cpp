// SPDX-License-Identifier: GPL-3.0-or-later
#include "accuracy_cost/experiments/interruption_claims.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "accuracy_cost/experiments/interruption_table.h"
#include "accuracy_cost/experiments/scans.h"
#include "accuracy_cost/experiments/statistics.h"

namespace cairn::accuracy_cost {
namespace {

using Names = std::vector<std::string>;

/// "As low as": within a quarter of the thesis's figure.
constexpr double kAsLow = 1.25;
/// "A slight increase": no more than this.
constexpr double kSlight = 1.5;
constexpr const char* kLast = "15000";

const Names kMedial{"merge", "expand", "combined", "combined optimised"};

/// The interruptions before completion.
bool isInterruption(const Table& table, std::size_t row) {
  return table.text(row, "interruption") != kCompletion;
}

bool isOneOf(const std::string& name, const Names& names) {
  return std::ranges::find(names, name) != names.end();
}

/// Returns the ratios of these trees in these models at interruptions, as far as they exist.
std::vector<double> ratiosOf(const Table& table, const Names& models, const Names& trees, const std::string& column) {
  std::vector<double> ratios;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    if (!isInterruption(table, row) || !isOneOf(table.text(row, "model"), models) ||
        !isOneOf(table.text(row, "construction"), trees))
      continue;
    if (const double ratio = table.number(row, column); std::isfinite(ratio)) ratios.push_back(ratio);
  }
  return ratios;
}

/// The least ratio of a model, and its place.
struct Least {
  std::string model, tree, interruption;
  double ratio = std::numeric_limits<double>::infinity();
};

/// Returns one for each model that has any.
std::vector<Least> leastOf(const Table& table, const Names& models, const Names& trees, const std::string& column,
                           const std::string& interruption = "") {
  std::vector<Least> list;
  for (const std::string& model : models) {
    Least least{model, "", ""};
    for (const std::size_t row : table.select({{"model", model}})) {
      const std::string& at = table.text(row, "interruption");
      if (!isInterruption(table, row) || (!interruption.empty() && at != interruption)) continue;
      if (!isOneOf(table.text(row, "construction"), trees)) continue;
      const double ratio = table.number(row, column);
      if (ratio < least.ratio) least = {model, table.text(row, "construction"), at, ratio};
    }
    if (std::isfinite(least.ratio)) list.push_back(least);
  }
  return list;
}

std::string textOf(const std::vector<Least>& list, double limit) {
  std::vector<std::string> texts;
  for (const Least& least : list)
    texts.push_back(
        fmt::format("{} {} ({} after {})", least.model, ratioText(least.ratio, limit), least.tree, least.interruption));
  return fmt::format("{}", fmt::join(texts, ", "));
}

/// Claims that the least ratio falls to `limit`: in every model, or in any.
struct DownTo {
  const char* thesis;
  const char* what;  ///< "worst error over Hubbard's"
  Names models, trees;
  std::string column;
  double limit;
  bool inEvery;
  const char* interruption = "";  ///< at this one; at any
  bool isOfScans = false;         ///< about the scans that the thesis names, not about all models
};

/// Returns the trees that were not measured.
Names lackingTrees(const Table& table, const Names& trees) {
  const Names measured = table.texts("construction");
  Names lacking;
  for (const std::string& tree : trees)
    if (!isOneOf(tree, measured)) lacking.push_back("trees by " + tree);
  return lacking;
}

void addDownTo(const Table& table, const DownTo& claim, std::vector<Claim>& claims) {
  const std::vector<Least> list = leastOf(table, claim.models, claim.trees, claim.column, claim.interruption);
  if (list.empty()) return;
  const double limit = claim.limit;
  const auto reaches = [&](const Least& least) { return least.ratio <= limit; };
  const auto reached = std::ranges::count_if(list, reaches);
  const auto [least, greatest] = std::ranges::minmax(list, {}, &Least::ratio);
  const Names lacking = claim.isOfScans ? scansOf(table).lacking : Names();
  claims.push_back({claim.thesis,
                    fmt::format("the least mean ratio of the {} {} is at most {:.4g} in {} model", claim.what,
                                *claim.interruption ? fmt::format("after {} operations", claim.interruption)
                                                    : std::string("at any interruption"),
                                limit, claim.inEvery ? "every" : "at least one"),
                    fmt::format("least {}: {}; at most {:.4g} in {} of {} models", claim.what, textOf(list, limit),
                                limit, reached, list.size()),
                    claim.inEvery ? reached == std::ssize(list) : reached > 0,
                    lacking,
                    {.reach = claim.inEvery ? Reach::every : Reach::some,
                     .models = claim.isOfScans ? kNamedScans : Names(),
                     .settingReach = Reach::some,  // the best of its trees counts
                     .lackingSettings = lackingTrees(table, claim.trees)},
                    claim.inEvery ? greatest.ratio : least.ratio});
}

void addDefinite(const Table& table, const Names& models, std::vector<Claim>& claims) {
  const std::vector<double> ratios = ratiosOf(table, models, kMedial, ratioColumn("hubbard", "worst"));
  if (ratios.empty()) return;
  const auto below = std::ranges::count_if(ratios, [](double r) { return r < 1; });
  claims.push_back(
      {"every medial-axis method has a definitely lower worst error than Hubbard's when interrupted",
       "the mean ratio is below 1 in at least 19 of 20 of all models, trees and interruptions",
       fmt::format("the medial-axis methods' worst error is {:.2f} to {:.2f} times Hubbard's, {:.2f} on geometric "
                   "mean, below it in {} of {}",
                   *std::ranges::min_element(ratios), *std::ranges::max_element(ratios), geometricMean(ratios), below,
                   ratios.size()),
       20 * below >= 19 * std::ssize(ratios),
       {},
       {.lackingSettings = lackingTrees(table, kMedial)},
       static_cast<double>(below)});
}

void addBest(const Table& table, const Names& models, std::vector<Claim>& claims) {
  const std::vector<double> ratios = ratiosOf(table, models, kMedial, ratioColumn("hubbard", "best"));
  if (ratios.empty()) return;
  const double average = mean(ratios);
  claims.push_back({"the best error of the medial-axis methods is slightly higher than Hubbard's",
                    fmt::format("the mean ratio over all models, trees and interruptions is from 1 to {}", kSlight),
                    fmt::format("their best error is {:.2f} times Hubbard's on the mean", average),
                    average >= 1 && average <= kSlight,
                    {},
                    {.lackingSettings = lackingTrees(table, kMedial)},
                    average});
}

/// The thesis compares hybrid's spheres of least error with the smallest ones around the same regions (7.1.5). A short
/// run has only the grid whose spheres move.
void addHybrid(const Table& table, const Names& models, std::vector<Claim>& claims) {
  const bool smallest = std::ranges::count(table.texts("construction"), "grid-volume") > 0;
  const std::string against = smallest ? "grid-volume" : "grid";
  std::ptrdiff_t lower = 0, all = 0;
  std::vector<double> ratios;
  for (const std::string& model : models)
    for (const std::size_t row : table.select({{"model", model}, {"construction", "hybrid"}})) {
      if (!isInterruption(table, row)) continue;
      const std::string column = ratioColumn("octree", "worst");
      const double hybrid = table.number(row, column);
      const double grid = table.value(
          column, {{"model", model}, {"construction", against}, {"interruption", table.text(row, "interruption")}});
      if (!(hybrid > 0 && grid > 0)) continue;
      ratios.push_back(hybrid / grid);
      ++all;
      if (hybrid < grid) ++lower;
    }
  if (ratios.empty()) return;
  claims.push_back({"hybrid improves on grid",
                    "its mean ratio of worst errors is the lower in at least three quarters of all models and "
                    "interruptions",
                    fmt::format("hybrid's worst error is {:.2f} times that of {} on geometric mean, lower in {} of {}",
                                geometricMean(ratios), against, lower, all),
                    4 * lower >= 3 * all,
                    {},
                    {},
                    static_cast<double>(lower)});
}

/// The thesis traverses either set of a hybrid tree's spheres and answers with those of least error: "MV" and "ME" in
/// figures 7.31 to 7.34.
void addTwoSpheres(const Table& table, const Names& models, std::vector<Claim>& claims) {
  std::vector<double> errors, unresolved;
  for (const std::string& model : models)
    for (const std::size_t row : table.select({{"model", model}, {"construction", kTwoSpheres}})) {
      if (!isInterruption(table, row)) continue;
      const Where ofOne{
          {"model", model}, {"construction", "hybrid"}, {"interruption", table.text(row, "interruption")}};
      const auto ratio = [&](const char* column) { return table.number(row, column) / table.value(column, ofOne); };
      if (const double r = ratio("worst_error_fraction"); std::isfinite(r) && r > 0) errors.push_back(r);
      if (const double r = ratio("unresolved_frames_share"); std::isfinite(r)) unresolved.push_back(r);
    }
  if (errors.empty()) return;
  const double average = geometricMean(errors);
  claims.push_back(
      {"whether a hybrid tree's smallest spheres or those of least error are traversed makes no significant difference",
       fmt::format("the worst error with two spheres a node, over that with one, is {:.2f} to {:.2f} on geometric mean",
                   1 / kAsLow, kAsLow),
       fmt::format("with two spheres a node the worst error is {:.2f} to {:.2f} times that with one, {:.2f} on "
                   "geometric mean, and {:.2f} times as many frames are unresolved on the mean",
                   *std::ranges::min_element(errors), *std::ranges::max_element(errors), average,
                   unresolved.empty() ? 1 : mean(unresolved)),
       average >= 1 / kAsLow && average <= kAsLow,
       {},
       {},
       average});
}

/// The pairs that meet are equal for every tree and interruption of a model. They are reported once, with the number of
/// times they were played.
std::string missedText(const Table& table, double missed, double shown) {
  double distinct = 0;
  for (const std::string& model : table.texts("model")) {
    const std::vector<double> pairs = table.numbers("meeting_bodies", {{"model", model}});
    if (!pairs.empty()) distinct += *std::ranges::max_element(pairs);
  }
  return fmt::format(
      "{} pairs of bodies meet in the frames checked; shown to every tree and interruption, {} times in "
      "all, they are missed {} times",
      distinct, shown, missed);
}

/// These are no conclusions of the thesis, but the conditions for their validity.
void addUpperBound(const Table& table, std::vector<Claim>& claims) {
  const auto sum = [&](const char* column) {
    double all = 0;
    for (const double number : table.numbers(column, {})) all += number;
    return all;
  };
  const double checked = sum("checked_contacts");
  if (checked == 0) return;
  claims.push_back(
      {"the error of a pair of spheres is an upper bound of the true separation between the objects",
       "of all contacts the exact check looked at none is farther apart, and no two bodies that meet are "
       "without a pair of spheres",
       fmt::format("of {} contacts checked {} are farther apart than certified; {}", checked, sum("beyond_certificate"),
                   missedText(table, sum("missed_bodies"), sum("meeting_bodies"))),
       sum("beyond_certificate") == 0 && sum("missed_bodies") == 0,
       {},
       {.reach = Reach::every},
       sum("beyond_certificate"),
       true});
}

}  // namespace

std::vector<Claim> judgeInterruption(const Table& table) {
  const Names models = table.texts("model");
  const Names complex = scansOf(table).measured;
  const std::vector<DownTo> reductions{
      {"grid has as little as 20 % of the octree's error when interrupted",
       "worst error of grid over the octree's",
       models,
       {"grid"},
       ratioColumn("octree", "worst"),
       0.2 * kAsLow,
       false},
      {"optimised medial-axis trees have as little as 20 % of the error of Hubbard's when interrupted",
       "worst error of medial-axis methods over Hubbard's", models, kMedial, ratioColumn("hubbard", "worst"),
       0.2 * kAsLow, false},
      {"combined comes down to 50 % of Hubbard's worst error for bunny and dragon",
       "worst error of combined over Hubbard's",
       complex,
       {"combined", "combined optimised"},
       ratioColumn("hubbard", "worst"),
       0.5 * kAsLow,
       true,
       "",
       true},
      {"as little as 20 % as many pairs of colliding spheres are found as with Hubbard's trees for bunny and dragon",
       "number of pairs of spheres over Hubbard's", complex, kMedial, ratioColumn("hubbard", "sphere_pairs"),
       0.2 * kAsLow, true, "", true},
      {"optimised trees leave less than half as many frames unresolved as Hubbard's after 15 000 operations",
       "share of unresolved frames over Hubbard's",
       models,
       {"combined optimised"},
       ratioColumn("hubbard", "unresolved"),
       0.5,
       true,
       kLast},
      {"grid and hybrid quickly drop to 10 % of the octree's worst error for all models",
       "worst error of grid and hybrid over the octree's",
       models,
       {"grid", "hybrid"},
       ratioColumn("octree", "worst"),
       0.1 * kAsLow,
       true},
      {"grid and hybrid leave about a quarter of the frames unresolved that the octree leaves after 15 000 operations, "
       "for bunny and dragon",
       "share of unresolved frames over the octree's",
       complex,
       {"grid", "hybrid"},
       ratioColumn("octree", "unresolved"),
       0.25 * kAsLow,
       true,
       kLast,
       true},
  };
  std::vector<Claim> claims;
  for (const DownTo& reduction : reductions) addDownTo(table, reduction, claims);
  addDefinite(table, models, claims);
  addBest(table, models, claims);
  addHybrid(table, models, claims);
  addTwoSpheres(table, models, claims);
  addUpperBound(table, claims);
  return claims;
}

}  // namespace cairn::accuracy_cost

// SPDX-License-Identifier: GPL-3.0-or-later
#include "accuracy_cost/experiments/reductions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "accuracy_cost/experiments/fit_columns.h"
#include "accuracy_cost/experiments/statistics.h"
#include "cairn/builder/reduce_balls.h"

namespace cairn::accuracy_cost {
namespace {

using builder::Reduction;

struct Algorithm {
  const char* name;
  Reduction reduction;
};

constexpr std::array kAlgorithms{Algorithm{"hubbard", Reduction::hubbard}, Algorithm{"merge", Reduction::merge},
                                 Algorithm{"expand", Reduction::expand}, Algorithm{"burst", Reduction::burst}};

constexpr std::array kCounts{8U, 16U, 24U, 32U, 48U, 64U, 80U, 100U, 125U, 150U, 175U, 200U};
constexpr std::array kQuickCounts{8U, 24U, 64U, 150U};

/// Number of medial spheres from which all algorithms start.
constexpr unsigned kMedialSpheres = 500;
constexpr unsigned kMaxSamples = 2000;
/// Sets with less than this fraction of the requested spheres are left out of comparisons, as the thesis leaves out
/// Expand's.
constexpr double kMinShare = 0.9;
constexpr const char* kComplete = "yes";
/// A standard deviation of the error up to this fraction of its mean counts as near zero variance.
constexpr double kEven = 0.1;

Result<Table> measure(const std::vector<Model>& models, const Settings& settings,
                      const builder::ProgressCallback& progress) {
  const std::span<const unsigned> counts =
      settings.quick ? std::span<const unsigned>(kQuickCounts) : std::span<const unsigned>(kCounts);
  Table table(withFitColumns({"model", "algorithm", "asked", "spheres", "complete"}));
  Steps steps(progress, models.size() * kAlgorithms.size() * counts.size());
  for (const Model& model : models) {
    const auto axis = builder::medialAxis(
        model.mesh, {.samples = kMaxSamples, .spheres = kMedialSpheres, .seed = settings.seed}, progress);
    if (!axis) return axis.error();
    if (axis.value().inside.empty())
      return Error{model.name + ": no medial sphere was found; is it as thin as a sheet?"};
    for (const Algorithm& algorithm : kAlgorithms)
      for (const unsigned count : counts) {
        if (!steps.next(fmt::format("{}, {} to {}", model.name, algorithm.name, count)))
          return Error{std::string(builder::kCancelled)};
        const auto inside = steps.inside();
        const auto balls =
            builder::reduceBalls(model.mesh, axis.value(), {algorithm.reduction, count}, [&] { return inside("", 0); });
        if (!balls) return balls.error();
        const auto fit = builder::evaluateBalls(balls.value(), model.mesh, settings.seed, inside);
        if (!fit) return fit.error();
        const std::size_t spheres = balls.value().size();
        const bool complete = static_cast<double>(spheres) >= kMinShare * count;
        table.addRow(withFit({model.name, algorithm.name, fmt::format("{}", count), fmt::format("{}", spheres),
                              complete ? kComplete : "no"},
                             fit.value()));
      }
  }
  return table;
}

/// The value where the set is complete, else NaN.
double valueOf(const Table& table, const std::string& model, const std::string& algorithm, const std::string& asked,
               const char* column) {
  return table.value(column, {{"model", model}, {"algorithm", algorithm}, {"asked", asked}, {"complete", kComplete}});
}

/// Returns the geometric mean, over the counts, of one algorithm's value divided by another's.
double ratioOf(const Table& table, const std::string& model, const char* over, const char* under, const char* column) {
  std::vector<double> ratios;
  for (const std::string& asked : table.texts("asked")) {
    const double ratio = valueOf(table, model, over, asked, column) / valueOf(table, model, under, asked, column);
    if (std::isfinite(ratio) && ratio > 0) ratios.push_back(ratio);
  }
  return geometricMean(ratios);
}

/// Counts the models with a ratio below 1, and gives the ratios as text.
struct Below {
  std::size_t below = 0, all = 0;
  std::string text;
};

Below belowOne(const Table& table, const char* over, const char* under, const char* column) {
  Below result;
  std::vector<std::string> texts;
  for (const std::string& model : table.texts("model")) {
    const double ratio = ratioOf(table, model, over, under, column);
    if (std::isnan(ratio)) continue;
    ++result.all;
    result.below += ratio < 1 ? 1 : 0;
    texts.push_back(fmt::format("{} {:.2f}", model, ratio));
  }
  result.text = fmt::format("{}", fmt::join(texts, ", "));
  return result;
}

constexpr const char* kWorst = "sampled_max_fraction";
constexpr const char* kRms = "sampled_rms_fraction";
constexpr const char* kVariance = "sampled_variance_fraction_squared";

Claim mergeWorst(const Table& table) {
  const Below worst = belowOne(table, "merge", "hubbard", kWorst);
  return {"merge has a lower worst error than Hubbard's for all models",
          "the geometric mean over all counts of their ratio is below 1 for every model",
          fmt::format("merge's worst error over Hubbard's: {}", worst.text),
          worst.all > 0 && worst.below == worst.all,
          {},
          {.reach = Reach::every},
          static_cast<double>(worst.below)};
}

Claim mergeSpread(const Table& table) {
  const Below rms = belowOne(table, "merge", "hubbard", kRms),
              variance = belowOne(table, "merge", "hubbard", kVariance);
  return {"merge also lowers the RMS error and the variance",
          "both ratios' geometric means are below 1 for more than half of the models",
          fmt::format("merge's RMS error over Hubbard's: {}; variance: {}", rms.text, variance.text),
          2 * rms.below > rms.all && 2 * variance.below > variance.all,
          {},
          {},
          static_cast<double>(std::min(rms.below, variance.below))};
}

Claim expandWorst(const Table& table) {
  const Below merge = belowOne(table, "expand", "merge", kWorst),
              hubbard = belowOne(table, "expand", "hubbard", kWorst);
  return {"expand generally has a lower worst error than Hubbard's and merge",
          "both ratios' geometric means are below 1 for more than half of the models",
          fmt::format("expand's worst error over merge's: {}; over Hubbard's: {}", merge.text, hubbard.text),
          2 * merge.below > merge.all && 2 * hubbard.below > hubbard.all,
          {},
          {},
          static_cast<double>(std::min(merge.below, hubbard.below))};
}

Claim expandVariance(const Table& table) {
  std::size_t lowest = 0, all = 0;
  double leastEven = INFINITY;
  for (const std::string& model : table.texts("model")) {
    std::vector<double> spreads;
    for (const std::string& asked : table.texts("asked")) {
      const double variance = valueOf(table, model, "expand", asked, kVariance);
      const double meanError = valueOf(table, model, "expand", asked, "sampled_mean_fraction");
      if (std::isfinite(variance) && meanError > 0) spreads.push_back(std::sqrt(variance) / meanError);
    }
    if (spreads.empty()) continue;
    leastEven = std::min(leastEven, mean(spreads));
    ++all;
    lowest += ratioOf(table, model, "expand", "merge", kVariance) < 1 &&
                      ratioOf(table, model, "expand", "hubbard", kVariance) < 1
                  ? 1
                  : 0;
  }
  return {"expand has the lowest variance, near zero where the solid is convex",
          fmt::format(
              "its variance is below Hubbard's and merge's for more than half of the models, and on one of them the "
              "error's standard deviation is at most {} of its mean",
              kEven),
          fmt::format("expand has the lowest variance of the three on {} of {} models; the most even has a standard "
                      "deviation of {:.3f} of the mean error",
                      lowest, all, leastEven),
          all > 0 && 2 * lowest > all && leastEven <= kEven,
          {},
          {},
          leastEven};
}

Claim burstBest(const Table& table) {
  const Below merge = belowOne(table, "burst", "merge", kRms), expand = belowOne(table, "burst", "expand", kRms);
  return {"burst further improves the fit",
          "its RMS error is below merge's and expand's by the geometric mean for more than half of the models",
          fmt::format("burst's RMS error over merge's: {}; over expand's: {}", merge.text, expand.text),
          2 * merge.below > merge.all && 2 * expand.below > expand.all,
          {},
          {},
          static_cast<double>(std::min(merge.below, expand.below))};
}

std::vector<Claim> judge(const Table& table) {
  return {mergeWorst(table), mergeSpread(table), expandWorst(table), expandVariance(table), burstBest(table)};
}

Panel panelOf(const std::string& model, const char* title, const char* column, Axis yAxis) {
  Panel panel{fmt::format("{}: {}", model, title), "spheres", {"spheres", true, 1}, std::move(yAxis), {}};
  for (unsigned i = 0; i < kAlgorithms.size(); ++i)
    panel.series.push_back({kAlgorithms[i].name,
                            {{"model", model}, {"algorithm", kAlgorithms[i].name}, {"complete", kComplete}},
                            column,
                            {i, i, i}});
  return panel;
}

std::vector<Figure> draw(const Table& table) {
  Figure figure{"reductions", "Reductions of 500 medial spheres", 4, {}};
  for (const std::string& model : table.texts("model")) {
    figure.panels.push_back(panelOf(model, "worst error", kWorst, {"% of the diagonal", true, 100}));
    figure.panels.push_back(panelOf(model, "RMS error", kRms, {"% of the diagonal", true, 100}));
    figure.panels.push_back(panelOf(model, "variance", kVariance, {"(% of the diagonal)²", true, 1e4}));
    figure.panels.push_back(panelOf(model, "wasted volume", "wasted_volume_fraction", {"% of the volume", true, 100}));
  }
  return {figure};
}

}  // namespace

Experiment reductionsExperiment() {
  return {
      "reductions",
      "reducing a set of medial spheres: Hubbard's merging, merge, expand, burst",
      "7.1.4, figures 7.15 to 7.18",
      "Merge lowers the worst error against Hubbard's merging for all models, and RMS and variance with it; expand has "
      "very low variance, zero for convex shapes, and generally a lower worst error than both; burst improves the fit "
      "further. Expand cannot produce larger sets.",
      "All start from the same 500 adaptive medial spheres of the whole solid, Hubbard's from the inner ones alone. "
      "After a reduction spheres grow where something of the surface is left out, so every set covers all of it; the "
      "thesis's sets cover sample points. Sets of fewer than nine tenths of the spheres asked for stay in the table "
      "and "
      "are left out of comparisons and figures.",
      {"bunny", "cow", "dragon", "cone", "armadillo", "elephant"},
      {"bunny", "cone"},
      measure,
      judge,
      draw};
}

}  // namespace cairn::accuracy_cost

// SPDX-License-Identifier: GPL-3.0-or-later
#include "accuracy_cost/experiments/sampling.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

#include "accuracy_cost/experiments/fit_columns.h"
#include "accuracy_cost/experiments/statistics.h"
#include "cairn/builder/medial_axis.h"

namespace cairn::accuracy_cost {
namespace {

using builder::MedialAxisOptions;
using builder::MedialSampling;

/// Samples requested from the regular sampling, which adds those of edges and repair. The adaptive sampling gets the
/// resulting total.
constexpr std::array kSamples{50U, 150U, 300U, 500U, 750U, 1000U, 1500U, 2000U};
constexpr std::array kQuickSamples{50U, 150U, 300U};

/// The surface points of adaptive sampling, about half this number: far denser than the samples.
constexpr unsigned kSurfacePieces = 40'000;

/// A cover that misses at most this share of the area counts as complete. It is tested at points, and area between them
/// is lost.
constexpr double kWhole = 2e-3;
/// "Much the same" volume.
constexpr double kMuchTheSame = 1.1;
/// From this Pearson's r squared on, a relation counts as "pretty much linear".
constexpr double kLinear = 0.95;
/// The range of powers of the samples at which the growth of the spheres counts as linear.
constexpr double kMinPower = 0.8, kMaxPower = 1.25;
/// Volume that still counts as "nearly zero".
constexpr double kNearlyNothing = 0.01;

constexpr const char* kRegular = "regular";
constexpr const char* kAdaptive = "adaptive";

/// Adds the row of one axis. Returns its number of samples.
Result<std::size_t> addAxis(Table& table, const Model& model, const MedialAxisOptions& options,
                            const builder::ProgressCallback& progress) {
  const auto axis = builder::medialAxis(model.mesh, options, progress);
  if (!axis) return axis.error();
  const auto balls = axis.value().balls();
  if (balls.empty()) return Error{fmt::format("{}: {} samples leave no sphere", model.name, options.samples)};
  const auto fit = builder::evaluateBalls(balls, model.mesh, options.seed, progress);
  if (!fit) return fit.error();
  const std::size_t samples = axis.value().samples.size();
  table.addRow(withFit(
      {model.name, options.sampling == MedialSampling::regular ? kRegular : kAdaptive, fmt::format("{}", samples),
       fmt::format("{}", balls.size()), fmt::format("{}", axis.value().coverage.size())},
      fit.value()));
  return samples;
}

Result<Table> measure(const std::vector<Model>& models, const Settings& settings,
                      const builder::ProgressCallback& progress) {
  const std::span<const unsigned> counts =
      settings.quick ? std::span<const unsigned>(kQuickSamples) : std::span<const unsigned>(kSamples);
  Table table(withFitColumns({"model", "sampling", "samples", "spheres", "coverage_spheres"}));
  Steps steps(progress, 2 * models.size() * counts.size());
  for (const Model& model : models)
    for (const unsigned count : counts) {
      if (!steps.next(model.name)) return Error{std::string(builder::kCancelled)};
      MedialAxisOptions options{.sampling = MedialSampling::regular,
                                .samples = count,
                                .surfacePieces = kSurfacePieces,
                                .seed = settings.seed};
      const auto samples = addAxis(table, model, options, steps.inside());
      if (!samples) return samples.error();
      if (!steps.next(model.name)) return Error{std::string(builder::kCancelled)};
      options.sampling = MedialSampling::adaptive;
      options.samples = static_cast<unsigned>(samples.value());
      if (const auto same = addAxis(table, model, options, steps.inside()); !same) return same.error();
    }
  return table;
}

Where of(const std::string& model, const char* sampling) {
  return {{"model", model}, {"sampling", sampling}};
}

/// The adaptive value divided by the regular one at equal samples.
std::vector<double> ratiosOf(const Table& table, const std::string& model, const char* column) {
  std::vector<double> ratios;
  const auto regular = table.numbers(column, of(model, kRegular)),
             adaptive = table.numbers(column, of(model, kAdaptive));
  for (std::size_t i = 0; i < std::min(regular.size(), adaptive.size()); ++i)
    if (regular[i] > 0 && adaptive[i] > 0) ratios.push_back(adaptive[i] / regular[i]);
  return ratios;
}

double largest(const std::vector<double>& values) {
  return values.empty() ? 0 : *std::ranges::max_element(values);
}

/// The note on the largest number of samples, where `--quick` or a mesh's own corners end before it.
Scope scopeAtMostSamples(const Table& table) {
  Scope scope{.reach = Reach::every};
  const std::vector<double> samples = table.numbers("samples", {});
  const double most = samples.empty() ? 0 : *std::ranges::max_element(samples);
  if (most < kSamples.back()) scope.lackingSettings = {fmt::format("more than {} samples", most)};
  return scope;
}

Claim coverClaim(const Table& table) {
  constexpr const char* kColumn = "uncovered_area_fraction";
  std::size_t less = 0, all = 0;
  double atMost = 0;
  for (const std::string& model : table.texts("model")) {
    const auto regular = table.numbers(kColumn, of(model, kRegular)),
               adaptive = table.numbers(kColumn, of(model, kAdaptive));
    for (std::size_t i = 0; i < std::min(regular.size(), adaptive.size()); ++i, ++all)
      less += adaptive[i] < regular[i] ? 1 : 0;
    if (!adaptive.empty()) atMost = std::max(atMost, adaptive.back());
  }
  Scope scope = scopeAtMostSamples(table);
  if (less < all) scope.settingReach = Reach::every;  // any number of samples can refute it
  return {
      "the adaptive algorithm covers the whole surface, where regular sampling leaves some of it out",
      fmt::format("adaptive sampling leaves out less area at all numbers of samples of all models, and at most {} % at "
                  "the most samples",
                  100 * kWhole),
      fmt::format(
          "adaptive sampling leaves less of the surface outside its spheres in {} of {} cases, at most {:.2f} % "
          "at the most samples; regular sampling up to {:.2f} %",
          less, all, 100 * atMost, 100 * largest(table.numbers(kColumn, {{"sampling", kRegular}}))),
      all > 0 && less == all && atMost <= kWhole,
      {},
      std::move(scope),
      atMost};
}

Claim volumeClaim(const Table& table) {
  double volume = 0, area = 1;
  for (const std::string& model : table.texts("model")) {
    const auto volumes = table.numbers("uncovered_volume_fraction", of(model, kRegular));
    const auto areas = table.numbers("uncovered_area_fraction", of(model, kRegular));
    if (volumes.empty() || areas.empty()) continue;
    volume = std::max(volume, volumes.back());
    area = std::min(area, areas.back());
  }
  return {
      "with more samples the volume regular sampling leaves out is nearly zero, while much of the surface stays out",
      fmt::format(
          "at the most samples it leaves out at most {} % of every model's volume, and more than {} % of its area",
          100 * kNearlyNothing, 100 * kNearlyNothing),
      fmt::format("at the most samples regular sampling leaves out up to {:.2f} % of a model's volume and at least "
                  "{:.2f} % of its surface",
                  100 * volume, 100 * area),
      volume <= kNearlyNothing && area > kNearlyNothing,
      {},
      scopeAtMostSamples(table),
      area};
}

Claim linearClaim(const Table& table) {
  double least = 1, leastPower = INFINITY, greatestPower = 0;
  for (const std::string& model : table.texts("model"))
    for (const char* sampling : {kRegular, kAdaptive}) {
      const auto x = table.numbers("samples", of(model, sampling)), y = table.numbers("spheres", of(model, sampling));
      if (const double r = linearity(x, y); !std::isnan(r)) least = std::min(least, r);
      const double power = powerOf(x, y);
      if (std::isnan(power)) continue;
      leastPower = std::min(leastPower, power);
      greatestPower = std::max(greatestPower, power);
    }
  return {"the number of spheres grows linearly with the samples for both",
          fmt::format("for each model and sampling it grows as a power from {} to {} of the samples (straight line "
                      "through the logarithms), and a straight line explains at least {} of its variance",
                      kMinPower, kMaxPower, kLinear),
          fmt::format("the number of spheres grows as the power {} to {} of the samples; a straight line explains at "
                      "least {} of its variance",
                      ratioText(leastPower, kMinPower), ratioText(greatestPower, kMaxPower), ratioText(least, kLinear)),
          least >= kLinear && leastPower >= kMinPower && greatestPower <= kMaxPower,
          {},
          {.reach = Reach::every},
          leastPower};
}

/// Counts the models and numbers of samples for which the adaptive value is below `most` times the regular one.
struct Lower {
  std::size_t count = 0, all = 0;
  std::vector<std::string> found;
};

Lower lowerIn(const Table& table, const char* column, double most) {
  Lower lower;
  for (const std::string& model : table.texts("model")) {
    const std::vector<double> ratios = ratiosOf(table, model, column);
    if (ratios.empty()) continue;
    lower.all += ratios.size();
    lower.count += static_cast<std::size_t>(std::ranges::count_if(ratios, [&](double r) { return r < most; }));
    lower.found.push_back(fmt::format("{} {:.2f} to {:.2f}", model, ratios.front(), ratios.back()));
  }
  return lower;
}

/// Claims that adaptive over regular is below `most` in more than half of the rows of a column.
Claim lowerClaim(const Table& table, const char* column, const char* what, double most, const char* thesis) {
  const auto& [lower, all, found] = lowerIn(table, column, most);
  return {thesis,
          fmt::format("adaptive over regular {} is below {} in more than half of all models and numbers of samples",
                      what, most),
          fmt::format("adaptive over regular {}, from the fewest samples to the most: {}; below {} in {} of {}", what,
                      fmt::join(found, ", "), most, lower, all),
          2 * lower > all,
          {},
          {},
          static_cast<double>(lower)};
}

/// The worst sphere alone does not describe a fit, so the other measures are reported too.
Claim worstErrorClaim(const Table& table) {
  Claim claim = lowerClaim(table, "sampled_max_fraction", "worst error", 1,
                           "the adaptive algorithm generally has the lower worst error at equal samples");
  const Lower rms = lowerIn(table, "sampled_rms_fraction", 1);
  claim.found += fmt::format("; of the RMS error, told and not judged: {}; below 1 in {} of {}",
                             fmt::join(rms.found, ", "), rms.count, rms.all);
  return claim;
}

std::vector<Claim> judge(const Table& table) {
  return {coverClaim(table),
          volumeClaim(table),
          linearClaim(table),
          worstErrorClaim(table),
          lowerClaim(table, "sampled_variance_fraction_squared", "variance of the error", 1,
                     "the adaptive algorithm often has the lower variance"),
          lowerClaim(table, "wasted_volume_fraction", "wasted volume", kMuchTheSame,
                     "the adaptive algorithm wastes no more volume, much less on simple models")};
}

Panel panelOf(const Table& table, const std::vector<std::string>& models, const char* title, const char* column,
              Axis yAxis) {
  Panel panel{title, "samples", {"surface samples"}, std::move(yAxis), {}};
  for (const std::string& model : models) {
    const auto names = table.texts("model");
    const auto place = static_cast<unsigned>(std::ranges::find(names, model) - names.begin());
    panel.series.push_back({model + ", adaptive", of(model, kAdaptive), column, {place, 2 * (place % 2), 0}});
    panel.series.push_back({model + ", regular", of(model, kRegular), column, {place, 5 + place % 2, 1}});
  }
  return panel;
}

Figure figureOf(const Table& table, std::string name, std::string title, const std::vector<std::string>& models) {
  return {std::move(name),
          std::move(title),
          3,
          {panelOf(table, models, "(a) surface outside all spheres", "uncovered_area_fraction",
                   {"% of the area", false, 100}),
           panelOf(table, models, "(b) spheres", "spheres", {"spheres"}),
           panelOf(table, models, "(c) worst error", "sampled_max_fraction", {"% of the diagonal", true, 100}),
           panelOf(table, models, "(d) mean error", "sampled_mean_fraction", {"% of the diagonal", true, 100}),
           panelOf(table, models, "(e) variance of the error", "sampled_variance_fraction_squared",
                   {"(% of the diagonal)²", true, 1e4}),
           panelOf(table, models, "(f) wasted volume", "wasted_volume_fraction", {"% of the volume", true, 100})}};
}

std::vector<Figure> draw(const Table& table) {
  const std::vector<std::string> models = table.texts("model");
  std::vector<Figure> figures{figureOf(table, "sampling", "Regular and adaptive sampling of the medial axis", models)};
  if (models.size() > 2)
    for (const std::string& model : models)
      figures.push_back(figureOf(table, "sampling-" + model, "Regular and adaptive sampling: " + model, {model}));
  return figures;
}

}  // namespace

Experiment samplingExperiment() {
  return {
      "sampling",
      "adaptive against regular sampling of the medial axis",
      "7.1.2, figures 7.5 to 7.8",
      "Regular sampling leaves much of complex models' surface uncovered even where the uncovered volume is nearly "
      "zero; the adaptive algorithm covers it all. Spheres grow linearly with samples for both. The adaptive "
      "algorithm generally has the lower worst error, often the lower variance, and on simple models much less wasted "
      "volume.",
      "Adaptive sampling gets as many samples as regular sampling came to, and may end at 95 % of them; regular "
      "sampling "
      "has one at each corner of the mesh, so curves begin there. The adaptive diagram starts from 60 evenly spread "
      "points; coverage is improved with the rest, by the vertices most easily removed, and kept in the end by those "
      "that "
      "stand off least. Errors are the thesis's, sampled on each "
      "sphere, beside a certified bound in the table; all are fractions of the bounding box's diagonal.",
      {"bunny", "cow", "dragon", "cube", "armadillo", "elephant"},
      {"bunny", "cube"},
      measure,
      judge,
      draw};
}

}  // namespace cairn::accuracy_cost

// SPDX-License-Identifier: GPL-3.0-or-later
#include "accuracy_cost/experiments/balance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "accuracy_cost/experiments/fit_columns.h"
#include "accuracy_cost/experiments/tree_fit.h"

namespace cairn::accuracy_cost {
namespace {

using builder::Balance;
using builder::Method;
using builder::Optimiser;

/// The loss that a tree may take for fewer spheres.
struct Allowance {
  const char* name;
  Optimiser optimiser;
  std::optional<Balance> balance;
  bool quick;
};

/// The thesis's allowances are 100 % and 105 % of the worst error (7.1.5), and the growth that saved work must earn
/// (6.3).
const std::array kAllowances{
    Allowance{"as made", Optimiser::none, std::nullopt, true},
    Allowance{"optimised", Optimiser::thesis, std::nullopt, true},
    Allowance{"100 %", Optimiser::thesis, builder::constantExcess(0), true},
    Allowance{"102 %", Optimiser::thesis, builder::constantExcess(0.02), false},
    Allowance{"105 %", Optimiser::thesis, builder::constantExcess(0.05), true},
    Allowance{"110 %", Optimiser::thesis, builder::constantExcess(0.1), false},
    Allowance{"120 %", Optimiser::thesis, builder::constantExcess(0.2), false},
    Allowance{"by work", Optimiser::thesis, builder::kBalanceByWork, false},
};

constexpr std::array kMethods{Method::merge, Method::expand, Method::combined};
constexpr unsigned kDepth = 3;

/// "As much as two fifths", with room for other models.
constexpr double kManyDropped = 1.0 / 3;
/// "Pretty much the same error."
constexpr double kAboutTheSame = 1.1;

Result<Table> measure(const std::vector<Model>& models, const Settings& settings,
                      const builder::ProgressCallback& progress) {
  Table table(withFitColumns({"model", "method", "allowance", "level", "spheres"}));
  const auto wanted = [&](const Allowance& a) { return a.quick || !settings.quick; };
  const std::size_t methods = settings.quick ? 1 : kMethods.size();
  Steps steps(progress, models.size() * methods * static_cast<std::size_t>(std::ranges::count_if(kAllowances, wanted)));
  for (const Model& model : models)
    for (std::size_t m = 0; m < methods; ++m)
      for (const Allowance& allowance : kAllowances) {
        if (!wanted(allowance)) continue;
        const char* method = builder::methodName(kMethods[m]);
        if (!steps.next(fmt::format("{}, {}, {}", model.name, method, allowance.name)))
          return Error{std::string(builder::kCancelled)};
        const auto fits = treeFit(model.mesh,
                                  {.method = kMethods[m],
                                   .depth = kDepth,
                                   .seed = settings.seed,
                                   .optimiser = allowance.optimiser,
                                   .balance = allowance.balance},
                                  steps.inside());
        if (!fits) return about(fmt::format("{}, {}, {}", model.name, method, allowance.name), fits.error());
        for (const builder::LevelFit& fit : fits.value())
          table.addRow(withFit(
              {model.name, method, allowance.name, fmt::format("{}", fit.level), fmt::format("{}", fit.spheres)}, fit));
      }
  return table;
}

/// The effect of an allowance on the deepest level, compared with the tree as its method makes it.
struct Change {
  std::string tree;
  double dropped = 0;  ///< share of the spheres
  double worst = 1;    ///< error divided by the error without drops
  double rms = 1;
};

std::vector<Change> changesOf(const Table& table, const char* allowance) {
  std::vector<Change> changes;
  for (const std::string& model : table.texts("model"))
    for (const std::string& method : table.texts("method")) {
      const auto at = [&](const char* which, const char* column) {
        return table.value(
            column, {{"model", model}, {"method", method}, {"allowance", which}, {"level", fmt::format("{}", kDepth)}});
      };
      const Change change{model + " " + method, 1 - at(allowance, "spheres") / at("as made", "spheres"),
                          at(allowance, "sampled_max_fraction") / at("as made", "sampled_max_fraction"),
                          at(allowance, "sampled_rms_fraction") / at("as made", "sampled_rms_fraction")};
      if (std::isfinite(change.dropped) && std::isfinite(change.worst)) changes.push_back(change);
    }
  return changes;
}

/// The scope of the claims: all methods; some were not measured.
Scope scopeOf(const Table& table, Reach reach) {
  Scope scope{.reach = reach, .settingReach = reach};
  const std::vector<std::string> measured = table.texts("method");
  for (const Method method : kMethods)
    if (std::ranges::find(measured, builder::methodName(method)) == measured.end())
      scope.lackingSettings.push_back(fmt::format("method {}", builder::methodName(method)));
  return scope;
}

std::string textOf(const std::vector<Change>& changes) {
  std::vector<std::string> texts;
  for (const Change& c : changes)
    texts.push_back(fmt::format("{} {:.0f} % for {:.2f} (RMS {:.2f})", c.tree, 100 * c.dropped, c.worst, c.rms));
  return fmt::format("{}", fmt::join(texts, ", "));
}

Claim droppedClaim(const std::vector<Change>& changes, Scope scope) {
  double most = 0;
  for (const Change& c : changes)
    if (c.worst <= kAboutTheSame) most = std::max(most, c.dropped);
  const bool holds = std::ranges::any_of(
      changes, [](const Change& c) { return c.dropped >= kManyDropped && c.worst <= kAboutTheSame; });
  return {
      "as many as two fifths of the spheres are thrown away at 105 %, the error being pretty much the same",
      fmt::format("for one model and method at least {:.2f} of level {} are dropped, its worst error being at most {} "
                  "times that of the tree as made",
                  kManyDropped, kDepth, kAboutTheSame),
      fmt::format("at 105 % of level {} are dropped, for so many times the worst error (and the RMS error, told and "
                  "not judged): {}",
                  kDepth, textOf(changes)),
      holds,
      {},
      std::move(scope),
      most};
}

Claim sameErrorClaim(const std::vector<Change>& changes, Scope scope) {
  const auto same = std::ranges::count_if(changes, [](const Change& c) { return c.worst <= kAboutTheSame; });
  return {
      "at 105 % the approximations contain pretty much the same error as unoptimised ones",
      fmt::format("the worst error of level {} is at most {} times that of the tree as made, in more than half of all "
                  "models and methods",
                  kDepth, kAboutTheSame),
      fmt::format("the worst error is at most {} times as large in {} of {} trees", kAboutTheSame, same,
                  changes.size()),
      2 * same > std::ssize(changes),
      {},
      std::move(scope),
      static_cast<double>(same)};
}

Claim freeClaim(const std::vector<Change>& changes, Scope scope) {
  const auto fewer = std::ranges::count_if(changes, [](const Change& c) { return c.dropped > 0; });
  return {"spheres are dropped even where the worst error may not grow (100 %)",
          fmt::format("level {} has fewer spheres in more than half of all models and methods", kDepth),
          fmt::format("at 100 %, of level {} are dropped, for so many times the worst error (and the RMS error, told "
                      "and not judged): {}",
                      kDepth, textOf(changes)),
          2 * fewer > std::ssize(changes),
          {},
          std::move(scope),
          static_cast<double>(fewer)};
}

std::vector<Claim> judge(const Table& table) {
  const std::vector<Change> atMost = changesOf(table, "105 %"), none = changesOf(table, "100 %");
  std::vector<Claim> claims;
  if (!atMost.empty())
    claims = {droppedClaim(atMost, scopeOf(table, Reach::some)), sameErrorClaim(atMost, scopeOf(table, Reach::share))};
  if (!none.empty()) claims.push_back(freeClaim(none, scopeOf(table, Reach::share)));
  return claims;
}

Panel panelOf(const Table& table, const std::string& method, const char* title, const char* column, Axis yAxis) {
  Panel panel{fmt::format("{}, level {}: {}", method, kDepth, title),
              "allowance",
              {""},
              std::move(yAxis),
              {},
              table.texts("allowance")};
  unsigned place = 0;
  for (const std::string& model : table.texts("model")) {
    panel.series.push_back({model,
                            {{"model", model}, {"method", method}, {"level", fmt::format("{}", kDepth)}},
                            column,
                            {place, place, place}});
    ++place;
  }
  return panel;
}

std::vector<Figure> draw(const Table& table) {
  Figure figure{"balance", "Spheres dropped against the error that costs", 3, {}};
  for (const std::string& method : table.texts("method")) {
    figure.panels.push_back(panelOf(table, method, "spheres", "spheres", {"spheres"}));
    figure.panels.push_back(
        panelOf(table, method, "worst error", "sampled_max_fraction", {"% of the diagonal", true, 100}));
    figure.panels.push_back(
        panelOf(table, method, "RMS error", "sampled_rms_fraction", {"% of the diagonal", true, 100}));
  }
  return {figure};
}

}  // namespace

Experiment balanceExperiment() {
  return {
      "balance",
      "spheres dropped by the optimiser against the error that costs",
      "6.3 and 7.1.5, figures 7.20 and 7.24",
      "When the optimiser may throw spheres away without the worst error growing by more than 5 %, the approximations "
      "contain pretty much the same error as unoptimised ones with as many as two fifths fewer spheres.",
      "The optimiser is the thesis's (6.2), the allowance that of Eq. 6.2, for each node's children. Every tree still "
      "covers the whole surface, by proof. Spheres are counted against the tree as its method leaves it.",
      {"bunny", "dragon", "s-shape", "ellipsoid"},
      {"bunny", "s-shape"},
      measure,
      judge,
      draw};
}

}  // namespace cairn::accuracy_cost

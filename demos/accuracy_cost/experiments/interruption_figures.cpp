// SPDX-License-Identifier: GPL-3.0-or-later
#include "accuracy_cost/experiments/interruption_figures.h"

#include <algorithm>
#include <string>

#include "accuracy_cost/experiments/interruption_table.h"

namespace cairn::accuracy_cost {
namespace {

const char* const kOperations = "operations before the interruption, thousands";

Panel panelOf(const Table& table, const std::string& model, const std::vector<std::string>& trees, std::string title,
              const std::string& column, Axis yAxis) {
  Panel panel{std::move(title), "operations", {kOperations, false, 1e-3}, std::move(yAxis), {}};
  const auto names = table.texts("construction");
  for (const std::string& tree : trees) {
    const auto place = static_cast<unsigned>(std::ranges::find(names, tree) - names.begin());
    panel.series.push_back(
        {tree, {{"model", model}, {"construction", tree}}, column, {place, place, place < 7 ? 0U : 1U}});
  }
  return panel;
}

/// Absolute errors of all trees: certified, true, and the plugin's with the same budget.
Figure overview(const Table& table) {
  Figure figure{"interruption", "Collision detection of 20 bodies, interrupted: errors and pairs", 3, {}};
  const auto trees = table.texts("construction");
  for (const std::string& model : table.texts("model")) {
    const auto add = [&](const char* title, const char* column, Axis yAxis) {
      figure.panels.push_back(
          panelOf(table, model, trees, fmt::format("{}: {}", model, title), column, std::move(yAxis)));
    };
    const Axis percent{"% of the diagonal", true, 100};
    add("worst certified error", "worst_error_fraction", percent);
    add("RMS certified error", "rms_error_fraction", percent);
    add("true distance at contacts, mean", "true_separation_mean_fraction", percent);
    add("pairs of spheres in a frame", "sphere_pairs", {"pairs", true});
    add("frames left unresolved", "unresolved_frames_share", {"% of the frames", false, 100});
    add("plugin: mean certified error", "plugin_mean_error_fraction", percent);
  }
  return figure;
}

/// The thesis's five diagrams.
Figure ratios(const Table& table, const std::string& model, const std::string& reference,
              const std::vector<std::string>& trees) {
  Figure figure{fmt::format("interruption-{}-{}", reference, model),
                fmt::format("{} interrupted: trees against that of {}", model, reference),
                3,
                {}};
  const auto add = [&](const char* title, const char* what, bool log) {
    figure.panels.push_back(panelOf(table, model, trees, title, ratioColumn(reference, what),
                                    {fmt::format("% of {}", reference), log, 100}));
  };
  add("(a) worst error", "worst", true);
  add("(b) RMS error", "rms", true);
  add("(c) best error", "best", true);
  add("(d) pairs of colliding spheres", "sphere_pairs", true);
  add("(e) unresolved frames", "unresolved", false);
  figure.panels.push_back(panelOf(table, model, trees, "true distance at contacts, mean",
                                  "true_separation_mean_fraction", {"% of the diagonal", true, 100}));
  return figure;
}

}  // namespace

std::vector<Figure> drawInterruption(const Table& table) {
  const auto names = table.texts("construction");
  const auto present = [&](std::vector<std::string> trees) {
    std::erase_if(trees, [&](const std::string& tree) { return std::ranges::find(names, tree) == names.end(); });
    return trees;
  };
  const auto medial = present({"merge", "expand", "combined", "combined optimised", "cairn adaptive"});
  const auto divided = present({"hubbard", "grid", "grid-volume", "hybrid", kTwoSpheres, "cairn adaptive"});
  std::vector<Figure> figures{overview(table)};
  for (const std::string& model : table.texts("model")) {
    if (!medial.empty()) figures.push_back(ratios(table, model, "hubbard", medial));
    if (!divided.empty()) figures.push_back(ratios(table, model, "octree", divided));
  }
  return figures;
}

}  // namespace cairn::accuracy_cost

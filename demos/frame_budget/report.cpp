// SPDX-License-Identifier: GPL-3.0-or-later
#include "report.h"

#include <fmt/core.h>

#include <functional>
#include <numbers>
#include <string>

#include "scenes/heap_report_json.h"

namespace cairn::frame_budget {
namespace {

using scenes::HeapReport;
using scenes::Quantiles;
using scenes::SourcedTree;

std::string milliseconds(double us) {
  return fmt::format("{:.3f}", us / 1000);
}
std::string percent(double fraction) {
  return fmt::format("{:.2f}", 100 * fraction);
}
std::string meanAndMax(double mean, double max) {
  return fmt::format("{} / {}", percent(mean), percent(max));
}
std::string spread(const scenes::Spread& s) {
  return s.pairs ? fmt::format("{} ({})", meanAndMax(s.mean, s.max), s.pairs) : "none";
}
std::string medianAndMax(const Quantiles& q) {
  return fmt::format("{:.0f} / {:.0f}", q.median, q.max);
}

double arcMinutes(double radians) {
  return radians * 60 * 180 / std::numbers::pi;
}

class Table {
 public:
  explicit Table(const std::vector<ShapeRun>& runs) : runs_(runs) {
    fmt::print("{:42}", "");
    for (const ShapeRun& run : runs_) fmt::print("{:>24}", scenes::shapeName(run.shape));
    fmt::print("\n");
  }

  void row(const char* title, const std::function<std::string(const HeapReport&)>& cell) const {
    fmt::print("{:42}", title);
    for (const ShapeRun& run : runs_) fmt::print("{:>24}", cell(run.report));
    fmt::print("\n");
  }

  /// A row only the sphere-tree can fill.
  void treeRow(const char* title, const std::function<std::string(const scenes::TreeRunStatistics&)>& cell) const {
    row(title, [&](const HeapReport& r) { return r.tree ? cell(*r.tree) : std::string("-"); });
  }

 private:
  const std::vector<ShapeRun>& runs_;
};

void printTimes(const Table& table, const std::vector<ShapeRun>& runs) {
  table.row("narrow phase, CPU ms: median", [](const auto& r) { return milliseconds(r.narrowPhaseCpuUs.median); });
  table.row("  99 %", [](const auto& r) { return milliseconds(r.narrowPhaseCpuUs.p99); });
  table.row("  99.9 %", [](const auto& r) { return milliseconds(r.narrowPhaseCpuUs.p999); });
  table.row("  max", [](const auto& r) { return milliseconds(r.narrowPhaseCpuUs.max); });
  table.row("whole step, CPU ms: median", [](const auto& r) { return milliseconds(r.stepCpuUs.median); });
  table.row("  99 %", [](const auto& r) { return milliseconds(r.stepCpuUs.p99); });
  if (runs.size() < 2) return;
  const Quantiles& first = runs.front().report.narrowPhaseCpuUs;
  const std::string title = fmt::format("narrow phase / {}'s: median, 99 %", scenes::shapeName(runs.front().shape));
  table.row(title.c_str(), [&](const auto& r) {
    const auto ratio = [](double a, double b) { return b > 0 ? fmt::format("{:.1f}", a / b) : std::string("-"); };
    return ratio(r.narrowPhaseCpuUs.median, first.median) + " / " + ratio(r.narrowPhaseCpuUs.p99, first.p99);
  });
}

void printWork(const Table& table, bool isWatched) {
  table.treeRow("operations a step: median / max", [](const auto& t) { return medianAndMax(t.operations); });
  table.treeRow("unresolved pairs, %", [](const auto& t) { return percent(t.unresolvedPairFraction); });
  table.treeRow("certified error, % of size: mean / max",
                [](const auto& t) { return meanAndMax(t.meanErrorFraction, t.maxErrorFraction); });
  if (isWatched)
    table.treeRow("seen error, minutes of arc: mean / max", [](const auto& t) {
      return fmt::format("{:.1f} / {:.1f}", arcMinutes(t.meanSeenError), arcMinutes(t.maxSeenError));
    });
  table.row("contacts: median / max", [](const auto& r) { return medianAndMax(r.contacts); });
  table.row("manifolds: median / max", [](const auto& r) { return medianAndMax(r.manifolds); });
}

void printEnd(const Table& table) {
  table.row("at the end, % of size: mean / max (pairs)", [](const auto&) { return std::string(); });
  table.row("  penetration of bodies", [](const auto& r) { return spread(r.end.depth); });
  table.row("  gap under load", [](const auto& r) { return spread(r.end.gap); });
  table.row("  penetration of the pit", [](const auto& r) { return spread(r.end.pitDepth); });
  table.row("  gap under load at the pit", [](const auto& r) { return spread(r.end.pitGap); });
  table.row("peak speed, m/s", [](const auto& r) { return fmt::format("{:.2f}", r.peakSpeed); });
  table.row("kinetic energy at the end, mJ/kg",
            [](const auto& r) { return fmt::format("{:.3f}", 1000 * r.kineticEnergyEnd); });
  table.row("bodies asleep / lost", [](const auto& r) { return fmt::format("{} / {}", r.asleep, r.lost); });
  table.row("state hash", [](const auto& r) { return r.stateHash; });
}

nlohmann::ordered_json treeToJson(const SourcedTree& source) {
  const SphereTree& tree = *source.tree;
  nlohmann::ordered_json json{{"method", tree.info().method}, {"branching", tree.info().branching},
                              {"depth", tree.depth()},        {"spheres", tree.nodeCount()},
                              {"leaves", tree.leafCount()},   {"triangles", tree.triangles().size()}};
  json["build_wall_s"] = source.buildWallSeconds > 0 ? nlohmann::ordered_json(source.buildWallSeconds) : nullptr;
  return json;
}

template <class T>
nlohmann::ordered_json orNull(const std::optional<T>& value) {
  return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json(nullptr);
}

nlohmann::ordered_json runToJson(const Options& options, const SourcedTree& tree, const ShapeRun& run) {
  nlohmann::ordered_json json{{"scene", options.scene},        {"mesh", tree.meshName},
                              {"bodies", options.heap.bodies}, {"shape", scenes::shapeName(run.shape)},
                              {"steps", run.report.steps},     {"seed", options.heap.seed}};
  json["sleeping"] = options.heap.world.sleeping;
  json["budget_ops"] = orNull(options.heap.world.budget.operations);
  json["budget_us"] = orNull(options.heap.world.budget.microseconds);
  json["priority"] = options.priority;
  json["unresolved"] = options.unresolved;
  json["margin_fraction"] = orNull(options.heap.shape.marginFraction);
  json["tree"] = treeToJson(tree);
  json.update(scenes::toJson(run.report));
  const bool isSeen = options.heap.isWatched && run.report.tree;
  json["seen_error_rad"] =
      isSeen ? nlohmann::ordered_json{{"mean", run.report.tree->meanSeenError}, {"max", run.report.tree->maxSeenError}}
             : nlohmann::ordered_json(nullptr);
  return json;
}

}  // namespace

void printTable(const Options& options, const SourcedTree& tree, const std::vector<ShapeRun>& runs) {
  fmt::print("{} of {} x {} ({} triangles, {} leaf spheres), {} steps of 1/60 s, seed {}\n\n", options.scene,
             options.heap.bodies, tree.meshName, tree.tree->triangles().size(), tree.tree->leafCount(), options.steps,
             options.heap.seed);
  const Table table(runs);
  printTimes(table, runs);
  printWork(table, options.heap.isWatched);
  printEnd(table);
}

nlohmann::ordered_json reportToJson(const Options& options, const SourcedTree& tree,
                                    const std::vector<ShapeRun>& runs) {
  if (runs.size() == 1) return runToJson(options, tree, runs.front());
  auto json = nlohmann::ordered_json::array();
  for (const ShapeRun& run : runs) json.push_back(runToJson(options, tree, run));
  return json;
}

}  // namespace cairn::frame_budget

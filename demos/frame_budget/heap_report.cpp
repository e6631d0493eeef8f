// SPDX-License-Identifier: GPL-3.0-or-later
#include "heap_report.h"

#include <fmt/core.h>

#include <functional>
#include <numbers>
#include <span>
#include <string>

#include "outputs.h"
#include "scenes/heap/heap_report_json.h"
#include "scenes/rockfall/rockfall.h"
#include "table.h"

namespace cairn::frame_budget {
namespace {

using scenes::CrushCourse;
using scenes::CrushStart;
using scenes::HeapReport;

/// The limit for the slowest step in a thousand: this factor of the budget, plus an empty step.
constexpr double kBudgetAllowance = 1.10;

/// Microseconds above the limit of the narrow phase; nothing without a budget in microseconds.
std::optional<double> shareOfAllowance(const Options& options, const HeapRun& run, std::optional<double> cpuUs) {
  const auto& budget = options.heap.world.budget.microseconds;
  if (!budget || !scenes::isSphereTree(run.shape) || !run.course || !cpuUs) return {};
  return *cpuUs / (kBudgetAllowance * *budget + run.course->emptyStepCpuUs);
}

std::optional<double> slowestShare(const Options& options, const HeapRun& run) {
  return shareOfAllowance(options, run, run.report.cost.narrowPhaseCpuUs.p999);
}

std::optional<double> bareShare(const Options& options, const HeapRun& run) {
  return shareOfAllowance(options, run, run.course->bareDeadlineCpuUs);
}

std::string number(const std::optional<double>& value, const char* none) {
  return value ? fmt::format("{:.2f}", *value) : none;
}

void printSeenError(const Table& table, std::span<const scenes::RunCost* const> costs) {
  constexpr double kArcMinutes = 60 * 180 / std::numbers::pi;
  table.row("seen error, minutes of arc: mean / max", [&](std::size_t c) {
    const auto& tree = costs[c]->tree;
    return tree ? fmt::format("{:.1f} / {:.1f}", kArcMinutes * tree->meanSeenError, kArcMinutes * tree->maxSeenError)
                : std::string("-");
  });
}

void printCut(const Table& table, const std::vector<HeapRun>& runs) {
  const auto row = [&](const char* title, const std::function<std::string(const scenes::BudgetCut&)>& cell) {
    table.row(title, [&](std::size_t c) { return runs[c].report.cut ? cell(*runs[c].report.cut) : std::string("-"); });
  };
  row("before and after the budget holds:", [](const auto&) { return std::string(); });
  row("  operations a step: median",
      [](const auto& cut) { return fmt::format("{:.0f} / {:.0f}", cut.before.operations, cut.after.operations); });
  row("  worst certified error, % of size", [](const auto& cut) {
    return percent(cut.before.worstErrorFraction) + " / " + percent(cut.after.worstErrorFraction);
  });
}

void printEnd(const Table& table, const std::vector<HeapRun>& runs, bool isSlope) {
  const auto row = [&](const char* title, const std::function<std::string(const HeapReport&)>& cell) {
    table.row(title, [&](std::size_t c) { return cell(runs[c].report); });
  };
  row("at the end, % of size: mean / max (pairs)", [](const auto&) { return std::string(); });
  row("  penetration of bodies", [](const auto& r) { return spreadCell(r.end.depth); });
  row("  gap under load", [](const auto& r) { return spreadCell(r.end.gap); });
  row(isSlope ? "  penetration of the slope" : "  penetration of the pit",
      [](const auto& r) { return spreadCell(r.end.pitDepth); });
  row(isSlope ? "  gap under load at the slope" : "  gap under load at the pit",
      [](const auto& r) { return spreadCell(r.end.pitGap); });
  row("peak speed, m/s", [](const auto& r) { return fmt::format("{:.2f}", r.peakSpeed); });
  row("kinetic energy at the end, mJ/kg",
      [](const auto& r) { return fmt::format("{:.3f}", 1000 * r.kineticEnergyEnd); });
  row("bodies asleep / lost", [](const auto& r) { return fmt::format("{} / {}", r.asleep, r.lost); });
  row("state hash", [](const auto& r) { return r.stateHash; });
}

void printCourse(const Options& options, const Table& table, const std::vector<HeapRun>& runs) {
  table.row("empty step, narrow phase, CPU ms",
            [&](std::size_t c) { return milliseconds(runs[c].course->emptyStepCpuUs); });
  table.row(fmt::format("99.9 % / ({:.2f} x budget + empty step)", kBudgetAllowance),
            [&](std::size_t c) { return number(slowestShare(options, runs[c]), "-"); });
  table.row("  the same of a loop that reads the clock",
            [&](std::size_t c) { return number(bareShare(options, runs[c]), "-"); });
  table.row("worst penetration, % of size, after", [](std::size_t) { return std::string(); });
  constexpr std::uint32_t kChecksPerSecond = 60 / scenes::kCourseInterval;
  for (std::size_t check = 0; check < runs[0].course->worstPenetration.size(); check += kChecksPerSecond)
    table.row(fmt::format("  {} s", check / kChecksPerSecond),
              [&](std::size_t c) { return percent(runs[c].course->worstPenetration[check]); });
  table.row(fmt::format("below {:.0f} % for good after, s", 100 * scenes::kResolvedFraction),
            [&](std::size_t c) { return number(runs[c].course->resolvedAfter, "never"); });
}

nlohmann::ordered_json courseToJson(const Options& options, const CrushStart& start, const HeapRun& run) {
  const CrushCourse& course = *run.course;
  nlohmann::ordered_json json;
  json["penetration_start_fraction"] = scenes::toJson(start.depth);
  json["empty_step_cpu_us"] = course.emptyStepCpuUs;
  json["narrow_phase_p999_over_allowance"] = orNull(slowestShare(options, run));
  json["clock_loop_p999_over_allowance"] = orNull(bareShare(options, run));
  json["worst_penetration_interval_s"] = scenes::kCourseInterval / 60.0;
  json["worst_penetration_fraction"] = course.worstPenetration;
  json["seconds_until_below_3_percent"] = orNull(course.resolvedAfter);
  return json;
}

}  // namespace

void printHeapTable(const Options& options, const scenes::SourcedTree& tree, const CrushStart* start,
                    const std::vector<HeapRun>& runs) {
  fmt::print("{} of {} x {} ({} triangles, {} leaf spheres), {} steps of 1/{} s, seed {}\n", sceneName(options.scene),
             options.heap.bodies, tree.meshName, tree.tree->triangles().size(), tree.tree->leafCount(), options.steps,
             options.scene == Scene::rockfall ? scenes::Rockfall::kStepsPerSecond : 60, options.heap.seed);
  if (start)
    fmt::print("at the start {} pairs are in each other, by {:.1f} % of their size in the mean, at most {:.1f} %\n",
               start->depth.pairs, 100 * start->depth.mean, 100 * start->depth.max);
  fmt::print("\n");
  std::vector<std::string> names;
  std::vector<const scenes::RunCost*> costs;
  for (const HeapRun& run : runs) {
    names.emplace_back(scenes::shapeName(run.shape));
    costs.push_back(&run.report.cost);
  }
  const Table table(std::move(names));
  printCost(table, costs);
  if (options.heap.isWatched) printSeenError(table, costs);
  if (options.heap.stepsWithoutBudget > 0) printCut(table, runs);
  if (start) printCourse(options, table, runs);
  printEnd(table, runs, options.scene == Scene::rockfall);
}

nlohmann::ordered_json toJson(const Options& options, const scenes::SourcedTree& tree, const CrushStart* start,
                              const HeapRun& run) {
  nlohmann::ordered_json json = describeRun(options, tree, run.shape);
  json.update(scenes::toJson(run.report));
  const auto& cost = run.report.cost.tree;
  json["seen_error_rad"] = options.heap.isWatched && cost
                               ? nlohmann::ordered_json{{"mean", cost->meanSeenError}, {"max", cost->maxSeenError}}
                               : nlohmann::ordered_json(nullptr);
  if (options.scene == Scene::rockfall) json["time_step_s"] = 1.0 / scenes::Rockfall::kStepsPerSecond;
  if (start) json.update(courseToJson(options, *start, run));
  return json;
}

}  // namespace cairn::frame_budget

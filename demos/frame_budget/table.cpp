// SPDX-License-Identifier: GPL-3.0-or-later
#include "table.h"

#include <fmt/core.h>

#include <algorithm>
#include <utility>

namespace cairn::frame_budget {

using scenes::Quantiles;
using scenes::RunCost;

Table::Table(std::vector<std::string> columns) : columns_(std::move(columns)) {
  row("", [&](std::size_t column) { return columns_[column]; });
}

void Table::row(const std::string& title, const std::function<std::string(std::size_t)>& cell) const {
  fmt::print("{:42}", title);
  for (std::size_t column = 0; column < columns_.size(); ++column) fmt::print("{:>24}", cell(column));
  fmt::print("\n");
}

std::string milliseconds(double us) {
  return fmt::format("{:.3f}", us / 1000);
}
std::string percent(double fraction) {
  return fmt::format("{:.2f}", 100 * fraction);
}
std::string meanAndMax(double mean, double max) {
  return fmt::format("{} / {}", percent(mean), percent(max));
}
std::string spreadCell(const scenes::Spread& s) {
  return s.pairs ? fmt::format("{} ({})", meanAndMax(s.mean, s.max), s.pairs) : "none";
}
std::string medianAndMax(const Quantiles& q) {
  return fmt::format("{:.0f} / {:.0f}", q.median, q.max);
}

namespace {

using Costs = std::span<const RunCost* const>;

void printTimes(const Table& table, Costs costs) {
  const auto timeRow = [&](const char* title, Quantiles RunCost::*times, double Quantiles::*quantile) {
    table.row(title, [&](std::size_t c) { return milliseconds(costs[c]->*times.*quantile); });
  };
  timeRow("narrow phase, CPU ms: median", &RunCost::narrowPhaseCpuUs, &Quantiles::median);
  timeRow("  99 %", &RunCost::narrowPhaseCpuUs, &Quantiles::p99);
  timeRow("  99.9 %", &RunCost::narrowPhaseCpuUs, &Quantiles::p999);
  timeRow("  max", &RunCost::narrowPhaseCpuUs, &Quantiles::max);
  timeRow("whole step, CPU ms: median", &RunCost::stepCpuUs, &Quantiles::median);
  timeRow("  99 %", &RunCost::stepCpuUs, &Quantiles::p99);
}

/// Elapsed time; left out where no shape has a deadline.
void printDeadline(const Table& table, Costs costs) {
  if (std::ranges::none_of(costs, [](const RunCost* cost) { return cost->deadline.has_value(); })) return;
  const auto row = [&](const char* title, const std::function<std::string(const scenes::DeadlineKept&)>& cell) {
    table.row(title, [&](std::size_t c) { return costs[c]->deadline ? cell(*costs[c]->deadline) : std::string("-"); });
  };
  row("elapsed, ms: median / 99.9 % / 99.99 %", [](const auto& kept) {
    const Quantiles& q = kept.elapsedUs;
    return milliseconds(q.median) + " / " + milliseconds(q.p999) + " / " + milliseconds(q.p9999);
  });
  row("  steps later than the budget", [](const auto& kept) { return std::to_string(kept.lateSteps); });
  row("  latest by, ms / of it while others ran", [](const auto& kept) {
    return milliseconds(kept.worstMissUs) + " / " + milliseconds(std::min(kept.worstMissOffCpuUs, kept.worstMissUs));
  });
}

void printRatios(const Table& table, Costs costs) {
  if (costs.size() < 2) return;
  const Quantiles& first = costs[0]->narrowPhaseCpuUs;
  table.row(fmt::format("narrow phase / {}'s: median, 99 %", table.name(0)), [&](std::size_t c) {
    const auto ratio = [](double a, double b) { return b > 0 ? fmt::format("{:.1f}", a / b) : std::string("-"); };
    const Quantiles& own = costs[c]->narrowPhaseCpuUs;
    return ratio(own.median, first.median) + " / " + ratio(own.p99, first.p99);
  });
}

/// Rows of figures that only the sphere-tree has; other shapes show "-".
void printWork(const Table& table, Costs costs) {
  using scenes::TreeRunStatistics;
  const auto treeRow = [&](const char* title, const std::function<std::string(const TreeRunStatistics&)>& cell) {
    table.row(title, [&](std::size_t c) { return costs[c]->tree ? cell(*costs[c]->tree) : std::string("-"); });
  };
  treeRow("operations a step: median / max", [](const auto& t) { return medianAndMax(t.operations); });
  treeRow("unresolved pairs, %", [](const auto& t) { return percent(t.unresolvedPairFraction); });
  treeRow("contacts between triangles, %", [](const auto& t) { return percent(t.exactContactFraction); });
  treeRow("certified error, % of size: mean / max",
          [](const auto& t) { return meanAndMax(t.meanErrorFraction, t.maxErrorFraction); });
  table.row("contacts: median / max", [&](std::size_t c) { return medianAndMax(costs[c]->contacts); });
  table.row("manifolds: median / max", [&](std::size_t c) { return medianAndMax(costs[c]->manifolds); });
}

}  // namespace

void printCost(const Table& table, Costs costs) {
  printTimes(table, costs);
  printDeadline(table, costs);
  printRatios(table, costs);
  printWork(table, costs);
}

}  // namespace cairn::frame_budget

// SPDX-License-Identifier: GPL-3.0-or-later
#include "accuracy_cost/experiments/budget_claims.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <string>

namespace cairn::accuracy_cost {
namespace {

constexpr const char* kError = "error_mean_fraction";

double budgetOf(const Table& table, std::size_t row) {
  const std::string& cell = table.text(row, "budget_operations");
  return cell.empty() ? std::numeric_limits<double>::infinity() : table.number(row, "budget_operations");
}

std::string nameOf(const Table& table, std::size_t row) {
  const std::string& budget = table.text(row, "budget_operations");
  return fmt::format("{} ({} levels, {}) in {} of {}", table.text(row, "series"), table.text(row, "depth"),
                     budget.empty() ? std::string("no budget") : budget + " operations", table.text(row, "scene"),
                     table.text(row, "model"));
}

/// Counts the steps from a budget to the next larger one, or to the next longer time, and those on which the error
/// grows.
struct Course {
  std::size_t steps = 0;
  std::vector<std::string> rises;
};

template <class Key>
void follow(const Table& table, std::vector<std::size_t> rows, const Key& key, Course& course) {
  std::ranges::stable_sort(rows, {}, key);
  for (std::size_t i = 1; i < rows.size(); ++i) {
    ++course.steps;
    const double before = table.number(rows[i - 1], kError), after = table.number(rows[i], kError);
    if (after > before)
      course.rises.push_back(fmt::format("{} {:.3g} to {:.3g} %", nameOf(table, rows[i]), 100 * before, 100 * after));
  }
}

/// The dominated settings of Cairn in a scene: another of its settings is faster and has a smaller error.
void addDominated(const Table& table, const Where& scene, std::vector<std::string>& names, std::size_t& all) {
  const auto rows = table.select(scene);
  for (const std::size_t row : rows) {
    ++all;
    const auto isBelowAndLeft = [&](std::size_t other) {
      return table.number(other, kError) < table.number(row, kError) &&
             table.number(other, "time_over_tree") < table.number(row, "time_over_tree");
    };
    const auto by = std::ranges::find_if(rows, isBelowAndLeft);
    if (by == rows.end()) continue;
    const std::string& budget = table.text(*by, "budget_operations");
    names.push_back(fmt::format("{} by {} of {} levels, {}", nameOf(table, row), table.text(*by, "shape"),
                                table.text(*by, "depth"), budget.empty() ? std::string("no budget") : budget));
  }
}

/// The first few; all of them can be read off the table.
std::string listOf(const std::vector<std::string>& texts) {
  constexpr std::size_t kNamed = 3;
  if (texts.empty()) return {};
  const std::size_t named = std::min(kNamed, texts.size());
  const std::string more = named < texts.size() ? fmt::format(" and {} more", texts.size() - named) : std::string();
  return fmt::format(": {}{}", fmt::join(texts.begin(), texts.begin() + static_cast<std::ptrdiff_t>(named), ", "),
                     more);
}

}  // namespace

void addBudgets(const Table& table, std::vector<Claim>& claims) {
  Course byBudget, byTime;
  std::vector<std::string> dominated;
  std::size_t ours = 0;
  for (const std::string& model : table.texts("model"))
    for (const std::string& scene : table.texts("scene")) {
      const Where where{{"model", model}, {"scene", scene}, {"side", "ours"}};
      for (const std::string& series : table.texts("series", where)) {
        Where of = where;
        of.emplace_back("series", series);
        if (table.texts("depth", of).size() > 1) continue;  // several trees, not one by budget
        follow(
            table, table.select(of), [&](std::size_t row) { return budgetOf(table, row); }, byBudget);
        follow(
            table, table.select(of), [&](std::size_t row) { return table.number(row, "time_us"); }, byTime);
      }
      addDominated(table, where, dominated, ours);
    }
  if (byBudget.steps == 0) return;
  claims.push_back(
      {"with more operations, and with more time, the mean error of a pair falls, budget by budget of one tree",
       "from each budget to the next larger one, and from each time to the next longer one, the mean "
       "error does not grow",
       fmt::format("the mean error grows in {} of {} steps to a larger budget{}; and in {} of {} steps to "
                   "a longer time{}; not judged: {} of {} points of ours err more and take longer "
                   "than another of ours{}",
                   byBudget.rises.size(), byBudget.steps, listOf(byBudget.rises), byTime.rises.size(), byTime.steps,
                   listOf(byTime.rises), dominated.size(), ours, listOf(dominated)),
       byBudget.rises.empty() && byTime.rises.empty(),
       {},
       {.reach = Reach::every},
       static_cast<double>(byBudget.rises.size() + byTime.rises.size()),
       true});
}

}  // namespace cairn::accuracy_cost

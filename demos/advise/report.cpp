// SPDX-License-Identifier: GPL-3.0-or-later
#include "advise/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <system_error>

#include "accuracy_cost/figures/draw.h"
#include "cairn/core/atomic_file.h"

namespace cairn::advise {
namespace {

/// Largest number of curves that can be distinguished in a figure.
constexpr std::size_t kCurves = 6;
/// Length of the longest bar in letters.
constexpr double kBar = 48;

/// A temporary empty folder with a unique name, removed with this object. Its path is empty where none could be made.
class ScratchFolder {
 public:
  ScratchFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "cairn-advise-XXXXXX").string();
    if (mkdtemp(name.data())) path_ = name;
  }
  ~ScratchFolder() {
    std::error_code ignored;
    if (!path_.empty()) std::filesystem::remove_all(path_, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// Returns the choice, or the cheapest one where nothing fits.
Choice shownChoice(const Advice& advice) {
  const auto& candidates = advice.measured.candidates;
  return bestChoice(candidates, advice.budgetUs).value_or(cheapestChoice(candidates));
}

std::string numberText(const Rung& rung) {
  return rung.budget > 0 ? fmt::format("{}", rung.budget) : std::string("none");
}

std::string rowText(const Candidate& candidate, const Rung& rung, const char* mark) {
  return fmt::format(
      "{} {:<12} {:>9} {:>5} {:>7} {:>8.2f} {:>8} {:>10} {:>10.0f} {:>9.0f} {:>8.0f} {:>8.3g} {:>8.3g} {:>10.1f}\n",
      mark, builder::methodName(candidate.method), candidate.branching, candidate.depth, candidate.spheres,
      candidate.buildSeconds, candidate.playings, numberText(rung), rung.meanOperations, rung.medianUs, rung.p99Us,
      100 * rung.meanError, 100 * rung.worstError, 100 * rung.unresolvedPairs);
}

/// The rung that represents a tree: the best that fits, else its cheapest.
std::size_t shownRung(const Candidate& candidate, double budgetUs) {
  if (const auto best = bestRung(candidate, budgetUs)) return *best;
  return cheapestChoice({candidate}).rung;
}

const char* markOf(const Advice& advice, const Choice& choice) {
  if (choice == bestChoice(advice.measured.candidates, advice.budgetUs)) return "->";
  return fits(advice.measured.candidates[choice.candidate].rungs[choice.rung], advice.budgetUs) ? "  " : " >";
}

nlohmann::ordered_json rungJson(const Rung& rung, double budgetUs) {
  return {{"budget_operations", rung.budget > 0 ? nlohmann::ordered_json(rung.budget) : nlohmann::ordered_json()},
          {"cuts", rung.cuts},
          {"operations_mean", rung.meanOperations},
          {"narrow_phase_median_us", rung.medianUs},
          {"narrow_phase_p99_us", rung.p99Us},
          {"narrow_phase_p99_quickest_start_us", rung.p99LowUs},
          {"narrow_phase_p99_slowest_start_us", rung.p99HighUs},
          {"certified_error_mean_fraction", rung.meanError},
          {"certified_error_worst_fraction", rung.worstError},
          {"certified_error_worst_mildest_start_fraction", rung.mildestError},
          {"unresolved_pairs_fraction", rung.unresolvedPairs},
          {"fits", fits(rung, budgetUs)}};
}

nlohmann::ordered_json candidateJson(const Candidate& candidate) {
  return {{"method", builder::methodName(candidate.method)},
          {"branching", candidate.branching},
          {"depth", candidate.depth},
          {"spheres", candidate.spheres},
          {"build_wall_s", candidate.buildSeconds},
          {"playings", candidate.playings}};
}

std::string labelOf(const Candidate& candidate) {
  return fmt::format("{} {}x{}", builder::methodName(candidate.method), candidate.branching, candidate.depth);
}

/// Returns the indices of the trees with the smallest error within the time, then those that never fit, at most
/// `kCurves`.
std::vector<std::size_t> shownTrees(const Advice& advice) {
  const auto& candidates = advice.measured.candidates;
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < candidates.size(); ++i) order.push_back(i);
  const auto rank = [&](std::size_t i) {
    const auto best = bestRung(candidates[i], advice.budgetUs);
    return best ? candidates[i].rungs[*best].meanError : INFINITY;
  };
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return rank(a) < rank(b); });
  order.resize(std::min(order.size(), kCurves));
  return order;
}

}  // namespace

std::string tableText(const Advice& advice, bool all) {
  std::string text =
      "                                                          operations a step    narrow phase, us  certified "
      "error, %  unresolved\n"
      "   method       branching depth spheres  build s playings     budget       mean    median      p99     mean    "
      "worst    pairs %\n";
  const auto& candidates = advice.measured.candidates;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const std::size_t shown = shownRung(candidates[i], advice.budgetUs);
    for (std::size_t j = 0; j < candidates[i].rungs.size(); ++j)
      if (all || j == shown) text += rowText(candidates[i], candidates[i].rungs[j], markOf(advice, {i, j}));
  }
  text += fmt::format("-> what to use; > takes longer than {:g} us in more than one of 100 steps\n", advice.budgetUs);
  text +=
      "Median and p99 are of all steps, of all starts and playings together, in which any of the trees has contacts.\n";
  if (advice.trial.sieveUs)
    text +=
        "Every tree was played on every budget; those clearly behind less often than the best. --thorough plays all "
        "alike and, unless methods are named, tries adaptive too, which takes long to build and often errs less.\n";
  return text;
}

std::string curveText(const Advice& advice) {
  const Candidate& candidate = advice.measured.candidates[shownChoice(advice).candidate];
  double greatest = 0;
  for (const Rung& rung : candidate.rungs) greatest = std::max(greatest, rung.meanError);
  std::string text = fmt::format("{}, {} children, {} levels: mean certified error, % of the size\n",
                                 builder::methodName(candidate.method), candidate.branching, candidate.depth);
  text += "    operations   us p99\n";
  for (const Rung& rung : candidate.rungs) {
    const auto letters = greatest > 0 ? static_cast<std::size_t>(std::lround(kBar * rung.meanError / greatest)) : 0;
    text += fmt::format("  {} {:>10} {:>8.0f} {} {:.3g}\n", fits(rung, advice.budgetUs) ? " " : ">", numberText(rung),
                        rung.p99Us, std::string(std::max<std::size_t>(letters, 1), '#'), 100 * rung.meanError);
  }
  return text;
}

nlohmann::ordered_json toJson(const Advice& advice) {
  const auto& candidates = advice.measured.candidates;
  auto trees = nlohmann::ordered_json::array();
  for (const Candidate& candidate : candidates) {
    trees.push_back(candidateJson(candidate));
    auto rungs = nlohmann::ordered_json::array();
    for (const Rung& rung : candidate.rungs) rungs.push_back(rungJson(rung, advice.budgetUs));
    trees.back()["budgets"] = std::move(rungs);
  }
  nlohmann::ordered_json recommendation;
  if (const auto best = bestChoice(candidates, advice.budgetUs)) {
    recommendation = candidateJson(candidates[best->candidate]);
    recommendation.update(rungJson(candidates[best->candidate].rungs[best->rung], advice.budgetUs));
  }
  const Rung& whole = candidates[shownChoice(advice).candidate].rungs.back();
  return {{"mesh", advice.mesh},
          {"bodies", advice.trial.bodies},
          {"starts", advice.trial.starts},
          {"frames", advice.trial.frames},
          {"busy_frames", advice.measured.busyFrames},
          {"seed", advice.trial.seed},
          {"thorough", !advice.trial.sieveUs},
          {"times_are_of", "all steps of all starts and playings in which any of the trees has contacts"},
          {"recording_hash", advice.measured.recording},
          {"budget_us", advice.budgetUs},
          {"operations_per_us", operationsPerUs(whole)},
          {"recommendation", recommendation},
          {"advice", adviceText(candidates, advice.budgetUs, advice.mesh)},
          {"trees", trees}};
}

Status drawCurves(const Advice& advice, const std::filesystem::path& svg) {
  using namespace accuracy_cost;
  Table table({"tree", "p99_us", "error_mean_fraction", "error_worst_fraction"});
  Panel mean{.title = "mean certified error",
             .x = "p99_us",
             .xAxis = {"narrow phase, µs a step (99 % of the steps)", true, 1},
             .yAxis = {"% of the size", true, 100},
             .series = {}};
  Panel worst = mean;
  worst.title = "worst certified error";
  unsigned number = 0;
  for (const std::size_t i : shownTrees(advice)) {
    const Candidate& candidate = advice.measured.candidates[i];
    for (const Rung& rung : candidate.rungs) table.add(labelOf(candidate), rung.p99Us, rung.meanError, rung.worstError);
    const Series series{
        labelOf(candidate), {{"tree", labelOf(candidate)}}, "error_mean_fraction", {number, number, number}};
    mean.series.push_back(series);
    worst.series.push_back(series);
    worst.series.back().y = "error_worst_fraction";
    ++number;
  }
  const Figure figure{svg.stem().string(),
                      fmt::format("{}: {} bodies, budget by budget", advice.mesh, advice.trial.bodies),
                      2,
                      {mean, worst}};
  const ScratchFolder scratch;
  if (scratch.path().empty()) return Error{"no temporary folder could be made to draw in; free some space"};
  const std::filesystem::path csv = scratch.path() / "curves.csv";
  if (Status written = writeFileAtomically(csv, table.csv()); !written) return written;
  const auto folder = svg.has_parent_path() ? svg.parent_path() : std::filesystem::path(".");
  const auto drawn = drawFigure(figure, table, csv, folder);
  return drawn ? Status() : drawn.error();
}

}  // namespace cairn::advise

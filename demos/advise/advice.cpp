// SPDX-License-Identifier: GPL-3.0-or-later
#include "advise/advice.h"

#include <fmt/format.h>

#include <tuple>

namespace cairn::advise {
namespace {

/// Lower is better.
auto rankOf(const Rung& rung) {
  return std::tuple(rung.meanError, rung.worstError, rung.p99Us);
}

std::string treeText(const Candidate& candidate) {
  return fmt::format("--method {} --branching {} --depth {}", builder::methodName(candidate.method),
                     candidate.branching, candidate.depth);
}

// "400 operations", or "no budget".
std::string budgetText(const Rung& rung) {
  return rung.budget > 0 ? fmt::format("{} operations", rung.budget) : std::string("no budget");
}

// The cost of a budget that cuts nothing, for users who want bounded steps.
std::string boundText(const Candidate& candidate) {
  for (const Rung& rung : candidate.rungs)
    if (rung.budget > 0 && !rung.cuts)
      return fmt::format(" (one of {} cut nothing either, and takes {:.0f} us)", rung.budget, rung.p99Us);
  return "";
}

}  // namespace

bool fits(const Rung& rung, double budgetUs) {
  return rung.p99Us <= budgetUs;
}

std::optional<std::size_t> bestRung(const Candidate& candidate, double budgetUs) {
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < candidate.rungs.size(); ++i)
    if (fits(candidate.rungs[i], budgetUs) && (!best || rankOf(candidate.rungs[i]) < rankOf(candidate.rungs[*best])))
      best = i;
  return best;
}

std::optional<Choice> bestChoice(const std::vector<Candidate>& candidates, double budgetUs) {
  std::optional<Choice> best;
  const auto rank = [&](const Choice& choice) {
    const Candidate& candidate = candidates[choice.candidate];
    return std::tuple_cat(rankOf(candidate.rungs[choice.rung]), std::tuple(candidate.spheres));
  };
  for (std::size_t i = 0; i < candidates.size(); ++i)
    if (const auto rung = bestRung(candidates[i], budgetUs))
      if (const Choice choice{i, *rung}; !best || rank(choice) < rank(*best)) best = choice;
  return best;
}

Choice cheapestChoice(const std::vector<Candidate>& candidates) {
  Choice best;
  for (std::size_t i = 0; i < candidates.size(); ++i)
    for (std::size_t j = 0; j < candidates[i].rungs.size(); ++j)
      if (candidates[i].rungs[j].p99Us < candidates[best.candidate].rungs[best.rung].p99Us) best = {i, j};
  return best;
}

double operationsPerUs(const Rung& rung) {
  return rung.medianUs > 0 ? rung.meanOperations / rung.medianUs : 0;
}

std::string adviceText(const std::vector<Candidate>& candidates, double budgetUs, const std::string& mesh) {
  const auto best = bestChoice(candidates, budgetUs);
  const Choice choice = best ? *best : cheapestChoice(candidates);
  const Candidate& candidate = candidates[choice.candidate];
  const Rung& rung = candidate.rungs[choice.rung];
  if (!best)
    return fmt::format(
        "No tree that was tried answers within {:g} us in 99 of 100 steps here: the cheapest ({}, {}) takes "
        "{:.0f} us; allow that much, or have fewer bodies touch.",
        budgetUs, treeText(candidate), budgetText(rung), rung.p99Us);
  const std::string set = rung.budget > 0 ? fmt::format("set the budget to {} operations a step{}", rung.budget,
                                                        rung.cuts ? "" : " (which cut nothing)")
                                          : "set no budget of operations" + boundText(candidate);
  return fmt::format(
      "Build with `cairn build {} {} -o FILE`, {}; expect {:.0f} us at most in 99 of 100 steps here ({:.0f} to {:.0f} "
      "from start to start), and a certified error of {:.3g} % of the size in the mean, {:.3g} % at worst "
      "({:.3g} % in the start where it is least). Other starts may take {}more.",
      mesh, treeText(candidate), set, rung.p99Us, rung.p99LowUs, rung.p99HighUs, 100 * rung.meanError,
      100 * rung.worstError, 100 * rung.mildestError, rung.budget > 0 ? "and err " : "");
}

}  // namespace cairn::advise

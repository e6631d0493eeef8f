// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cairn/builder/build.h"

namespace cairn::advise {

/// What a tree does on one budget of operations a step. Errors are certified, fractions of the size (the bounding box's
/// diagonal), the same bits on every run; microseconds are of this machine. Operations and times are over the
/// steps in which bodies touch; errors over those in which there are contacts, on a small budget also of bodies that
/// are still apart: what any other program that plays the same steps on the same budget is told.
struct Rung {
  std::uint64_t budget = 0;              ///< operations; 0: none was set
  bool cuts = true;                      ///< false: nothing was left unresolved
  double meanOperations = 0;             ///< a step
  double medianUs = 0, p99Us = 0;        ///< of the whole narrow phase, CPU time a step, over all steps of all playings
  double p99LowUs = 0, p99HighUs = 0;    ///< of the start that was quickest, and of the slowest
  double meanError = 0, worstError = 0;  ///< mean over the steps of the pairs' mean; worst pair of any step
  double mildestError = 0;               ///< worst pair of the start whose worst is least
  double unresolvedPairs = 0;            ///< share of all pairs
};

/// A tree and what it does, from the smallest budget to one that cuts nothing (where one was found) and to none.
struct Candidate {
  builder::Method method = builder::Method::combined;
  std::uint32_t branching = 8, depth = 3;
  std::uint32_t spheres = 0;  ///< of all levels
  double buildSeconds = 0;
  std::uint32_t playings = 0;  ///< of each budget
  std::vector<Rung> rungs;
};

/// A candidate and one of its rungs, by their places.
struct Choice {
  std::size_t candidate = 0, rung = 0;

  friend bool operator==(const Choice&, const Choice&) = default;
};

/// Whether 99 of 100 steps took no more than this.
bool fits(const Rung& rung, double budgetUs);

/// The rung of one candidate with the lowest mean error of those that fit, then the lowest worst error, then the
/// quickest; nothing when none fits.
std::optional<std::size_t> bestRung(const Candidate& candidate, double budgetUs);

/// Likewise over all candidates; of equals the one with the fewest spheres.
std::optional<Choice> bestChoice(const std::vector<Candidate>& candidates, double budgetUs);

/// What is cheapest at 99 %. Precondition: there is a rung.
Choice cheapestChoice(const std::vector<Candidate>& candidates);

/// Operations of a step on the mean over the microseconds of the median one: what a step waits for the processor does
/// not count.
double operationsPerUs(const Rung& rung);

/// One sentence for a budget: what to build, what to set, what to expect. `mesh` is its file's name.
std::string adviceText(const std::vector<Candidate>& candidates, double budgetUs, const std::string& mesh);

}  // namespace cairn::advise

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cairn/builder/build.h"

namespace cairn::advise {

/// The results of a tree with one budget of operations per step. Errors are certified, fractions of the size (the
/// bounding box's diagonal), with the same bits on every run. Microseconds are those of this machine. Operations and
/// times cover the steps in which bodies touch. Errors cover the steps with contacts; with a small budget these include
/// bodies that are still separate. Any other program that plays the same steps with the same budget gets the same
/// errors.
struct Rung {
  std::uint64_t budget = 0;              ///< operations per step; 0: unlimited
  bool cuts = true;                      ///< false: no pair stayed unresolved
  double meanOperations = 0;             ///< per step
  double medianUs = 0, p99Us = 0;        ///< CPU time of the whole narrow phase per step, over all steps of all plays
  double p99LowUs = 0, p99HighUs = 0;    ///< of the fastest and of the slowest start
  double meanError = 0, worstError = 0;  ///< mean over the steps of the pairs' mean; worst pair of any step
  double mildestError = 0;               ///< worst pair of the start with the smallest worst error
  double unresolvedPairs = 0;            ///< share of all pairs
};

/// A tree and its results, ordered by budget. The budgets go from the smallest to one that cuts nothing (where one was
/// found), then to unlimited.
struct Candidate {
  builder::Method method = builder::Method::combined;
  std::uint32_t branching = 8, depth = 3;
  std::uint32_t spheres = 0;  ///< of all levels
  double buildSeconds = 0;
  std::uint32_t playings = 0;  ///< number of plays with each budget
  std::vector<Rung> rungs;
};

/// A candidate and one of its rungs, by index.
struct Choice {
  std::size_t candidate = 0, rung = 0;

  friend bool operator==(const Choice&, const Choice&) = default;
};

/// True when 99 of 100 steps took at most this time.
bool fits(const Rung& rung, double budgetUs);

/// Returns the best rung of one candidate that fits: lowest mean error, then lowest worst error, then fastest. Nothing
/// when none fits.
std::optional<std::size_t> bestRung(const Candidate& candidate, double budgetUs);

/// Returns the best rung over all candidates by the order of `bestRung`; among equals the one with the fewest spheres.
std::optional<Choice> bestChoice(const std::vector<Candidate>& candidates, double budgetUs);

/// Returns the choice with the least time at the 99th percentile. Precondition: there is a rung.
Choice cheapestChoice(const std::vector<Candidate>& candidates);

/// Returns mean operations per step divided by the microseconds of the median step. The median excludes steps that
/// waited for the processor.
double operationsPerUs(const Rung& rung);

/// Returns one sentence of advice for a budget: the tree to build, the settings and the expected result. `mesh` is its
/// file's name.
std::string adviceText(const std::vector<Candidate>& candidates, double budgetUs, const std::string& mesh);

}  // namespace cairn::advise

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace cairn::hard {

enum class Bound { atMost, atLeast };

/// One figure a case is judged by, and what the case asks of it.
struct Measure {
  std::string name;  ///< what was measured, as a reader of the table would say it
  double value = 0;  ///< ours; not a number counts as beyond the limit
  double limit = 0;  ///< what the criterion asks
  Bound bound = Bound::atMost;
  std::string unit;       ///< "m", "% of size", "of 1000"; empty for a bare number
  std::string stock;      ///< which of Bullet's own shapes did best on the same case; empty where none can be asked
  double stockValue = 0;  ///< its figure; of no meaning when `stock` is empty
};

/// How much of a case is run: `quick` within seconds, for every test run; `whole` as the case's criterion means it.
enum class Effort { quick, whole };

/// The result of a case. Deterministic: the same figures every time, but for those whose unit is a time or memory.
struct Outcome {
  std::vector<Measure> measures;
  std::string why;  ///< of a miss, or of a limit that differs from the proposed one: one sentence
};

/// One hard case: builder or plugin at an edge where collision code breaks.
struct HardCase {
  std::string
      id;  ///< "G1" to "G15", "D1" to "D16"; "C1", "C2": certificates; "I1", "I2": isolation; "L1", "L2": long runs
  std::string name;
  std::string criterion;  ///< in words, with where the figure comes from
  Outcome (*run)(Effort effort) = nullptr;
};

/// In the order of their numbers.
std::vector<HardCase> geometryCases();
std::vector<HardCase> dynamicsCases();
std::vector<HardCase> certificateCases();
std::vector<HardCase> isolationCases();
std::vector<HardCase> longRunCases();
std::vector<HardCase> allHardCases();

}  // namespace cairn::hard

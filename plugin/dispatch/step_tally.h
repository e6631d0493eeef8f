// SPDX-License-Identifier: Zlib
#pragma once

#include <algorithm>
#include <cstdint>

#include "cairn/bullet/step.h"
#include "pairs/pair_report.h"

namespace cairn::bullet {

/// Sums the reports of a step's pairs. The step's cost is entered by whoever spends it.
struct StepTally {
  StepStatistics statistics;

  /// The elapsed time of the step so far.
  void tookUntilNow(double microseconds) {
    statistics.elapsedMicroseconds = microseconds;
    statistics.missedByMicroseconds =
        std::max(microseconds - statistics.deadlineMicroseconds.value_or(microseconds), 0.0);
  }
  /// Adds a pair's report. The number of pairs is counted elsewhere, because some pairs have nothing to report.
  void add(const PairReport& report) {
    statistics.unresolvedPairs += report.isUnresolved ? 1 : 0;
    statistics.contacts += report.contacts;
    statistics.exactContacts += report.exactContacts;
    statistics.manifolds += report.manifolds;
    statistics.worstErrorFraction = std::max(statistics.worstErrorFraction, report.errorFraction);
    statistics.worstSeenError = std::max(statistics.worstSeenError, report.seenError);
    if (report.contacts == 0) return;
    errorSum_ += report.errorFraction;
    seenSum_ += report.seenError;
    ++reportingPairs_;
    statistics.meanErrorFraction = errorSum_ / reportingPairs_;
    statistics.meanSeenError = seenSum_ / reportingPairs_;
  }

 private:
  double errorSum_ = 0, seenSum_ = 0;
  std::uint32_t reportingPairs_ = 0;
};

}  // namespace cairn::bullet

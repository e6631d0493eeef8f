// SPDX-License-Identifier: Zlib
#pragma once

#include <algorithm>
#include <cstdint>

#include "cairn/bullet/step.h"
#include "pairs/pair_report.h"

namespace cairn::bullet {

/// What the pairs of a step add up to. What a step costs is entered by who spends it.
struct StepTally {
  StepStatistics statistics;

  /// The step has taken so long so far.
  void tookUntilNow(double microseconds) {
    statistics.elapsedMicroseconds = microseconds;
    statistics.missedByMicroseconds =
        std::max(microseconds - statistics.deadlineMicroseconds.value_or(microseconds), 0.0);
  }
  /// What a pair answered. Its place among `pairs` is counted apart: some have nothing to report.
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

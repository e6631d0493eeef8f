// SPDX-License-Identifier: Zlib
#pragma once

#include "cairn/core/export.h"
#include "cairn/core/ranked_priority.h"

namespace cairn {

/// The pair whose answer has the worst certified error first, as a fraction of the smaller body's size: what a step's
/// statistics report. rank = max(worst error of the front, unansweredError) / size x (1 + age).
class WorstErrorFirst final : public RankedPriority {
 public:
  bool hasImportances() const override { return false; }

 protected:
  double weight(const ScheduledPair& pair) const override { return 1 / static_cast<double>(pair.size); }
};

}  // namespace cairn

// SPDX-License-Identifier: Zlib
#pragma once

#include <optional>

#include "cairn/core/export.h"
#include "cairn/core/ranked_priority.h"

namespace cairn {

/// Two classes, high before low, round-robin inside each (O'Sullivan and Dingliana 1999; thesis 2.7.1).
///
/// With a viewer a pair is high when some of it is in view and within `kHighEccentricity` of the gaze. Without one,
/// when its bodies approach by more than the smaller one's size within a second: closingSpeed > kHighRate size. A low
/// pair counts `kLowWeight`: it goes before a high one that has just been served once it has waited for 1 / kLowWeight
/// steps.
class CAIRN_CORE_EXPORT TwoClasses final : public RankedPriority {
 public:
  static constexpr double kHighEccentricity = 2 * kHalfAcuityEccentricity;  ///< radians: acuity is a third of the best
  static constexpr double kHighRate = 1;                                    ///< per second
  /// Weight of a low pair beside 1 for a high one.
  static constexpr double kLowWeight = 1.0 / 16;

  void setViewer(const std::optional<Viewer>& viewer) override { viewer_ = viewer; }
  double importance(const ScheduledPair& pair) const override { return weight(pair); }

 protected:
  double weight(const ScheduledPair& pair) const override;
  /// Round-robin does not ask how wrong a pair is.
  double error(const ScheduledPair& /*pair*/) override { return 1; }

 private:
  bool isHigh(const ScheduledPair& pair) const;

  std::optional<Viewer> viewer_;
};

}  // namespace cairn

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "rockfall/validation/block_runs.h"
#include "rockfall/validation/distributions.h"

namespace cairn::rockfall {

inline constexpr std::array kReportedShares{0.05, 0.25, 0.5, 0.75, 0.95};
/// What is asked of a fit: of the median, and of the middle half's width.
inline constexpr double kMedianWithin = 0.10, kMiddleHalfWithin = 0.30;

/// Where blocks stopped, seen from the middle of the places from which they fell.
struct Stops {
  Distribution runoutM;   ///< along x, down the slope
  Distribution lateralM;  ///< along the data's z
};
/// How simulated blocks ended.
struct Endings {
  std::size_t resting = 0, moving = 0, left = 0, lost = 0;  ///< left: over an edge or a hole
  Distribution maxSpeedMPerS;
};

/// How far one distribution is from another.
struct Distance {
  double kolmogorovSmirnov = 0, kolmogorovSmirnovBound = 0, wassersteinM = 0;
  double medianRatio = 0, middleHalfRatio = 0;  ///< of the first to the other; 0 where the other is 0
  bool fits() const;
};
Distance distanceOf(const Distribution& simulated, const Distribution& measured);

/// A profile as measured, simulated and published; what there is none of is empty.
struct ProfileComparison {
  std::string name;
  bool isCalibrated = false;  ///< else a prediction
  Stops measured, simulated, published;
  Endings endings;
  struct Scan {
    std::string name;
    Stops simulated, published;
  };
  std::vector<Scan> scans;  ///< of which blocks fell
};

/// `ends` are those of `runs`, all of one profile.
ProfileComparison compareProfile(const QuarryScene& quarry, std::span<const BlockRun> runs,
                                 std::span<const BlockEnd> ends);

/// The stops of some simulated blocks of a profile, and of those measured.
Stops stopsOf(const QuarryProfile& profile, std::span<const BlockEnd> ends);
Stops measuredStops(const QuarryProfile& profile);

}  // namespace cairn::rockfall

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "accuracy_cost/experiments/statistics.h"
#include "cairn/core/result.h"
#include "scenes/converge/converge_run.h"

namespace cairn::accuracy_cost {

/// A shape at one setting.
struct Contender {
  std::string series;  ///< contenders of one series differ in one setting, in the order they are listed
  scenes::ShapeKind shape = scenes::ShapeKind::treeLeaves;
  std::string method;                        ///< of its tree; empty: it has none
  unsigned depth = 0;                        ///< of its tree
  std::optional<std::int64_t> operations{};  ///< a frame; nothing: as many as it takes
  std::optional<double> margin{};            ///< of body size
  bool isOurs = false;
  const scenes::Model* model = nullptr;
};

/// What became of a contender.
struct Outcome {
  scenes::ContactAccuracy accuracy;
  double certifiedError = 0;         ///< mean over the frames with contacts; 0 where nothing is certified
  double operations = 0;             ///< median a frame
  MedianInterval timeUs;             ///< narrow phase a frame, mean over the frames; over the repetitions
  MedianInterval timeOverReference;  ///< the same over that of the first contender in the same repetition
};

/// Shows a recording to all contenders in turn, `repetitions` times; the exact check judges the first. Those this build
/// has no library for are left out: nothing stands in their place. Fails as `playRecording` does.
Result<std::vector<std::optional<Outcome>>> holdContest(const scenes::Recording& recording,
                                                        const std::vector<Contender>& contenders,
                                                        std::uint32_t truthEvery, std::uint32_t repetitions,
                                                        const std::function<bool(double)>& progress);

}  // namespace cairn::accuracy_cost

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

/// A shape with one setting.
struct Contender {
  std::string series;  ///< contenders of one series differ in one setting, in the order of the list
  scenes::ShapeKind shape = scenes::ShapeKind::treeLeaves;
  std::string method;                        ///< of its tree; empty without a tree
  unsigned depth = 0;                        ///< of its tree, levels below the root
  std::optional<std::int64_t> operations{};  ///< budget per frame; none: unlimited
  std::optional<double> margin{};            ///< fraction of body size
  bool isOurs = false;
  const scenes::Model* model = nullptr;
};

/// The result of a contender.
struct Outcome {
  scenes::ContactAccuracy accuracy;
  double certifiedError = 0;         ///< mean over the frames with contacts; 0 where nothing is certified
  double operations = 0;             ///< per frame, median
  MedianInterval timeUs;             ///< narrow phase per frame: mean over the frames, median over the repetitions
  MedianInterval timeOverReference;  ///< that time divided by the first contender's in the same repetition
};

/// Plays a recording for all contenders in turn, `repetitions` times. The exact check judges the first repetition. A
/// contender whose library this build lacks has no outcome. Fails as `playRecording` does.
Result<std::vector<std::optional<Outcome>>> holdContest(const scenes::Recording& recording,
                                                        const std::vector<Contender>& contenders,
                                                        std::uint32_t truthEvery, std::uint32_t repetitions,
                                                        const std::function<bool(double)>& progress);

}  // namespace cairn::accuracy_cost

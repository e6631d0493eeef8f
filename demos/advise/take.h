// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "advise/advice.h"
#include "scenes/converge/converge.h"
#include "scenes/converge/player.h"
#include "scenes/figures/quantiles.h"

namespace cairn::advise {

/// Returns quantiles over these frames of all plays together. `times` is by play, by frame. A slow step counts even if
/// another play was fast at the same step.
scenes::Quantiles stepQuantiles(const std::vector<std::vector<double>>& times,
                                const std::vector<std::uint32_t>& frames);

/// The results of a tree on a recording with one budget, over all its plays. Errors and operations have the same bits
/// in each play; times differ.
class Take {
 public:
  /// `budget`: operations per step; nothing: unlimited.
  explicit Take(std::optional<std::uint64_t> budget) : budget_(budget) {}

  /// Plays all of the recording's runs once more, each in a world of its own. Fails as `makePlayer` does.
  Status play(const scenes::Recording& recording, const scenes::Model& model);

  std::uint32_t playings() const { return static_cast<std::uint32_t>(times_.size()); }
  /// The largest number of operations of any frame; 0 before the first play.
  std::uint64_t mostOperations() const;
  /// True when any pair stayed unresolved in any frame, also in frames without contact.
  bool cuts() const;
  /// Returns the frames in which bodies touch, numbered through all runs.
  std::vector<std::uint32_t> busyFrames() const;
  /// Returns operations and times over these frames, with times by `stepQuantiles`. Errors and unresolved pairs follow
  /// `runCost`, over all frames with contacts. Precondition: it was played; `frames` is not empty.
  Rung rung(const std::vector<std::uint32_t>& frames) const;

 private:
  /// Returns those of the frames that belong to one run.
  std::vector<std::uint32_t> ofRun(std::uint32_t run, const std::vector<std::uint32_t>& frames) const;
  double worstError(std::uint32_t run) const;
  /// Adds the spread between the starts.
  void addSpread(Rung& rung, const std::vector<std::uint32_t>& frames) const;

  std::optional<std::uint64_t> budget_;
  std::uint32_t framesPerRun_ = 0;
  std::vector<scenes::StepRecord> records_;  ///< of the first play, by frame
  std::vector<std::vector<double>> times_;   ///< CPU microseconds of the narrow phase, by play, by frame
};

}  // namespace cairn::advise

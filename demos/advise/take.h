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

/// Quantiles of these frames of all playings together; `times` by playing, by frame: a slow step counts however fast
/// the same step was at another playing.
scenes::Quantiles stepQuantiles(const std::vector<std::vector<double>>& times,
                                const std::vector<std::uint32_t>& frames);

/// What a tree does with a recording on one budget, over all its playings: errors and operations are the same bits in
/// each, times are not.
class Take {
 public:
  /// Operations a step; nothing: as many as it takes.
  explicit Take(std::optional<std::uint64_t> budget) : budget_(budget) {}

  /// Shows all of the recording's runs once more, each in a world of its own. Fails as `makePlayer` does.
  Status play(const scenes::Recording& recording, const scenes::Model& model);

  std::uint32_t playings() const { return static_cast<std::uint32_t>(times_.size()); }
  /// Of any frame; 0 before it is played.
  std::uint64_t mostOperations() const;
  /// Whether anything was left unresolved in any frame, whether or not bodies touch in it.
  bool cuts() const;
  /// The frames in which bodies touch, counted on from run to run.
  std::vector<std::uint32_t> busyFrames() const;
  /// Operations and times over these frames, times by `stepQuantiles`; errors and unresolved pairs as `runCost` has
  /// them, over all frames in which it has contacts. Precondition: it was played; there are frames.
  Rung rung(const std::vector<std::uint32_t>& frames) const;

 private:
  /// Of these frames those of one run.
  std::vector<std::uint32_t> ofRun(std::uint32_t run, const std::vector<std::uint32_t>& frames) const;
  double worstError(std::uint32_t run) const;
  /// How much starts differ.
  void addSpread(Rung& rung, const std::vector<std::uint32_t>& frames) const;

  std::optional<std::uint64_t> budget_;
  std::uint32_t framesPerRun_ = 0;
  std::vector<scenes::StepRecord> records_;  ///< of the first playing, by frame
  std::vector<std::vector<double>> times_;   ///< CPU us of the narrow phase by playing, by frame
};

}  // namespace cairn::advise

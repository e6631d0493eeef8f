// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "scenes/converge/converge.h"
#include "scenes/converge/player.h"
#include "scenes/truth/contact_accuracy.h"
#include "scenes/world/run_cost.h"

namespace cairn::scenes {

struct ConvergeReport {
  RunCost cost;
  ContactAccuracy accuracy;
  std::vector<StepRecord> records;  ///< one per frame, run after run
};

/// Called before each frame, played or judged, with the finished share from 0 to 1; returns false to stop.
using PlayCallback = std::function<bool(double fraction)>;

/// Plays a recording for every player, run by run in turn, so that a busy machine disturbs all players alike. Every
/// `truthEvery`-th frame (>= 1) is judged after the player's turn, because the check must not disturb the caches of
/// timed code. The truth of a frame is found once for all players. Reports are in the players' order. Fails with
/// `builder::kCancelled` if the callback stops it, and if the mesh is not closed.
Result<std::vector<ConvergeReport>> playRecording(const Recording& recording, const Model& model,
                                                  std::span<const std::unique_ptr<Player>> players,
                                                  std::uint32_t truthEvery, const PlayCallback& progress = {});

}  // namespace cairn::scenes

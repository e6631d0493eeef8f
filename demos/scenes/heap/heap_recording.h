// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>

#include "scenes/converge/converge.h"

namespace cairn::scenes {

struct HeapRecordingOptions {
  std::uint32_t bodies = 20;
  std::uint32_t from = 60;     ///< steps before the first frame that is kept: the bodies fall
  std::uint32_t frames = 300;  ///< 1/60 s each
  std::uint64_t seed = 1;
};

/// A heap as exact meshes pile it up (GImpact with a margin of 0.1 % of body size), independent of every shape under
/// test; what is recorded are the bodies alone, not the pit. No body sleeps. One run. `afterStep` is told how much is
/// done, from 0 to 1, and returns false to stop: then this fails with `builder::kCancelled`.
Result<Recording> recordHeap(const Model& model, const HeapRecordingOptions& options,
                             const std::function<bool(double)>& afterStep = {});

}  // namespace cairn::scenes

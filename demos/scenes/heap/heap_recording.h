// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>

#include "scenes/converge/converge.h"

namespace cairn::scenes {

struct HeapRecordingOptions {
  std::uint32_t bodies = 20;
  std::uint32_t from = 60;     ///< steps before the first recorded frame, while the bodies fall
  std::uint32_t frames = 300;  ///< 1/60 s each
  std::uint64_t seed = 1;
};

/// Records a heap of exact meshes (GImpact with a margin of 0.1 % of body size), independent of every tested shape.
/// Only the bodies are recorded, not the pit. No body sleeps. There is one run. `afterStep` receives the finished
/// share, from 0 to 1. If it returns false, this fails with `builder::kCancelled`.
Result<Recording> recordHeap(const Model& model, const HeapRecordingOptions& options,
                             const std::function<bool(double)>& afterStep = {});

}  // namespace cairn::scenes

// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenes/heap/heap_recording.h"

#include <string>

#include "cairn/builder/progress.h"
#include "scenes/heap/heap.h"

namespace cairn::scenes {

Result<Recording> recordHeap(const Model& model, const HeapRecordingOptions& options,
                             const std::function<bool(double)>& afterStep) {
  HeapOptions heapOptions;
  heapOptions.bodies = options.bodies;
  heapOptions.seed = options.seed;
  heapOptions.world.shape = ShapeKind::gimpact;
  heapOptions.world.sleeping = false;
  auto heap = Heap::create(model, heapOptions);
  if (!heap) return heap.error();
  Recording recording{options.bodies, 1, options.frames, {}};
  const std::uint32_t steps = options.from + options.frames;
  for (std::uint32_t step = 0; step < steps; ++step) {
    if (step >= options.from) {
      const std::vector<BodyMotion> now = heap.value()->world().motions();
      recording.motions.insert(recording.motions.end(), now.begin(), now.end());
    }
    heap.value()->step();
    if (afterStep && !afterStep(static_cast<double>(step + 1) / steps)) return Error{std::string(builder::kCancelled)};
  }
  return recording;
}

}  // namespace cairn::scenes

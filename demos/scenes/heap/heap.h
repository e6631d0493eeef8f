// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "scenes/world/body_scene.h"
#include "scenes/world/pit.h"

namespace cairn::scenes {

struct HeapOptions {
  std::uint32_t bodies = 100;  ///< at least 1
  std::uint64_t seed = 1;      ///< for the bodies' orientations and places
  bool isWatched = false;      ///< a viewer stands at the pit's edge, see `heapViewer`
  /// Steps before the world's budget applies. They show its effect on bodies at rest.
  std::uint32_t stepsWithoutBudget = 0;
  WorldOptions world;  ///< its shape is the bodies' shape; its viewer is set when the heap is watched
  ShapeOptions shape;
  /// Start poses, one for each body; empty: bodies start in a column.
  std::vector<btTransform> start;
};

/// Returns a viewer well outside a pit who looks at the middle of its heap: 1.5 times the pit's width away, 60 degrees
/// of view.
Viewer heapViewer(const Pit& pit);

/// Bodies of one mesh in a pit. Without start poses they drop in a column, at random orientations, without contact.
///
///     auto heap = Heap::create(model, {.bodies = 100}).value();
///     HeapReport report = runHeap(*heap, 600).value();
class Heap final : public BodyScene {
 public:
  /// Fails when the shape or the dispatcher refuses its options.
  static Result<std::unique_ptr<Heap>> create(const Model& model, const HeapOptions& options);

  ~Heap() override;

  const Pit& pit() const { return pit_; }

  /// Number of bodies that left the pit through ground or walls by more than half their size, or whose place is NaN.
  std::uint32_t countLost() const override;
  std::size_t groundParts() const override { return pit_.faces().size(); }
  double clearance(const PlacedBody& body, const ExactSurface& surface, std::size_t part) const override;

 private:
  Heap(const Model& model, const HeapOptions& options);
  void dropBodies(const HeapOptions& options);
  void placeBodies(const HeapOptions& options);

  std::uint32_t bodiesPerSide_;  // of one layer of the column
  Pit pit_;
};

}  // namespace cairn::scenes

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>

#include "scenes/truth/placed_body.h"
#include "scenes/world/world.h"

namespace cairn::scenes {

/// Bodies of one model and one shape that fall on some ground. What the ground is, and when a body is lost, is said by
/// whoever derives from it.
class BodyScene {
 public:
  virtual ~BodyScene() = default;
  BodyScene(const BodyScene&) = delete;
  BodyScene& operator=(const BodyScene&) = delete;

  StepRecord step() { return world_->step(); }
  const World& world() const { return *world_; }
  const Model& model() const { return model_; }

  std::uint32_t stepsWithoutBudget() const { return stepsWithoutBudget_; }
  /// From now on the world's budget holds.
  Status beginBudget() { return world_->setBudget(budget_); }

  /// Bodies that have left the scene, or whose place is no longer a number.
  virtual std::uint32_t countLost() const = 0;

  /// The ground is made of this many static bodies, numbered by `World::staticNumber`.
  virtual std::size_t groundParts() const = 0;
  /// Room between a body and a part of the ground, metres; negative: how deep one is in the other. `surface` is the
  /// model's.
  virtual double clearance(const PlacedBody& body, const ExactSurface& surface, std::size_t part) const = 0;

 protected:
  BodyScene(const Model& model, const bullet::StepBudget& budget, std::uint32_t stepsWithoutBudget)
      : model_(model), budget_(budget), stepsWithoutBudget_(stepsWithoutBudget) {}

  /// Makes shape and world, without bodies. Fails for what the shape or the dispatcher refuses.
  Status begin(const WorldOptions& world, const ShapeOptions& shape);
  /// Takes the world down. For destructors of what derives: the world must go before the ground it refers to.
  void end() { world_.reset(); }
  btCollisionShape& shape() { return shape_->bullet(); }
  World& ownWorld() { return *world_; }

 private:
  Model model_;
  bullet::StepBudget budget_;
  std::uint32_t stepsWithoutBudget_;
  std::unique_ptr<BodyShape> shape_;
  std::unique_ptr<World> world_;  // after the shape, so that it goes first: it refers to it
};

}  // namespace cairn::scenes

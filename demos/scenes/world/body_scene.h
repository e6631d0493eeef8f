// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>

#include "scenes/truth/placed_body.h"
#include "scenes/world/world.h"

namespace cairn::scenes {

/// Bodies of one model and one shape that fall on some ground. Derived classes define the ground and decide when a body
/// is lost.
class BodyScene {
 public:
  virtual ~BodyScene() = default;
  BodyScene(const BodyScene&) = delete;
  BodyScene& operator=(const BodyScene&) = delete;

  StepRecord step() { return world_->step(); }
  const World& world() const { return *world_; }
  const Model& model() const { return model_; }

  std::uint32_t stepsWithoutBudget() const { return stepsWithoutBudget_; }
  /// Applies the world's budget from now on.
  Status beginBudget() { return world_->setBudget(budget_); }

  /// Number of bodies that have left the scene or whose place is NaN.
  virtual std::uint32_t countLost() const = 0;

  /// Number of static bodies that form the ground, numbered by `World::staticNumber`.
  virtual std::size_t groundParts() const = 0;
  /// Returns the distance between a body and a part of the ground, metres; negative for a penetration. `surface` is the
  /// model's.
  virtual double clearance(const PlacedBody& body, const ExactSurface& surface, std::size_t part) const = 0;

 protected:
  BodyScene(const Model& model, const bullet::StepBudget& budget, std::uint32_t stepsWithoutBudget)
      : model_(model), budget_(budget), stepsWithoutBudget_(stepsWithoutBudget) {}

  /// Makes shape and world, without bodies. Fails when the shape or the dispatcher refuses its options.
  Status begin(const WorldOptions& world, const ShapeOptions& shape);
  /// Destroys the world. Destructors of derived classes call it, because the world must end before the ground it refers
  /// to.
  void end() { world_.reset(); }
  btCollisionShape& shape() { return shape_->bullet(); }
  World& ownWorld() { return *world_; }

 private:
  Model model_;
  bullet::StepBudget budget_;
  std::uint32_t stepsWithoutBudget_;
  std::unique_ptr<BodyShape> shape_;
  std::unique_ptr<World> world_;  // declared after the shape, so that it is destroyed first: it refers to the shape
};

}  // namespace cairn::scenes

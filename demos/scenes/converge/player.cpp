// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenes/converge/player.h"

#include <utility>

namespace cairn::scenes {
namespace {

/// Plays any Bullet shape, in a world without gravity or ground.
class BulletPlayer final : public Player {
 public:
  BulletPlayer(const Model& model, std::uint32_t bodies, const WorldOptions& options, std::unique_ptr<BodyShape> shape)
      : inertia_(model.inertia), bodies_(bodies), options_(options), shape_(std::move(shape)) {}

  Status begin() override {
    world_.reset();
    auto world = World::create(options_);
    if (!world) return world.error();
    world_ = std::move(world).value();
    for (std::uint32_t i = 0; i < bodies_; ++i)
      world_->addBody(shape_->bullet(), btTransform::getIdentity(), 1, inertia_);
    return {};
  }

  StepRecord show(std::span<const BodyMotion> motions) override { return world_->show(motions); }
  std::vector<ReportedContact> contacts() const override { return world_->contacts(); }

 private:
  btVector3 inertia_;
  std::uint32_t bodies_;
  WorldOptions options_;
  std::unique_ptr<BodyShape> shape_;
  std::unique_ptr<World> world_;  // declared last, so that it is destroyed first: it refers to the shape
};

}  // namespace

Result<std::unique_ptr<Player>> makePlayer(const Model& model, std::uint32_t bodies, const WorldOptions& world,
                                           const ShapeOptions& shape) {
  if (world.shape == ShapeKind::fcl) return makeFclPlayer(model);
  auto body = BodyShape::create(world.shape, model, shape);
  if (!body) return body.error();
  WorldOptions options = world;
  options.gravity = 0;
  options.sleeping = false;
  auto player = std::make_unique<BulletPlayer>(model, bodies, options, std::move(body).value());
  if (Status status = player->begin(); !status) return status.error();
  return Result<std::unique_ptr<Player>>(std::move(player));
}

}  // namespace cairn::scenes

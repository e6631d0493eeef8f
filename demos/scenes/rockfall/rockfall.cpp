// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenes/rockfall/rockfall.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "scenes/bodies/model.h"
#include "scenes/figures/random.h"

namespace cairn::scenes {
namespace {

constexpr double kDensity = 2600;                  // kg/m^3, limestone
constexpr double kSmallest = 0.4, kLargest = 1.1;  // metres across
constexpr btScalar kRestitution = btScalar(0.55);  // Bullet multiplies the two bodies': about 0.3 for rock on rock

/// Rocks start on a lattice above the shelf, wide enough for the largest to be apart at any orientation.
constexpr double kSpacing = 1.5;
constexpr std::uint32_t kAcross = 9, kAlong = 4;

Vec3d releasePoint(std::uint32_t number) {
  const std::uint32_t across = number % kAcross, along = number / kAcross % kAlong, layer = number / (kAcross * kAlong);
  return {1.5 + kSpacing * along, kSpacing * (across - (kAcross - 1) / 2.0),
          Slope::kShelfHeight + 1.5 + kSpacing * layer};
}

}  // namespace

Rockfall::Rockfall(const RockfallOptions& options) : slope_(options.seed) {}

Result<std::unique_ptr<Rockfall>> Rockfall::create(std::span<const std::shared_ptr<const SphereTree>> trees,
                                                   const RockfallOptions& options) {
  assert(!trees.empty());
  auto scene = std::unique_ptr<Rockfall>(new Rockfall(options));
  WorldOptions worldOptions;
  worldOptions.budget = options.budget;
  worldOptions.timeStep = 1.0 / kStepsPerSecond;
  auto world = World::create(worldOptions);
  if (!world) return world.error();
  scene->world_ = std::move(world).value();
  btRigidBody& ground =
      scene->world_->addBody(scene->slope_.shape(), btTransform::getIdentity(), 0, btVector3(0, 0, 0));
  ground.setRestitution(kRestitution);
  for (std::uint32_t i = 0; i < options.rocks; ++i)
    if (const Status status = scene->addRock(i, trees[i % trees.size()], options.seed); !status) return status.error();
  return scene;
}

Status Rockfall::addRock(std::uint32_t number, std::shared_ptr<const SphereTree> tree, std::uint64_t seed) {
  Random random(seed, number + 1);  // stream 0 is the slope's
  const double size = random.uniform(kSmallest, kLargest);
  const Model model = makeModel(tree, size);
  const double mass = kDensity * tree->mass().volume * model.scale * model.scale * model.scale;
  auto shape = bullet::SphereTreeShape::create(std::move(tree), bullet::BodyFrame::principalAxes,
                                               static_cast<btScalar>(model.scale));
  if (!shape) return shape.error();
  shapes_.push_back(std::move(shape).value());
  const Vec3d place = releasePoint(number) + random.direction() * 0.1;
  btRigidBody& body = world_->addBody(*shapes_.back(), btTransform(random.rotation(), toBullet(place)),
                                      static_cast<btScalar>(mass), model.inertia * static_cast<btScalar>(mass));
  body.setRestitution(kRestitution);
  return {};
}

std::uint32_t Rockfall::countLost() const {
  return static_cast<std::uint32_t>(std::ranges::count_if(world_->bodies(), [&](const btRigidBody* body) {
    const Vec3d center = fromBullet(body->getWorldTransform().getOrigin());
    return !isFinite(center) || !slope_.covers(center.x, center.y) || center.z < slope_.heightAt(center.x, center.y);
  }));
}

}  // namespace cairn::scenes

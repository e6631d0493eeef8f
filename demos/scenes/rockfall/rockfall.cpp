// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenes/rockfall/rockfall.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "scenes/figures/random.h"

namespace cairn::scenes {
namespace {

constexpr btScalar kRestitution = btScalar(0.55);  // Bullet multiplies the two bodies': about 0.3 for rock on rock

/// Rocks start on a lattice above the shelf, wide enough to separate them at any orientation. Its spacing is this,
/// metres, and larger for rocks more than `kRoomiest` across.
constexpr double kSpacing = 1.5, kRoomiest = 1.3;
/// Largest displacement of a rock from its lattice point, as a fraction of the spacing.
constexpr double kShake = 1.0 / 15;
constexpr std::uint32_t kAcross = 9, kAlong = 4;

Vec3d releasePoint(std::uint32_t number, double apart) {
  const std::uint32_t across = number % kAcross, along = number / kAcross % kAlong, layer = number / (kAcross * kAlong);
  return {1.5 + apart * along, apart * (across - (kAcross - 1) / 2.0), Slope::kShelfHeight + apart * (1 + layer)};
}

}  // namespace

Rockfall::Rockfall(const Model& model, const RockfallOptions& options)
    : BodyScene(model, options.world.budget, options.stepsWithoutBudget), slope_(options.seed) {}

Rockfall::~Rockfall() {
  end();
}

Result<std::unique_ptr<Rockfall>> Rockfall::create(const Model& model, const RockfallOptions& options) {
  auto scene = std::unique_ptr<Rockfall>(new Rockfall(model, options));
  WorldOptions world = options.world;
  world.timeStep = 1.0 / kStepsPerSecond;
  if (const Status begun = scene->begin(world, options.shape); !begun) return begun.error();
  btRigidBody& ground =
      scene->ownWorld().addBody(scene->slope_.shape(), btTransform::getIdentity(), 0, btVector3(0, 0, 0));
  ground.setRestitution(kRestitution);
  for (std::uint32_t i = 0; i < options.rocks; ++i) scene->addRock(i, options.seed);
  return scene;
}

void Rockfall::addRock(std::uint32_t number, std::uint64_t seed) {
  Random random(seed, number + 1);  // stream 0 is the slope's
  const double apart = kSpacing * std::max(1.0, 2 * model().reach / kRoomiest);
  const Vec3d place = releasePoint(number, apart) + random.direction() * (kShake * apart);
  btRigidBody& body = ownWorld().addBody(shape(), btTransform(random.rotation(), toBullet(place)), 1, model().inertia);
  body.setRestitution(kRestitution);
}

/// Measures corners of the rock against the ground's triangles, and corners of the ground against the rock. Between two
/// edges the clearance may be too large, or the depth too small.
double Rockfall::clearance(const PlacedBody& body, const ExactSurface& surface, std::size_t) const {
  double deepest = 0, room = std::numeric_limits<double>::infinity();
  const auto look = [&](double signedDistance) {
    deepest = std::max(deepest, -signedDistance);
    room = std::min(room, std::abs(signedDistance));
  };
  for (const Vec3d& p : body.vertices)
    if (slope_.covers(p.x, p.y)) look(slope_.signedDistance(p));
  const Placement bodyFromWorld = body.worldFromBody.inverse();
  for (const Vec3d& p : slope_.cornersIn(body.box.lower, body.box.upper)) look(-surface.depth(bodyFromWorld * p));
  return deepest > 0 ? -deepest : room;
}

std::uint32_t Rockfall::countLost() const {
  return static_cast<std::uint32_t>(std::ranges::count_if(world().bodies(), [&](const btRigidBody* body) {
    const Vec3d center = fromBullet(body->getWorldTransform().getOrigin());
    return !isFinite(center) || !slope_.covers(center.x, center.y) || center.z < slope_.heightAt(center.x, center.y);
  }));
}

}  // namespace cairn::scenes

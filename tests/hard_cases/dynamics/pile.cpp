// SPDX-License-Identifier: GPL-3.0-or-later
#include "pile.h"

#include <algorithm>
#include <cmath>

#include "scenes/figures/random.h"
#include "scenes/world/world.h"

namespace cairn::hard {

double kineticEnergyOf(const btRigidBody& body) {
  return scenes::kineticEnergy(body);
}

Pile::Pile(const test::TriedBody& tried, double size, const PileOptions& options)
    : timeStep_(options.timeStep), size_(size) {
  constexpr double kRoom = 1.05;  // no two bodies of the size as diameter touch
  const int perSide = std::max(2, int(std::lround(std::cbrt(options.bodies / 3.0))));
  const double spacing = kRoom * size;
  halfWidth_ = spacing * perSide / 2;
  world_.world.getSolverInfo().m_numIterations = options.iterations;
  if (options.inTwoDirections) world_.resist(test::Resisted::both);
  planes_.push_back(&world_.addGround());
  for (const btVector3& n : {btVector3(1, 0, 0), btVector3(-1, 0, 0), btVector3(0, 1, 0), btVector3(0, -1, 0)})
    planes_.push_back(
        &world_.add(std::make_shared<btStaticPlaneShape>(n, btScalar(-halfWidth_)), 0, btVector3(0, 0, 0)));
  for (int i = 0; i < options.bodies; ++i) {
    scenes::Random random(options.seed, std::uint64_t(i));
    const int inLayer = i % (perSide * perSide), layer = i / (perSide * perSide);
    const btVector3 place(btScalar(inLayer % perSide + 0.5 - perSide / 2.0),
                          btScalar(inLayer / perSide + 0.5 - perSide / 2.0), btScalar(layer + 0.5));
    const btTransform at(random.rotation(), place * btScalar(spacing));
    bodies_.push_back(&world_.addTried(tried, at, btScalar(options.friction)));
    if (options.doSleep) bodies_.back()->forceActivationState(ACTIVE_TAG);
  }
}

void Pile::step() {
  world_.world.stepSimulation(btScalar(timeStep_), 0);
}

double Pile::kineticEnergy() const {
  double sum = 0;
  for (const btRigidBody* body : bodies_) sum += kineticEnergyOf(*body);
  return sum;
}

double Pile::energy() const {
  double sum = kineticEnergy();
  for (const btRigidBody* body : bodies_) sum += kGravity * double(body->getWorldTransform().getOrigin().z());
  return sum;
}

double Pile::greatestSpeed() const {
  double greatest = 0;
  for (const btRigidBody* body : bodies_)
    greatest = test::greatest(greatest, double(body->getLinearVelocity().length()));
  return greatest;
}

int Pile::countInsane() const {
  return int(std::ranges::count_if(bodies_, [](const btRigidBody* body) { return !test::isSane(*body); }));
}

int Pile::countLost() const {
  return int(std::ranges::count_if(bodies_, [&](const btRigidBody* body) {
    const btVector3& p = body->getWorldTransform().getOrigin();
    const double outermost = halfWidth_ + size_ / 2;
    return !(double(p.z()) > -size_ / 2 && std::abs(double(p.x())) < outermost && std::abs(double(p.y())) < outermost);
  }));
}

}  // namespace cairn::hard

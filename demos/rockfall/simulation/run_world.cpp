// SPDX-License-Identifier: GPL-3.0-or-later
#include "rockfall/simulation/run_world.h"

#include <utility>

namespace cairn::rockfall {

void RunWorld::Dispatcher::dispatchAllCollisionPairs(btOverlappingPairCache* pairs, const btDispatcherInfo& info,
                                                     btDispatcher* dispatcher) {
  bullet::Dispatcher<>::dispatchAllCollisionPairs(pairs, info, dispatcher);
  effects->afterCollision(*this);
}

Result<std::unique_ptr<RunWorld>> RunWorld::create(const Scene& scene, std::uint64_t run) {
  auto world = std::unique_ptr<RunWorld>(new RunWorld(scene));
  if (const Status prepared = world->prepare(run); !prepared) return prepared.error();
  return world;
}

RunWorld::RunWorld(const Scene& scene)
    : scene_(scene), dispatcher_(&configuration_), world_(&dispatcher_, &broadphase_, &solver_, &configuration_) {
  world_.setGravity({0, 0, -static_cast<btScalar>(scene.description.gravityMPerS2)});
}

Status RunWorld::prepare(std::uint64_t run) {
  const BudgetSection& budget = scene_.description.budget;
  bullet::StepBudget stepBudget;
  if (budget.operations) stepBudget.operations = static_cast<std::int64_t>(*budget.operations);
  stepBudget.microseconds = budget.microseconds;
  if (const Status set = dispatcher_.setBudget(stepBudget); !set) return set;
  auto effects = makeEffects(scene_, world_, run);
  if (!effects) return effects.error();
  effects_ = std::move(effects).value();
  dispatcher_.effects = effects_.get();
  addGround();
  return {};
}

void RunWorld::addGround() {
  btRigidBody::btRigidBodyConstructionInfo info(0, nullptr, &scene_.ground->shape());
  info.m_startWorldTransform = scene_.ground->place();
  bodies_.push_back(std::make_unique<btRigidBody>(info));
  bodies_.back()->setUserIndex(-1);
  bodies_.back()->setUserIndex2(-1);
  effects_->prepare(*bodies_.back());
  world_.addRigidBody(bodies_.back().get());
}

RunWorld::~RunWorld() {
  for (const auto& body : bodies_) retire(*body);
}

Result<btRigidBody*> RunWorld::addRock(const ReleasedRock& rock, int number) {
  const RockShape& kind = scene_.stock.groups[rock.group][rock.variant];
  auto shape = bullet::SphereTreeShape::create(kind.tree, bullet::BodyFrame::principalAxes,
                                               static_cast<btScalar>(kind.scale * rock.sieveM));
  if (!shape) return shape.error();
  shapes_.push_back(std::move(shape).value());
  btVector3 inertia;
  shapes_.back()->calculateLocalInertia(static_cast<btScalar>(rock.massKg), inertia);
  btRigidBody::btRigidBodyConstructionInfo info(static_cast<btScalar>(rock.massKg), nullptr, shapes_.back().get(),
                                                inertia);
  info.m_startWorldTransform = rock.pose;
  bodies_.push_back(std::make_unique<btRigidBody>(info));
  btRigidBody& body = *bodies_.back();
  body.setUserIndex(number);
  body.setUserIndex2(static_cast<int>(scene_.description.rocks[rock.group].material));
  body.setLinearVelocity(rock.velocity);
  effects_->prepare(body);
  world_.addRigidBody(&body);
  return &body;
}

void RunWorld::retire(btRigidBody& rock) {
  if (rock.isInWorld()) world_.removeRigidBody(&rock);
}

void RunWorld::step() {
  const auto step = static_cast<btScalar>(scene_.description.stepS);
  world_.stepSimulation(step, 1, step);
}

}  // namespace cairn::rockfall

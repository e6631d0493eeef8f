// SPDX-License-Identifier: GPL-3.0-or-later
#include "rockfall/simulation/run_world.h"

#include <utility>

namespace cairn::rockfall {
namespace {

/// The collision group of rocks that meet the ground only: one that Bullet does not use itself.
constexpr int kAlone = 1 << 6;

}  // namespace

Result<std::unique_ptr<RunWorld>> RunWorld::create(const Scene& scene, std::uint64_t run) {
  auto world = std::unique_ptr<RunWorld>(new RunWorld(scene));
  if (const Status prepared = world->prepare(run); !prepared) return prepared.error();
  return world;
}

RunWorld::RunWorld(const Scene& scene)
    : scene_(scene), dispatcher_(&configuration_), world_(&dispatcher_, &broadphase_, &solver_, &configuration_) {
  world_.setForceUpdateAllAabbs(false);  // sleeping bodies keep their boxes
  world_.setGravity({0, 0, -static_cast<btScalar>(scene.description.gravityMPerS2)});
}

Status RunWorld::prepare(std::uint64_t run) {
  const BudgetSection& budget = scene_.description.budget;
  bullet::StepBudget stepBudget;
  if (budget.operations) stepBudget.operations = static_cast<std::int64_t>(*budget.operations);
  stepBudget.microseconds = budget.microseconds;
  if (const Status set = dispatcher_.setBudget(stepBudget); !set) return set;
  auto effects = RunEffects::create(scene_, world_, run);
  if (!effects) return effects.error();
  effects_ = std::move(effects).value();
  addGround();
  return {};
}

void RunWorld::addGround() {
  btRigidBody::btRigidBodyConstructionInfo info(0, nullptr, &scene_.ground->shape());
  info.m_startWorldTransform = scene_.ground->place();
  bodies_.push_back(std::make_unique<btRigidBody>(info));
  bodies_.back()->setUserIndex(-1);
  bodies_.back()->setUserIndex2(-1);
  RunEffects::prepare(*bodies_.back());
  world_.addRigidBody(bodies_.back().get());
  effects_->addGround(*bodies_.back());
}

RunWorld::~RunWorld() {
  effects_.reset();  // while its bodies still exist
  for (const auto& body : bodies_)
    if (body->isInWorld()) world_.removeRigidBody(body.get());
}

btRigidBody& RunWorld::addBody(btCollisionShape& shape, btScalar mass, const btVector3& inertia,
                               const btTransform& pose, bool meetsRocks) {
  btRigidBody::btRigidBodyConstructionInfo info(mass, nullptr, &shape, inertia);
  info.m_startWorldTransform = pose;
  bodies_.push_back(std::make_unique<btRigidBody>(info));
  RunEffects::prepare(*bodies_.back());
  if (meetsRocks)
    world_.addRigidBody(bodies_.back().get());
  else
    world_.addRigidBody(bodies_.back().get(), kAlone, btBroadphaseProxy::StaticFilter);
  return *bodies_.back();
}

// Each rock is over the ground; in dense groups one in two meets another at a time. Without a time limit, a missing
// reservation does no harm.
void RunWorld::expectRocks(std::size_t rocks) {
  if (!scene_.description.budget.microseconds) return;
  dispatcher_.expectPairs({.trees = rocks / 2, .terrains = rocks});
}

Result<btRigidBody*> RunWorld::addRock(const ReleasedRock& rock, int number) {
  const RockGroup& group = scene_.description.rocks[rock.group];
  const RockShape& kind = scene_.stock.groups[rock.group][rock.variant];
  auto created = bullet::SphereTreeShape::create(kind.tree, bullet::BodyFrame::principalAxes,
                                                 static_cast<btScalar>(kind.scale * rock.sieveM));
  if (!created) return created.error();
  const bullet::SphereTreeShape& shape = *created.value();
  const auto mass = static_cast<btScalar>(rock.massKg);
  btVector3 inertia;
  shape.calculateLocalInertia(mass, inertia);
  shapes_.push_back(std::move(created).value());
  btRigidBody& body = addBody(*shapes_.back(), mass, inertia, rock.pose, group.meetsRocks);
  body.setUserIndex(number);
  body.setUserIndex2(static_cast<int>(group.material));
  body.setLinearVelocity(rock.velocity);
  const std::uint32_t id =
      effects_->addRock(body, group.material, kind.volume * rock.sieveM * rock.sieveM * rock.sieveM);
  if (effects::Fragmentation* fragmentation = effects_->fragmentation())
    fragmentation->setBreakable(
        id, effects::FragmentPart::whole(kind.fragments, shape, static_cast<btScalar>(group.densityKgPerM3)));
  return &body;
}

std::pair<btRigidBody*, std::uint32_t> RunWorld::addPiece(effects::FragmentBody piece, MaterialId material,
                                                          std::uint32_t generation, bool meetsRocks) {
  btRigidBody& body = addBody(piece.shape(), piece.mass, piece.inertia, piece.pose, meetsRocks);
  for (auto& shape : piece.shapes) shapes_.push_back(std::move(shape));
  body.setUserIndex2(static_cast<int>(material));
  body.setLinearVelocity(piece.linearVelocity);
  body.setAngularVelocity(piece.angularVelocity);
  const std::uint32_t id = effects_->addRock(body, material, static_cast<double>(piece.volume));
  effects_->fragmentation()->setBreakable(id, std::move(piece.part), generation);
  return {&body, id};
}

Result<std::vector<RunWorld::Broken>> RunWorld::breakRocks() {
  std::vector<Broken> all;
  effects::Fragmentation* fragmentation = effects_->fragmentation();
  if (fragmentation == nullptr) return all;
  for (const effects::Break& broken : fragmentation->takeBreaks()) {
    auto pieces = effects::breakOff(*broken.body, *fragmentation->partOf(broken.bodyId), broken.piece);
    if (!pieces) return pieces.error();
    const auto material = static_cast<MaterialId>(broken.body->getUserIndex2());
    Broken& rock = all.emplace_back(Broken{broken.body->getUserIndex(), {}});
    const bool meetsRocks = broken.body->getBroadphaseProxy()->m_collisionFilterGroup != kAlone;
    retire(*broken.body);
    std::vector<std::uint32_t> siblings;
    for (effects::FragmentBody& piece : pieces.value()) {
      const auto [body, id] = addPiece(std::move(piece), material, broken.generation + 1, meetsRocks);
      rock.pieces.push_back(body);
      siblings.push_back(id);
    }
    fragmentation->setSiblings(siblings);
  }
  return all;
}

void RunWorld::retire(btRigidBody& rock) {
  if (!rock.isInWorld()) return;
  effects_->removeRock(rock);
  world_.removeRigidBody(&rock);
}

void RunWorld::step() {
  const auto step = static_cast<btScalar>(scene_.description.stepS);
  world_.stepSimulation(step, 1, step);
}

}  // namespace cairn::rockfall

// SPDX-License-Identifier: GPL-3.0-or-later
#include "rockfall/simulation/run_effects.h"

#include <algorithm>
#include <utility>

#include "rockfall/simulation/effect_factory.h"

namespace cairn::rockfall {

std::optional<btScalar> RunEffects::GroundBelow::at(btScalar x, btScalar y) const {
  const MapPoint point{static_cast<double>(x), static_cast<double>(y)};
  if (!ground_.covers(point)) return std::nullopt;
  return static_cast<btScalar>(ground_.heightAt(point));
}

effects::MaterialId RunEffects::Zones::at(const btVector3& place) const {
  return static_cast<effects::MaterialId>(
      ground_.materialAt({static_cast<double>(place.x()), static_cast<double>(place.y())}));
}

Result<std::unique_ptr<RunEffects>> RunEffects::create(const Scene& scene, btDiscreteDynamicsWorld& world,
                                                       std::uint64_t run) {
  auto all = std::unique_ptr<RunEffects>(new RunEffects(scene));
  auto set = effects::EffectSet::create(world);
  if (!set) return set.error();
  all->set_ = std::move(set).value();
  // Otherwise Bullet computes every body's box twice, for a prediction that these bodies never use.
  world.getDispatchInfo().m_useContinuous =
      std::ranges::any_of(scene.description.effects,
                          [](const EffectOptions& options) { return std::holds_alternative<CcdOptions>(options); });
  for (std::size_t i = 0; i < scene.description.effects.size(); ++i) {
    auto effect = makeEffect(scene, i, run, all->below_);
    if (auto* fragmentation = dynamic_cast<effects::Fragmentation*>(effect.get())) all->fragmentation_ = fragmentation;
    if (const Status able = all->set_->canAct(*effect); !able) return able.error();
    all->set_->add(std::move(effect));
  }
  return all;
}

void RunEffects::prepare(btRigidBody& body) {
  body.setFlags(0);  // Bullet would turn gyroscopic torque on by default
  body.setFriction(0);
  body.setRestitution(0);
  body.forceActivationState(DISABLE_DEACTIVATION);
}

std::uint32_t RunEffects::addRock(btRigidBody& rock, MaterialId material, double volume) {
  return set_->addBody(
      rock, {.material = static_cast<effects::MaterialId>(material), .volume = static_cast<btScalar>(volume)});
}

void RunEffects::addGround(const btRigidBody& ground) {
  set_->describe(ground, {.map = &zones_});
}

std::vector<EffectReport> RunEffects::report() const {
  std::vector<EffectReport> reports;
  for (const effects::EffectReport& own : set_->report())
    reports.push_back({std::string(own.name), own.acted, own.elapsedMicroseconds});
  return reports;
}

std::vector<EffectRecord> RunEffects::records() const {
  std::vector<EffectRecord> records;
  for (const effects::EffectReport& own : set_->report())
    records.push_back(
        {std::string(own.name), own.acted, own.work.energyTaken, own.work.impulse, own.work.torqueImpulse});
  return records;
}

}  // namespace cairn::rockfall

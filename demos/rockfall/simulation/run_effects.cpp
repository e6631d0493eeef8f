// SPDX-License-Identifier: GPL-3.0-or-later
#include "rockfall/simulation/run_effects.h"

#include <fmt/format.h>

#include <cmath>

// Bullet keeps the time before sleep for all bodies of a process together.
extern btScalar gDeactivationTime;

namespace cairn::rockfall {
namespace {

/// What Bullet can do by itself: friction and constant restitution by pair of materials, and sleep.
class BulletEffects final : public RunEffects {
 public:
  explicit BulletEffects(const Scene& scene) : scene_(scene) {
    const auto& effects = scene.description.effects;
    if (const auto* friction = findEffect<FrictionOptions>(effects)) friction_ = &friction->coefficient;
    if (const auto* restitution = findEffect<RestitutionOptions>(effects)) restitution_ = &restitution->value;
    sleeping_ = findEffect<SleepingOptions>(effects);
    if (sleeping_) gDeactivationTime = static_cast<btScalar>(sleeping_->afterS);
  }

  void prepare(btRigidBody& body) override {
    body.setFlags(0);  // Bullet would turn gyroscopic torque on by default
    body.setFriction(0);
    // The narrow phase asks whether two bodies bounce at all, before their place is known.
    body.setRestitution(restitution_ ? static_cast<btScalar>(std::sqrt(restitution_->greatest())) : 0);
    if (!sleeping_) return body.forceActivationState(DISABLE_DEACTIVATION);
    body.setSleepingThresholds(static_cast<btScalar>(sleeping_->linearMPerS),
                               static_cast<btScalar>(sleeping_->angularRadPerS));
  }

  void afterCollision(btDispatcher& dispatcher) override {
    if (!friction_ && !restitution_) return;
    for (int i = 0; i < dispatcher.getNumManifolds(); ++i) {
      btPersistentManifold& manifold = *dispatcher.getManifoldByIndexInternal(i);
      for (int c = 0; c < manifold.getNumContacts(); ++c) setMaterial(manifold, manifold.getContactPoint(c));
    }
  }

  std::vector<EffectReport> report() const override {
    std::vector<EffectReport> reports;
    for (const EffectOptions& effect : scene_.description.effects) {
      const bool atContacts = nameOf(effect) != SleepingOptions::kName;
      reports.push_back({std::string(nameOf(effect)), atContacts ? contacts_ : 0, 0});
    }
    return reports;
  }

 private:
  MaterialId materialOf(const btCollisionObject& body, const btManifoldPoint& point) const {
    if (body.getUserIndex2() >= 0) return static_cast<MaterialId>(body.getUserIndex2());
    const btVector3& at = point.getPositionWorldOnB();
    return scene_.ground->materialAt({at.x(), at.y()});
  }

  void setMaterial(const btPersistentManifold& manifold, btManifoldPoint& point) {
    const MaterialId a = materialOf(*manifold.getBody0(), point), b = materialOf(*manifold.getBody1(), point);
    point.m_combinedFriction = friction_ ? static_cast<btScalar>(friction_->at(a, b)) : 0;
    point.m_combinedRestitution = restitution_ ? static_cast<btScalar>(restitution_->at(a, b)) : 0;
    ++contacts_;
  }

  const Scene& scene_;
  const PairTable* friction_ = nullptr;
  const PairTable* restitution_ = nullptr;
  const SleepingOptions* sleeping_ = nullptr;
  std::uint64_t contacts_ = 0;
};

bool bulletCan(const EffectOptions& effect) {
  if (const auto* restitution = std::get_if<RestitutionOptions>(&effect))
    return restitution->law == RestitutionLaw::constant;
  return std::holds_alternative<FrictionOptions>(effect) || std::holds_alternative<SleepingOptions>(effect);
}

}  // namespace

Status checkEffects(const Case& description) {
  for (std::size_t i = 0; i < description.effects.size(); ++i)
    if (!bulletCan(description.effects[i]))
      return Error{
          fmt::format("/effects/{}: the effect \"{}\"{} cannot be run by this version, which has friction, "
                      "constant restitution and sleeping",
                      i, nameOf(description.effects[i]),
                      std::holds_alternative<RestitutionOptions>(description.effects[i]) ? " of this law" : "")};
  return {};
}

Result<std::unique_ptr<RunEffects>> makeEffects(const Scene& scene, btDiscreteDynamicsWorld& /*world*/,
                                                std::uint64_t /*run*/) {
  if (const Status checked = checkEffects(scene.description); !checked) return checked.error();
  return std::unique_ptr<RunEffects>(std::make_unique<BulletEffects>(scene));
}

}  // namespace cairn::rockfall

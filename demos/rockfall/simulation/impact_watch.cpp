// SPDX-License-Identifier: GPL-3.0-or-later
#include "rockfall/simulation/impact_watch.h"

#include "scenes/bodies/model.h"
#include "scenes/world/world.h"

namespace cairn::rockfall {
namespace {

constexpr double kImpactSpeed = 0.5;  // m/s

}  // namespace

std::vector<ImpactWatch::Touch> ImpactWatch::touchesOf(const btCollisionDispatcher& dispatcher) const {
  std::vector<Touch> touches(touched_.size());
  const auto note = [&](const btCollisionObject& rock, const btCollisionObject& other, const btManifoldPoint& point) {
    if (rock.getUserIndex() < 0) return;
    Touch& touch = touches[static_cast<std::size_t>(rock.getUserIndex())];
    const auto impulse = static_cast<double>(point.getAppliedImpulse());
    touch.impulseNS += impulse;
    if (impulse <= touch.hardestNS) return;
    touch.hardestNS = impulse;
    touch.place = point.getPositionWorldOnB();
    touch.other = &other;
  };
  for (int i = 0; i < dispatcher.getNumManifolds(); ++i) {
    const btPersistentManifold& manifold =
        *const_cast<btCollisionDispatcher&>(dispatcher).getManifoldByIndexInternal(i);
    for (int c = 0; c < manifold.getNumContacts(); ++c) {
      note(*manifold.getBody0(), *manifold.getBody1(), manifold.getContactPoint(c));
      note(*manifold.getBody1(), *manifold.getBody0(), manifold.getContactPoint(c));
    }
  }
  return touches;
}

MaterialId ImpactWatch::materialOf(const Touch& touch) const {
  if (touch.other->getUserIndex2() >= 0) return static_cast<MaterialId>(touch.other->getUserIndex2());
  return scene_.ground->materialAt({touch.place.x(), touch.place.y()});
}

void ImpactWatch::lookAt(const btCollisionDispatcher& dispatcher, const std::vector<btRigidBody*>& rocks,
                         const RockWatch& watch, double timeS) {
  const std::vector<Touch> touches = touchesOf(dispatcher);
  for (std::uint32_t rock = 0; rock < touches.size(); ++rock) {
    const Touch& touch = touches[rock];
    const bool isNew = touch.hardestNS > 0 && !touched_[rock];
    touched_[rock] = touch.hardestNS > 0;
    RockRecord& record = result_.rocks[rock];
    if (!rocks[rock] || !isNew || touch.impulseNS < kImpactSpeed * record.massKg) continue;
    ++record.impacts;
    const auto& threshold = scene_.description.outputs.impactsAboveJ;
    const double before = watch.last(rock).energyJ;
    if (!threshold || before < *threshold) continue;
    result_.impacts.push_back({rock, touch.other->getUserIndex(), materialOf(touch), timeS,
                               scenes::fromBullet(touch.place), before, scenes::kineticEnergy(*rocks[rock]),
                               touch.impulseNS});
  }
}

}  // namespace cairn::rockfall

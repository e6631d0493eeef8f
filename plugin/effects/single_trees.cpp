// SPDX-License-Identifier: Zlib
#include "cairn/effects/single_trees.h"

#include <BulletDynamics/Dynamics/btRigidBody.h>

#include <algorithm>
#include <cmath>

#include "kinetic_energy.h"
#include "stem_grid.h"

namespace cairn::effects {
namespace {

// So many stems at once a body has room for from the beginning.
constexpr std::size_t kUsualStems = 8;

struct Hit {
  btVector3 normal;  // level, from the axis to the body
  btScalar offset;   // see `SingleTrees::shareOf`
};

btVector3 level(const btVector3& v) {
  return {v.x(), v.y(), 0};
}

// Where a ball first touches the stem on its way, seen from above; `reach` is the sum of both radii.
Hit hitOn(const btVector3& axis, const btRigidBody& body, btScalar reach) {
  const btVector3 from = level(body.getCenterOfMassPosition() - axis), velocity = level(body.getLinearVelocity());
  if (velocity.fuzzyZero()) return {from.fuzzyZero() ? btVector3(0, 0, 0) : from.normalized(), 0};
  const btVector3 direction = velocity.normalized();
  const btScalar aside = std::abs(direction.cross(from).z()), toNearest = -direction.dot(from);
  const btScalar within = std::sqrt(std::max(btScalar(0), reach * reach - aside * aside));
  const btVector3 touching = from + direction * std::max(btScalar(0), toNearest - within);
  return {touching.fuzzyZero() ? -direction : touching.normalized(), std::min(btScalar(1), aside / reach)};
}

// Takes energy of the motion towards the axis, and the rest of all motion.
void strike(btRigidBody& body, const btVector3& normal, btScalar loss) {
  const btScalar closing = std::max(btScalar(0), -body.getLinearVelocity().dot(normal));
  const btScalar ofClosing = std::min(loss, btScalar(0.5) * body.getMass() * closing * closing);
  const btScalar kept = std::sqrt(std::max(btScalar(0), closing * closing - 2 * ofClosing * body.getInvMass()));
  body.setLinearVelocity(body.getLinearVelocity() + normal * (closing - kept));
  if (loss > ofClosing) loseEnergy(body, loss - ofClosing);
}

}  // namespace

SingleTrees::SingleTrees(std::vector<Stem> stems, const GroundHeight& ground, const Options& options)
    : options_(options), stems_(std::make_unique<StemGrid>(stems, ground, options.height)) {
  touched_.reserve(kUsualStems);
}
SingleTrees::~SingleTrees() = default;

void SingleTrees::welcome(Body& body) {
  if (meeting_.size() <= body.id) meeting_.resize(body.id + 1);
  meeting_[body.id].reserve(kUsualStems);
}
void SingleTrees::dismiss(Body& body) {
  meeting_[body.id] = {};
}

std::size_t SingleTrees::standing() const {
  return stems_->size();
}

btScalar SingleTrees::mostEnergy(btScalar diameter, btScalar energyRatio) {
  return energyRatio * btScalar(38.7) * std::pow(100 * diameter, btScalar(2.31));
}

// The published fit is slightly below zero at the edge: there a stem takes nothing.
btScalar SingleTrees::shareOf(btScalar offset) {
  const btScalar power = std::pow(btScalar(10), btScalar(-8.007) * (btScalar(0.58) - offset));
  return std::max(btScalar(0), btScalar(-0.046) + btScalar(0.98 + 0.046) / (1 + power));
}

std::uint32_t SingleTrees::applyForces(std::span<Body* const> bodies, const Step& step) {
  if (!(options_.energyRatio > 0)) return 0;
  std::uint32_t acted = 0;
  for (const Body* known : bodies) {
    btRigidBody& body = *known->body;
    if (known->radius <= 0 || body.getLinearVelocity().fuzzyZero()) continue;
    const btVector3& place = body.getCenterOfMassPosition();
    touched_.clear();
    stems_->touchedBy(place, place + body.getLinearVelocity() * step.timeStep, known->radius, touched_);
    std::vector<std::uint32_t>& meeting = meeting_[known->id];
    for (const std::uint32_t stem : touched_) {
      if (std::ranges::find(meeting, stem) != meeting.end()) continue;
      const btScalar diameter = stems_->diameter(stem);
      const Hit hit = hitOn(stems_->axis(stem), body, known->radius + diameter / 2);
      const btScalar loss = shareOf(hit.offset) * mostEnergy(diameter, options_.energyRatio);
      if (!(loss > 0)) continue;
      strike(body, hit.normal, loss);
      ++acted;
    }
    meeting.assign(touched_.begin(), touched_.end());
  }
  return acted;
}

}  // namespace cairn::effects

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
      loseEnergy(body, mostEnergy(stems_->diameter(stem), options_.energyRatio));
      ++acted;
    }
    meeting.assign(touched_.begin(), touched_.end());
  }
  return acted;
}

}  // namespace cairn::effects

// SPDX-License-Identifier: Zlib
#include "cairn/effects/barrier.h"

#include <BulletDynamics/Dynamics/btRigidBody.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "ground_layer.h"
#include "kinetic_energy.h"

namespace cairn::effects {
namespace {

// Weight that came before the factors would move it for ever.
void hold(btRigidBody& body) {
  body.clearForces();
  body.setLinearVelocity(btVector3(0, 0, 0));
  body.setAngularVelocity(btVector3(0, 0, 0));
  body.setLinearFactor(btVector3(0, 0, 0));
  body.setAngularFactor(btVector3(0, 0, 0));
}

}  // namespace

Barrier::Barrier(std::vector<Segment> segments, const GroundHeight& ground, const Options& options)
    : segments_(std::move(segments)), ground_(ground), options_(options) {
  std::erase_if(segments_, [](const Segment& s) { return s.from.x == s.to.x && s.from.y == s.to.y; });
}

void Barrier::welcome(Body& body) {
  if (meeting_.size() <= body.id) meeting_.resize(body.id + 1);
}
void Barrier::dismiss(Body& body) {
  meeting_[body.id] = false;
}

bool Barrier::isTouched(const Segment& segment, const Body& body, btScalar timeStep) const {
  const btVector3& place = body.body->getCenterOfMassPosition();
  const btVector3& velocity = body.body->getLinearVelocity();
  const btVector3 along(segment.to.x - segment.from.x, segment.to.y - segment.from.y, 0);
  const btScalar length = along.length();
  btVector3 across(-along.y() / length, along.x() / length, 0);
  const btVector3 from(place.x() - segment.from.x, place.y() - segment.from.y, 0);
  if (from.dot(across) < 0) across = -across;  // towards the body
  const btScalar away = from.dot(across), closing = -velocity.dot(across);
  if (!(closing > 0) || away > body.radius + closing * timeStep) return false;
  const btScalar until = std::max(btScalar(0), away - body.radius) / closing;
  const btScalar share = (from + velocity * until).dot(along) / (length * length);
  if (share < 0 || share > 1) return false;
  return isInLayer(ground_, options_.height, place + velocity * until);
}

bool Barrier::isTouched(const Body& body, btScalar timeStep) const {
  return std::ranges::any_of(segments_, [&](const Segment& segment) { return isTouched(segment, body, timeStep); });
}

std::uint32_t Barrier::applyForces(std::span<Body* const> bodies, const Step& step) {
  if (!(options_.capacity > 0)) return 0;
  std::uint32_t acted = 0;
  for (const Body* known : bodies) {
    btRigidBody& body = *known->body;
    if (known->radius <= 0 || body.getLinearVelocity().fuzzyZero()) continue;
    const bool wasMeeting = meeting_[known->id];
    meeting_[known->id] = isTouched(*known, step.timeStep);
    if (wasMeeting || !meeting_[known->id]) continue;
    const bool isCaught = translationalEnergy(body) + rotationalEnergy(body) <= options_.capacity;
    isCaught ? hold(body) : loseEnergy(body, options_.capacity);
    ++acted;
  }
  return acted;
}

}  // namespace cairn::effects

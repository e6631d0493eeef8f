// SPDX-License-Identifier: Zlib
#pragma once

#include <BulletDynamics/Dynamics/btRigidBody.h>

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "cairn/effects/effect_set.h"

namespace cairn::effects {

/// Tells what was done to bodies between two looks at their velocities.
class MotionMeter {
 public:
  /// Notes how bodies move, none twice.
  void watch(std::span<Body* const> bodies) {
    notes_.clear();
    for (const Body* body : bodies) note(*body);
  }
  /// As well, of all bodies in these impacts.
  void watchStruck(std::span<const Impact> impacts) {
    notes_.clear();
    for (const Impact& impact : impacts)
      for (const Side& side : impact.sides)
        if (side.body != nullptr) note(*side.body);
    std::ranges::sort(notes_, {}, &Note::id);
    notes_.erase(std::ranges::unique(notes_, {}, &Note::id).begin(), notes_.end());
  }
  /// Since they were noted, or this was last asked.
  Work lookAgain() {
    Work work;
    for (Note& note : notes_)
      if (note.linear != note.body->getLinearVelocity() || note.angular != note.body->getAngularVelocity())
        work += change(note);
    return work;
  }

 private:
  struct Note {
    const btRigidBody* body;
    std::uint32_t id;
    btVector3 linear, angular;
  };

  void note(const Body& known) {
    notes_.push_back({known.body, known.id, known.body->getLinearVelocity(), known.body->getAngularVelocity()});
  }

  // Energies by the change's middle velocity, which loses no digits where it is small.
  static Work change(Note& note) {
    const btRigidBody& body = *note.body;
    const btVector3 &linear = body.getLinearVelocity(), &angular = body.getAngularVelocity();
    const btVector3 momentum = (linear - note.linear) * body.getMass();
    const btVector3 turn = momentOf(body, angular - note.angular);
    const Work work{-double((momentum.dot(linear + note.linear) + turn.dot(angular + note.angular)) / 2),
                    double(momentum.length()), double(turn.length())};
    note.linear = linear;
    note.angular = angular;
    return work;
  }
  // Angular momentum of a spin; axes that cannot turn have none.
  static btVector3 momentOf(const btRigidBody& body, const btVector3& spin) {
    const btMatrix3x3& axes = body.getCenterOfMassTransform().getBasis();
    const btVector3& inverse = body.getInvInertiaDiagLocal();
    btVector3 own = spin * axes;
    for (int axis = 0; axis < 3; ++axis) own[axis] = inverse[axis] > 0 ? own[axis] / inverse[axis] : btScalar(0);
    return axes * own;
  }

  std::vector<Note> notes_;
};

}  // namespace cairn::effects

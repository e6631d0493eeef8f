// SPDX-License-Identifier: Zlib
#pragma once

#include <BulletCollision/Gimpact/btGImpactCollisionAlgorithm.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "bullet_world.h"
#include "greatest.h"

namespace cairn::test {

/// A body of one kilogram as it collides, and what it resists to turning, which must not depend on the shape.
struct TriedBody {
  std::shared_ptr<btCollisionShape> shape;
  btVector3 inertia;
  btScalar margin = 0;  ///< by which it reaches beyond its surface: bodies are set down so much farther apart
};

/// Which directions of the surface Bullet's solver resists sliding along, at each contact.
enum class Resisted {
  sliding,  ///< one, that of the sliding as the step begins: Bullet's default
  fixed,    ///< one that depends on the contact's normal alone
  both      ///< two
};

/// A world in which bodies never sleep.
class StillWorld : public BulletWorld<> {
 public:
  StillWorld() { btGImpactCollisionAlgorithm::registerAlgorithm(&dispatcher); }

  void resist(Resisted resisted) {
    int& mode = world.getSolverInfo().m_solverMode;
    if (resisted == Resisted::fixed) mode |= SOLVER_DISABLE_VELOCITY_DEPENDENT_FRICTION_DIRECTION;
    if (resisted == Resisted::both) mode |= SOLVER_USE_2_FRICTION_DIRECTIONS;
  }

  btRigidBody& addTried(const TriedBody& tried, const btTransform& at, btScalar friction) {
    btRigidBody& body = add(tried.shape, 1, at.getOrigin(), at.getRotation());
    body.setMassProps(1, tried.inertia);
    body.updateInertiaTensor();
    body.setFriction(friction);
    body.setActivationState(DISABLE_DEACTIVATION);
    return body;
  }
};

inline constexpr int kStepsPerSecond = 60;

/// How a column of cubes stood, metres. Whoever has fallen has drifted far.
struct StackRun {
  double drift = 0;     ///< greatest horizontal way of any cube from its start
  double settling = 0;  ///< by which the top is lower than it was; negative where the cubes float
  double energy = 0;    ///< kinetic, of all cubes at the end, J
};

struct StackStart {
  int cubes = 10;
  int seconds = 20;
  int iterations = 30;
  btScalar edge = 1;
  /// Every cube begins aside of the axis by this, metres, turned about it cube by cube, and all of them by `turned`.
  btScalar aside = 0;
  btScalar turned = 0;  ///< radians
};

/// Cubes one on another on a plane, friction 0.5 everywhere.
inline StackRun runStack(const TriedBody& cube, const StackStart& start) {
  StillWorld w;
  w.world.getSolverInfo().m_numIterations = start.iterations;
  w.addGround();
  std::vector<btRigidBody*> bodies;
  std::vector<btVector3> places;
  for (int i = 0; i < start.cubes; ++i) {
    const btScalar angle = btScalar(2.4) * btScalar(i) + start.turned;
    const btScalar height = start.edge * (btScalar(i) + btScalar(0.5)) + cube.margin * (2 * btScalar(i) + 1);
    places.push_back({start.aside * std::cos(angle), start.aside * std::sin(angle), height});
    bodies.push_back(&w.addTried(cube, btTransform(btQuaternion::getIdentity(), places.back()), btScalar(0.5)));
  }
  w.step(start.seconds * kStepsPerSecond);
  StackRun run;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const btVector3 way = bodies[i]->getWorldTransform().getOrigin() - places[i];
    run.drift = greatest(run.drift, std::hypot(double(way.x()), double(way.y())));
    run.settling = -double(way.z());
    const btVector3 spin = bodies[i]->getWorldTransform().getBasis().transpose() * bodies[i]->getAngularVelocity();
    run.energy += 0.5 * double(bodies[i]->getLinearVelocity().length2() + (spin * spin).dot(cube.inertia));
  }
  return run;
}

/// Several stacks that differ in what should not matter: drifts are chaotic, and one says little.
inline std::vector<StackRun> runStacks(const TriedBody& cube, const StackStart& start, int count) {
  constexpr btScalar kTurn = btScalar(0.1);       // no two of a hundred put a cube in the same place
  constexpr btScalar kMinAside = btScalar(1e-6);  // to turn something where the cubes stand exactly on each other
  std::vector<StackRun> runs;
  for (int i = 0; i < count; ++i) {
    StackStart other = start;
    other.turned = start.turned + kTurn * btScalar(i);
    if (i > 0) other.aside = std::max(start.aside, kMinAside);
    runs.push_back(runStack(cube, other));
  }
  return runs;
}

/// Of one figure of several runs, the one that `fraction` of them do not exceed: 0.5 for the median. No number if any
/// is none.
inline double quantile(const std::vector<StackRun>& runs, double StackRun::*figure, double fraction) {
  std::vector<double> sorted;
  for (const StackRun& run : runs) sorted.push_back(run.*figure);
  if (std::ranges::any_of(sorted, [](double value) { return std::isnan(value); })) return NAN;
  std::ranges::sort(sorted);
  return sorted[static_cast<std::size_t>(std::lround(fraction * double(sorted.size() - 1)))];
}

/// The points of the manifolds between all bodies.
struct Touching {
  int contacts = 0;
  double penetration = 0;  ///< metres, the deepest contact's; 0 where all gap
};

inline Touching touching(btDispatcher& dispatcher) {
  Touching found;
  for (int i = 0; i < dispatcher.getNumManifolds(); ++i) {
    const btPersistentManifold& manifold = *dispatcher.getManifoldByIndexInternal(i);
    for (int j = 0; j < manifold.getNumContacts(); ++j) {
      ++found.contacts;
      found.penetration = std::max(found.penetration, -double(manifold.getContactPoint(j).getDistance()));
    }
  }
  return found;
}

/// How a body went down a slope.
struct SlopeRun {
  double acceleration = 0;  ///< m/s^2 downhill, between the two times
  double slip = 0;          ///< for what rolls: speed less spin times radius over speed, at the end
  double aside = 0;         ///< metres off the line of steepest descent at the end
  Touching touching;        ///< at the end
};

struct Slope {
  double degrees = 10;
  btScalar friction = 1;                                    ///< of the ground; bodies have 1
  std::shared_ptr<btCollisionShape> ground;                 ///< downhill is along its x
  btScalar top = 0;                                         ///< of the ground over its own origin
  btScalar height = 0;                                      ///< of the body's centre over the ground's top
  btScalar uphill = 0;                                      ///< metres by which it starts uphill of the ground's middle
  btQuaternion turned = btQuaternion::getIdentity();        ///< of the body against the ground
  double radius = 0;                                        ///< of what rolls
  int fromStep = 15, toStep = 75;                           ///< speeds are compared between these
  btQuaternion groundTurned = btQuaternion::getIdentity();  ///< of the ground's shape, so that its top is on top
  bool bodyFirst = false;                                   ///< whether the world meets the body before the ground
};

/// A slope, tilted about y, and a body set down on it at rest: nothing but gravity is along an axis of the world.
class SlopeScene {
 public:
  SlopeScene(const TriedBody& tried, const Slope& slope)
      : tilt_(btVector3(0, 1, 0), btScalar(slope.degrees * std::numbers::pi / 180)),
        start_(quatRotate(tilt_, btVector3(-slope.uphill, 0, slope.height + tried.margin))) {
    if (!slope.bodyFirst) addGround(slope);
    body_ = &world_.addTried(tried, btTransform(tilt_ * slope.turned, start_), 1);
    if (slope.bodyFirst) addGround(slope);
  }

  void step(int count) { world_.step(count); }
  const btRigidBody& body() const { return *body_; }
  /// Along an axis of the slope: 0 downhill, 1 aside, 2 off the ground.
  double along(const btVector3& v, int axis) const {
    btVector3 direction(0, 0, 0);
    direction[axis] = 1;
    return double(v.dot(quatRotate(tilt_, direction)));
  }
  /// Metres from where it was set down.
  btVector3 way() const { return body_->getWorldTransform().getOrigin() - start_; }
  /// Cosine of the angle by which it has tilted off the slope's normal.
  double upright(const Slope& slope) const {
    const btVector3 own = quatRotate((tilt_ * slope.turned).inverse(), quatRotate(tilt_, btVector3(0, 0, 1)));
    return along(body_->getWorldTransform().getBasis() * own, 2);
  }
  Touching touchingNow() { return touching(world_.dispatcher); }

 private:
  void addGround(const Slope& slope) {
    btRigidBody& ground =
        world_.add(slope.ground, 0, quatRotate(tilt_, btVector3(0, 0, -slope.top)), tilt_ * slope.groundTurned);
    ground.setFriction(slope.friction);
  }

  StillWorld world_;
  btQuaternion tilt_;
  btVector3 start_;
  btRigidBody* body_ = nullptr;
};

inline SlopeRun runSlope(const TriedBody& tried, const Slope& slope) {
  SlopeScene scene(tried, slope);
  scene.step(slope.fromStep);
  const double before = scene.along(scene.body().getLinearVelocity(), 0);
  scene.step(slope.toStep - slope.fromStep);
  const double after = scene.along(scene.body().getLinearVelocity(), 0);
  SlopeRun run;
  run.acceleration = (after - before) * kStepsPerSecond / (slope.toStep - slope.fromStep);
  run.slip = after == 0 ? 0 : 1 - scene.along(scene.body().getAngularVelocity(), 1) * slope.radius / after;
  run.aside = scene.along(scene.way(), 1);
  run.touching = scene.touchingNow();
  return run;
}

/// How a body lay on level ground.
struct RestRun {
  double height = 0;   ///< metres by which it lies higher than where surfaces (margins included) touch
  double speed = 0;    ///< m/s, the greatest of the last second
  double aside = 0;    ///< metres from where it was set down
  double upright = 0;  ///< cosine of its tilt
  Touching touching;
};

/// `slope.degrees` is taken for 0.
inline RestRun runRest(const TriedBody& tried, Slope slope, int seconds) {
  slope.degrees = 0;
  SlopeScene scene(tried, slope);
  scene.step((seconds - 1) * kStepsPerSecond);
  RestRun run;
  for (int i = 0; i < kStepsPerSecond; ++i) {
    scene.step(1);
    run.speed = std::max(run.speed, double(scene.body().getLinearVelocity().length()));
  }
  const btVector3 way = scene.way();
  run.height = double(way.z());
  run.aside = std::hypot(double(way.x()), double(way.y()));
  run.upright = scene.upright(slope);
  run.touching = scene.touchingNow();
  return run;
}

}  // namespace cairn::test

// SPDX-License-Identifier: Zlib
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "bullet_world.h"
#include "cairn/effects/effect_set.h"
#include "effect_world.h"
#include "every_effect.h"

namespace cairn::test {

/// A scene in which every effect has something to do: a box, balls, a sphere-tree and a spinning plate fall onto an
/// incline of soil, each by itself, and another tree is shot at a
/// thin wall.
class RockSlope {
 public:
  struct Options {
    bool hasSet = true;
    /// Bodies have no friction of their own, which effects would replace.
    bool isSmooth = false;
    /// Four more bodies that fly about far away and are not in the state. Nothing here touches more than one thing, or
    /// strangers would change the order in which Bullet solves its contacts (docs/determinism.md).
    bool hasStrangers = false;
  };

  explicit RockSlope(const Options& options) {
    if (options.hasSet) set = effects::EffectSet::create(bullet_.world).value();
    btRigidBody& ground =
        bullet_.add(std::make_shared<btStaticPlaneShape>(btVector3(-Incline::kRise, 0, 1).normalized(), btScalar(0)), 0,
                    btVector3(0, 0, 0));
    ground.setFriction(2);
    describe(ground, kSoil);
    describe(
        bullet_.add(std::make_shared<btBoxShape>(btVector3(5, btScalar(0.01), 5)), 0, btVector3(0, btScalar(11.85), 5)),
        kRock);
    addBodies();
    if (options.hasStrangers) addStrangers();
    if (options.isSmooth)
      for (int i = 0; i < bullet_.world.getNumCollisionObjects(); ++i)
        bullet_.world.getCollisionObjectArray()[i]->setFriction(0);
    throwAgain();
  }

  /// Puts all back to where they began.
  void throwAgain() {
    for (const Thrown& thrown : thrown_) {
      thrown.body->setWorldTransform(btTransform(btQuaternion::getIdentity(), thrown.place));
      thrown.body->setInterpolationWorldTransform(thrown.body->getWorldTransform());
      thrown.body->setLinearVelocity(thrown.velocity);
      thrown.body->setAngularVelocity(thrown.spin);
      thrown.body->activate(true);
    }
  }

  void run(int steps) {
    for (int i = 0; i < steps; ++i) bullet_.world.stepSimulation(kStep, 1, kStep);
  }
  /// Of all states on the way.
  std::string runAndHash(int steps) {
    StateHash hash;
    for (int i = 0; i < steps; ++i) {
      run(1);
      for (const Thrown& thrown : thrown_) {
        addState(hash, *thrown.body);
        for (int axis = 0; axis < 3; ++axis) hash.add(thrown.body->getAngularVelocity()[axis]);
      }
    }
    return hash.hex();
  }

  /// Of motion and of weight, J.
  double energy() const {
    double sum = 0;
    for (const Thrown& thrown : thrown_)
      sum += double(kineticEnergy(*thrown.body)) +
             double(thrown.body->getMass() * kGravity * thrown.body->getWorldTransform().getOrigin().z());
    return sum;
  }

 private:
  static constexpr btScalar kStep = btScalar(1) / 120;

  struct Thrown {
    btRigidBody* body;
    btVector3 place, velocity, spin;
  };

  void describe(const btRigidBody& object, effects::MaterialId material) {
    if (set) set->describe(object, {.material = material});
  }
  btRigidBody& add(std::shared_ptr<btCollisionShape> shape, btScalar mass, btScalar volume, const btVector3& place) {
    btRigidBody& body = bullet_.add(std::move(shape), mass, place);
    body.setActivationState(DISABLE_DEACTIVATION);
    if (set) set->addBody(body, {.material = kRock, .volume = volume});
    return body;
  }
  void throwNew(std::shared_ptr<btCollisionShape> shape, btScalar mass, btScalar volume, const btVector3& place,
                const btVector3& velocity, const btVector3& spin) {
    thrown_.push_back({&add(std::move(shape), mass, volume, place), place, velocity, spin});
  }
  void addBodies() {
    const btVector3 none(0, 0, 0);
    const btVector3 box(btScalar(0.5), btScalar(0.4), btScalar(0.3)),
        plate(btScalar(0.5), btScalar(0.3), btScalar(0.1));
    throwNew(std::make_shared<btBoxShape>(box), 2, btScalar(0.48), btVector3(0, 0, 2), none, none);
    throwNew(std::make_shared<btSphereShape>(btScalar(0.4)), 1, ballVolume(btScalar(0.4)), btVector3(0, -8, 3),
             btVector3(-3, 0, 0), none);
    throwNew(treeShape(plainTree(test::ball(0.4, 3))), 1, ballVolume(btScalar(0.4)), btVector3(0, 4, 3),
             btVector3(-2, 0, -1), none);
    throwNew(std::make_shared<btBoxShape>(plate), 1, btScalar(0.12), btVector3(-2, -4, 4), none,
             btVector3(btScalar(0.1), 6, btScalar(0.1)));
    // Steps over the wall, with what drags it too: in the wall it would be pressed from both sides.
    throwNew(treeShape(plainTree(test::ball(0.1, 2))), 1, ballVolume(btScalar(0.1)), btVector3(0, 7, 4),
             btVector3(0, 70, 0), none);
  }
  void addStrangers() {
    for (int i = 0; i < 4; ++i) {
      btRigidBody& body = add(std::make_shared<btBoxShape>(btVector3(1, btScalar(0.5), btScalar(0.25))), 3, 1,
                              btVector3(btScalar(3 * i), 2000, 500));
      body.setLinearVelocity(btVector3(0, 5, 0));
      body.setAngularVelocity(btVector3(0, 3, btScalar(0.1)));
    }
  }

  BulletWorld<> bullet_;
  std::vector<Thrown> thrown_;

 public:
  std::unique_ptr<effects::EffectSet> set;
};

}  // namespace cairn::test

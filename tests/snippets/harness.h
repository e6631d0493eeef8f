// SPDX-License-Identifier: Zlib
// The surroundings of a page's fragment: a world with a rock over the ground, ready to be stepped.
#pragma once

#include <btBulletDynamicsCommon.h>
#include <cairn/bullet/dispatcher.h>
#include <cairn/bullet/install.h>
#include <cairn/bullet/sphere_tree_shape.h>
#include <cairn/core/tree_file.h>
#include <cairn/core/version.h>
#include <cairn/effects/air_drag.h>
#include <cairn/effects/effect_set.h>

#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

struct Given {
  std::shared_ptr<const cairn::SphereTree> tree =
      std::make_shared<const cairn::SphereTree>(cairn::loadTree("rock.cairn").value());
  std::unique_ptr<cairn::bullet::SphereTreeShape> shape = cairn::bullet::SphereTreeShape::create(tree).value();
  btStaticPlaneShape plane{btVector3(0, 1, 0), 0};
  btRigidBody ground{0, nullptr, &plane};
  btRigidBody body{1, nullptr, shape.get(), btVector3(1, 1, 1)};
  btDefaultCollisionConfiguration configuration;
  cairn::bullet::Dispatcher<> dispatcher{&configuration};
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btDiscreteDynamicsWorld world{&dispatcher, &broadphase, &solver, &configuration};

  Given() {
    body.getWorldTransform().setOrigin(btVector3(0, 2, 0));
    world.addRigidBody(&ground);
    world.addRigidBody(&body);
  }
};

inline int fail(const std::string& why) {
  return std::fprintf(stderr, "fail: %s\n", why.c_str()), 1;
}

#define CAIRN_GIVEN_NAMES                                     \
  [[maybe_unused]] auto& tree = given.tree;                   \
  [[maybe_unused]] auto& shape = given.shape;                 \
  [[maybe_unused]] auto& ground = given.ground;               \
  [[maybe_unused]] auto& body = given.body;                   \
  [[maybe_unused]] auto& configuration = given.configuration; \
  [[maybe_unused]] auto& dispatcher = given.dispatcher;       \
  [[maybe_unused]] auto& broadphase = given.broadphase;       \
  [[maybe_unused]] auto& solver = given.solver;               \
  [[maybe_unused]] auto& world = given.world;

inline int runFragment(int argc, char** argv, const std::vector<int (*)(Given&)>& fragments) {
  const std::size_t number = argc == 2 ? std::strtoul(argv[1], nullptr, 10) : fragments.size();
  if (number >= fragments.size()) return fail("no such fragment");
  Given given;
  if (const int code = fragments[number](given); code != 0) return code;
  for (int step = 0; step < 10; ++step) given.world.stepSimulation(btScalar(1) / 60);
  return 0;
}

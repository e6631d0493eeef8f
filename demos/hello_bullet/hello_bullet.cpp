// SPDX-License-Identifier: Zlib
// Rocks fall on the ground: a plain Bullet program but for the lines marked "Cairn".
#include <btBulletDynamicsCommon.h>
#include <cairn/bullet/dispatcher.h>
#include <cairn/bullet/sphere_tree_shape.h>
#include <cairn/core/tree_file.h>

#include <cstdio>
#include <cstdlib>
#include <deque>

int main(int argc, char** argv) {
  if (argc != 2 && argc != 3) return std::fprintf(stderr, "usage: hello_bullet TREE.cairn [SECONDS]\n"), 2;
  const int seconds = argc == 3 ? std::atoi(argv[2]) : 10;
  auto tree = cairn::loadTree(argv[1]);  // Cairn
  if (!tree) return std::fprintf(stderr, "hello_bullet: %s.\n", tree.error().message.c_str()), 1;
  const auto shape = cairn::bullet::SphereTreeShape::create(std::move(tree).value());  // Cairn
  if (!shape) return std::fprintf(stderr, "hello_bullet: %s.\n", shape.error().message.c_str()), 1;
  const auto& rock = shape.value();

  // A world lets go of its bodies when it dies: they live longer, so they come first.
  btStaticPlaneShape plane({0, 1, 0}, 0);
  btRigidBody ground(0, nullptr, &plane);
  std::deque<btRigidBody> rocks;
  btDefaultCollisionConfiguration configuration;
  cairn::bullet::Dispatcher<> dispatcher(&configuration);                         // Cairn
  if (!dispatcher.setBudget({.operations = 4000, .microseconds = {}})) return 1;  // Cairn
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btDiscreteDynamicsWorld world(&dispatcher, &broadphase, &solver, &configuration);
  world.addRigidBody(&ground);
  btVector3 inertia;
  rock->calculateLocalInertia(1, inertia);
  for (int i = 0; i < 20; ++i) {
    btRigidBody& body = rocks.emplace_back(1, nullptr, rock.get(), inertia);
    body.setWorldTransform(btTransform(btQuaternion::getIdentity(), btVector3(0, btScalar(i + 1), 0) * rock->size()));
    world.addRigidBody(&body);
  }
  for (int second = 0; second <= seconds; ++second) {
    std::printf("%2d s: the last rock is %.2f up, %u contacts\n", second,
                double(rocks.back().getWorldTransform().getOrigin().y()), dispatcher.lastStep().contacts);
    for (int step = 0; step < 60; ++step) world.stepSimulation(btScalar(1) / 60);
  }
}

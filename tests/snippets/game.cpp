// SPDX-License-Identifier: Zlib
// The program that a page's build lines have to link: a world, a tree, and effects where the lines take these.
#include <btBulletDynamicsCommon.h>
#include <cairn/bullet/dispatcher.h>
#include <cairn/bullet/sphere_tree_shape.h>
#include <cairn/core/tree_file.h>
#include <cairn/core/version.h>

#include <cstdio>
#include <cstring>

#ifdef WITH_EFFECTS
#include <cairn/effects/effect_set.h>
#endif

int main() {
  auto tree = cairn::loadTree("rock.cairn");
  if (!tree) return std::fprintf(stderr, "game: %s\n", tree.error().message.c_str()), 1;
  const auto rock = cairn::bullet::SphereTreeShape::create(std::move(tree).value());
  if (!rock) return 1;
  btRigidBody body(1, nullptr, rock.value().get(), btVector3(1, 1, 1));
  btDefaultCollisionConfiguration configuration;
  cairn::bullet::Dispatcher<> dispatcher(&configuration);
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btDiscreteDynamicsWorld world(&dispatcher, &broadphase, &solver, &configuration);
  world.addRigidBody(&body);
#ifdef WITH_EFFECTS
  if (!cairn::effects::EffectSet::create(world)) return 1;
#endif
  world.stepSimulation(btScalar(1) / 60);
  return std::strcmp(cairn::version(), CAIRN_VERSION) == 0 ? 0 : 1;
}

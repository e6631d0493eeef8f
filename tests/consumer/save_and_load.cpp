// SPDX-License-Identifier: Zlib
// Saves a world with one sphere-tree and loads it again.
#include <btBulletDynamicsCommon.h>
#include <cairn/bullet/dispatcher.h>
#include <cairn/bullet/world_importer.h>
#include <cairn/core/tree_file.h>

#include <cstdio>

int main(int argc, char** argv) {
  if (argc != 2) return std::fprintf(stderr, "usage: save_and_load TREE\n"), 2;
  btDefaultCollisionConfiguration configuration;
  cairn::bullet::Dispatcher<> dispatcher(&configuration);
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btDiscreteDynamicsWorld world(&dispatcher, &broadphase, &solver, &configuration);
  const auto rock = cairn::bullet::SphereTreeShape::create(cairn::loadTree(argv[1]).value()).value();
  btRigidBody body(1, nullptr, rock.get());
  world.addRigidBody(&body);
  btDefaultSerializer serializer;
  world.serialize(&serializer);
  world.removeRigidBody(&body);

  const auto* first = reinterpret_cast<const std::byte*>(serializer.getBufferPointer());
  std::vector<std::byte> file(first, first + serializer.getCurrentBufferSize());
  cairn::bullet::WorldImporter importer(&world);
  if (const cairn::Status status = importer.loadFileFromMemory(file); !status)
    return std::fprintf(stderr, "%s\n", status.error().message.c_str()), 1;
  const auto* loaded = cairn::bullet::asSphereTree(importer.getRigidBodyByIndex(0)->getCollisionShape());
  const bool isSame = loaded != nullptr && loaded->tree().data() == rock->tree().data();
  importer.deleteAllData();
  return isSame ? 0 : 1;
}

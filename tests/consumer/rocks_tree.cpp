// SPDX-License-Identifier: Zlib
// rocks_gimpact.cpp with sphere-trees: the change is the one in docs/games.md.
#include <btBulletDynamicsCommon.h>
#include <cairn/bullet/dispatcher.h>
#include <cairn/bullet/sphere_tree_shape.h>
#include <cairn/core/tree_file.h>

#include <cstdio>
#include <deque>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

namespace {

// Triangles of an OBJ file, as this game's renderer would read them.
bool readMesh(const char* path, btTriangleMesh& mesh) {
  std::ifstream file(path);
  std::vector<btVector3> vertices;
  for (std::string word; file >> word;) {
    if (word == "v") {
      btVector3 v(0, 0, 0);
      file >> v[0] >> v[1] >> v[2];
      vertices.push_back(v);
    } else if (word == "f") {
      std::size_t a = 0, b = 0, c = 0;
      file >> a >> b >> c;
      mesh.addTriangle(vertices.at(a - 1), vertices.at(b - 1), vertices.at(c - 1));
    } else {
      std::getline(file, word);
    }
  }
  return mesh.getNumTriangles() > 0;
}

}  // namespace

int main(int argc, char** argv) {
  btTriangleMesh mesh;
  if (argc < 2 || !readMesh(argv[1], mesh)) return std::fprintf(stderr, "usage: %s MESH.obj\n", argv[0]), 2;
  btDefaultCollisionConfiguration configuration;
  cairn::bullet::Dispatcher<> dispatcher(&configuration);
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btDiscreteDynamicsWorld world(&dispatcher, &broadphase, &solver, &configuration);
  btStaticPlaneShape plane({0, 1, 0}, 0);
  btRigidBody ground(0, nullptr, &plane);
  world.addRigidBody(&ground);

  const auto rock = cairn::bullet::SphereTreeShape::create(cairn::loadTree(argv[2]).value()).value();
  btVector3 inertia;
  rock->calculateLocalInertia(1, inertia);
  std::deque<btRigidBody> rocks;
  for (int i = 0; i < 10; ++i) {
    btRigidBody& body = rocks.emplace_back(1, nullptr, rock.get(), inertia);
    body.setWorldTransform(
        btTransform(btQuaternion(btVector3(1, 1, 0), btScalar(i)), btVector3(0, btScalar(2 * i + 2), 0)));
    world.addRigidBody(&body);
  }
  for (int step = 0; step < 600; ++step) world.stepSimulation(btScalar(1) / 60);
  for (const btRigidBody& body : rocks) std::printf("%.3f\n", double(body.getWorldTransform().getOrigin().y()));
}

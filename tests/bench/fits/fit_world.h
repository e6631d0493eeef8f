// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <btBulletDynamicsCommon.h>

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "cairn/bullet/dispatcher.h"
#include "cairn/bullet/sphere_tree_shape.h"

class btTriangleIndexVertexArray;

namespace cairn::bench {

/// The shapes that the pieces collide as. `treeOnMesh`: what does not move is one of Bullet's own static meshes.
enum class FitShape { tree, treeLeaves, treeOnMesh, gimpact };
const char* nameOf(FitShape shape);

/// The pieces of a folder of meshes, and their trees, each made when it is first asked for.
class Pieces {
 public:
  explicit Pieces(std::filesystem::path folder) : folder_(std::move(folder)) {}

  std::shared_ptr<const SphereTree> tree(const std::string& name);

 private:
  std::filesystem::path folder_;
  std::map<std::string, std::shared_ptr<const SphereTree>> trees_;
};

/// A Bullet world of pieces at 60 Hz, default solver. Places are those of the meshes' own frames.
class FitWorld {
 public:
  FitWorld(Pieces& pieces, FitShape shape);
  ~FitWorld();

  /// Mass 0: it does not move.
  btRigidBody& add(const std::string& piece, double mass, double friction, const btTransform& mesh, double scale = 1);
  btRigidBody& addShape(std::shared_ptr<btCollisionShape> shape, double mass, double friction,
                        const btTransform& place);
  btTransform meshPlace(const btRigidBody& body) const;
  void setMeshPlace(btRigidBody& body, const btTransform& mesh) const;
  void step() { world.stepSimulation(btScalar(1.0 / 60), 0); }
  double fastest() const;

 private:
  btTriangleIndexVertexArray& triangles(const bullet::SphereTreeShape& tree);
  std::shared_ptr<btCollisionShape> shapeOf(const std::shared_ptr<bullet::SphereTreeShape>& tree, bool isFixed);

  Pieces& pieces_;
  FitShape shape_;
  btDefaultCollisionConfiguration configuration_;
  std::unique_ptr<btCollisionDispatcher> dispatcher_;
  btDbvtBroadphase broadphase_;
  btSequentialImpulseConstraintSolver solver_;
  std::vector<std::shared_ptr<btCollisionShape>> shapes_;
  std::vector<std::unique_ptr<btTriangleIndexVertexArray>> meshes_;
  struct Coordinates {
    std::vector<btScalar> of;
    std::vector<int> indices;
  };
  std::vector<std::unique_ptr<Coordinates>> coordinates_;
  std::vector<std::unique_ptr<btRigidBody>> bodies_;
  std::map<const btRigidBody*, btTransform> bodyFromMesh_;

 public:
  btDiscreteDynamicsWorld world;
};

inline btTransform at(double x, double y, double z, const btQuaternion& turn = btQuaternion::getIdentity()) {
  return btTransform(turn, btVector3(btScalar(x), btScalar(y), btScalar(z)));
}

}  // namespace cairn::bench

// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit_world.h"

#include <BulletCollision/Gimpact/btGImpactCollisionAlgorithm.h>
#include <BulletCollision/Gimpact/btGImpactShape.h>

#include <algorithm>
#include <stdexcept>

#include "cairn/builder/build.h"
#include "cairn/builder/import.h"
#include "placement/bullet_math.h"

namespace cairn::bench {

const char* nameOf(FitShape shape) {
  switch (shape) {
    case FitShape::tree:
      return "tree";
    case FitShape::treeLeaves:
      return "tree+leaves";
    case FitShape::treeOnMesh:
      return "tree+mesh";
    case FitShape::gimpact:
      return "gimpact";
  }
  return "";
}

std::shared_ptr<const SphereTree> Pieces::tree(const std::string& name) {
  std::shared_ptr<const SphereTree>& tree = trees_[name];
  if (!tree) {
    auto mesh = builder::importMesh(folder_ / (name + ".obj"));
    if (!mesh) throw std::runtime_error(mesh.error().message);
    auto built = builder::buildTree(mesh.value(), {});
    if (!built) throw std::runtime_error(built.error().message);
    tree = std::make_shared<const SphereTree>(std::move(built).value());
  }
  return tree;
}

namespace {

std::unique_ptr<btCollisionDispatcher> makeDispatcher(FitShape shape, btCollisionConfiguration* configuration) {
  if (shape == FitShape::gimpact) {
    auto dispatcher = std::make_unique<btCollisionDispatcher>(configuration);
    btGImpactCollisionAlgorithm::registerAlgorithm(dispatcher.get());
    return dispatcher;
  }
  auto dispatcher = std::make_unique<bullet::Dispatcher<>>(configuration);
  if (shape == FitShape::treeLeaves) dispatcher->setFinest(bullet::Finest::leaves);
  return dispatcher;
}

}  // namespace

FitWorld::FitWorld(Pieces& pieces, FitShape shape)
    : pieces_(pieces),
      shape_(shape),
      dispatcher_(makeDispatcher(shape, &configuration_)),
      world(dispatcher_.get(), &broadphase_, &solver_, &configuration_) {
  world.setGravity(btVector3(0, 0, -10));
}

FitWorld::~FitWorld() {
  for (const auto& body : bodies_) world.removeRigidBody(body.get());
}

btTriangleIndexVertexArray& FitWorld::triangles(const bullet::SphereTreeShape& shape) {
  auto coordinates = std::make_unique<Coordinates>();
  for (const Vec3& v : shape.tree().vertices()) {
    const btVector3 p = shape.bodyFromTree() * (bullet::toBullet(v) * shape.scale());
    coordinates->of.insert(coordinates->of.end(), {p.x(), p.y(), p.z()});
  }
  for (const auto& t : shape.tree().triangles())
    for (const std::uint32_t v : t) coordinates->indices.push_back(static_cast<int>(v));
  meshes_.push_back(std::make_unique<btTriangleIndexVertexArray>(
      static_cast<int>(shape.tree().triangles().size()), coordinates->indices.data(), 3 * static_cast<int>(sizeof(int)),
      static_cast<int>(shape.tree().vertices().size()), coordinates->of.data(),
      3 * static_cast<int>(sizeof(btScalar))));
  coordinates_.push_back(std::move(coordinates));
  return *meshes_.back();
}

std::shared_ptr<btCollisionShape> FitWorld::shapeOf(const std::shared_ptr<bullet::SphereTreeShape>& tree,
                                                    bool isFixed) {
  if (shape_ == FitShape::treeOnMesh && isFixed)
    return std::make_shared<btBvhTriangleMeshShape>(&triangles(*tree), true);
  if (shape_ != FitShape::gimpact) return tree;
  auto mesh = std::make_shared<btGImpactMeshShape>(&triangles(*tree));
  mesh->setMargin(btScalar(0.0005));
  mesh->updateBound();
  return mesh;
}

btRigidBody& FitWorld::add(const std::string& piece, double mass, double friction, const btTransform& mesh,
                           double scale) {
  auto created =
      bullet::SphereTreeShape::create(pieces_.tree(piece), bullet::BodyFrame::principalAxes, btScalar(scale));
  if (!created) throw std::runtime_error(created.error().message);
  const std::shared_ptr<bullet::SphereTreeShape> tree = std::move(created).value();
  btVector3 inertia(0, 0, 0);
  if (mass > 0) tree->calculateLocalInertia(btScalar(mass), inertia);
  const std::shared_ptr<btCollisionShape> shape = shapeOf(tree, mass == 0);
  btRigidBody::btRigidBodyConstructionInfo info(btScalar(mass), nullptr, shape.get(), inertia);
  info.m_startWorldTransform = mesh * tree->bodyFromMesh().inverse();
  info.m_friction = btScalar(friction);
  shapes_.push_back(tree);
  shapes_.push_back(shape);
  bodies_.push_back(std::make_unique<btRigidBody>(info));
  bodyFromMesh_[bodies_.back().get()] = tree->bodyFromMesh();
  world.addRigidBody(bodies_.back().get());
  return *bodies_.back();
}

btRigidBody& FitWorld::addShape(std::shared_ptr<btCollisionShape> shape, double mass, double friction,
                                const btTransform& place) {
  btVector3 inertia(0, 0, 0);
  if (mass > 0) shape->calculateLocalInertia(btScalar(mass), inertia);
  btRigidBody::btRigidBodyConstructionInfo info(btScalar(mass), nullptr, shape.get(), inertia);
  info.m_startWorldTransform = place;
  info.m_friction = btScalar(friction);
  shapes_.push_back(std::move(shape));
  bodies_.push_back(std::make_unique<btRigidBody>(info));
  world.addRigidBody(bodies_.back().get());
  return *bodies_.back();
}

btTransform FitWorld::meshPlace(const btRigidBody& body) const {
  return body.getWorldTransform() * bodyFromMesh_.at(&body);
}

void FitWorld::setMeshPlace(btRigidBody& body, const btTransform& mesh) const {
  body.setWorldTransform(mesh * bodyFromMesh_.at(&body).inverse());
}

double FitWorld::fastest() const {
  btScalar most = 0;
  for (const auto& body : bodies_) most = std::max(most, body->getLinearVelocity().length());
  return double(most);
}

}  // namespace cairn::bench

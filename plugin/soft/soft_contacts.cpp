// SPDX-License-Identifier: Zlib
#include "cairn/soft/soft_contacts.h"

#include <BulletCollision/CollisionDispatch/btCollisionConfiguration.h>
#include <BulletCollision/CollisionDispatch/btCollisionCreateFunc.h>
#include <BulletCollision/CollisionDispatch/btCollisionDispatcher.h>
#include <BulletCollision/CollisionDispatch/btCollisionObjectWrapper.h>
#include <BulletSoftBody/btSoftBodyConcaveCollisionAlgorithm.h>

#include <new>
#include <utility>

#include "cairn/bullet/sphere_tree_shape.h"
#include "node_contacts.h"

namespace cairn::soft {

namespace {

// Types of Bullet's broad phase, by which its dispatcher finds who answers a pair.
constexpr int kSoft = SOFTBODY_SHAPE_PROXYTYPE, kTree = FAST_CONCAVE_MESH_PROXYTYPE;

}  // namespace

/// Answers pairs of a soft body and a tree; leaves all others of these two types to Bullet.
class CreateNodeContacts final : public btCollisionAlgorithmCreateFunc {
 public:
  explicit CreateNodeContacts(btCollisionDispatcher& dispatcher) : dispatcher_(dispatcher) {
    dispatcher.registerCollisionCreateFunc(kSoft, kTree, this);
    dispatcher.registerCollisionCreateFunc(kTree, kSoft, this);
  }
  ~CreateNodeContacts() override {
    dispatcher_.registerCollisionCreateFunc(kSoft, kTree, bullets(dispatcher_, kSoft, kTree));
    dispatcher_.registerCollisionCreateFunc(kTree, kSoft, bullets(dispatcher_, kTree, kSoft));
  }

  static btCollisionAlgorithmCreateFunc* bullets(btCollisionDispatcher& dispatcher, int type0, int type1) {
    return dispatcher.getCollisionConfiguration()->getCollisionAlgorithmCreateFunc(type0, type1);
  }

  btCollisionAlgorithm* CreateCollisionAlgorithm(btCollisionAlgorithmConstructionInfo& info,
                                                 const btCollisionObjectWrapper* body0,
                                                 const btCollisionObjectWrapper* body1) override {
    const bool isTreeFirst = bullet::asSphereTree(body0->getCollisionShape()) != nullptr;
    const btSoftBody* const soft = btSoftBody::upcast((isTreeFirst ? body1 : body0)->getCollisionObject());
    const bool isTree = isTreeFirst || bullet::asSphereTree(body1->getCollisionShape());
    if (!isTree || !soft || (soft->m_cfg.collisions & btSoftBody::fCollision::SDF_RD))
      return bullets(dispatcher_, body0->getCollisionShape()->getShapeType(),
                     body1->getCollisionShape()->getShapeType())
          ->CreateCollisionAlgorithm(info, body0, body1);
    // A configuration for soft bodies has a pool for algorithms as large as this one.
    static_assert(sizeof(NodeContacts) <= sizeof(btSoftBodyConcaveCollisionAlgorithm));
    void* const memory = info.m_dispatcher1->allocateCollisionAlgorithm(sizeof(NodeContacts));
    return new (memory) NodeContacts(info, isTreeFirst);
  }

 private:
  btCollisionDispatcher& dispatcher_;
};

Result<SoftContacts> SoftContacts::install(btCollisionDispatcher& dispatcher) {
  const auto* const nobodys = CreateNodeContacts::bullets(dispatcher, EMPTY_SHAPE_PROXYTYPE, EMPTY_SHAPE_PROXYTYPE);
  if (CreateNodeContacts::bullets(dispatcher, kSoft, kTree) == nobodys)
    return Error{
        "SoftContacts: the dispatcher's collision configuration knows no soft bodies; make it a "
        "btSoftBodyRigidBodyCollisionConfiguration."};
  return SoftContacts(std::make_unique<CreateNodeContacts>(dispatcher));
}

SoftContacts::SoftContacts(std::unique_ptr<CreateNodeContacts> create) : create_(std::move(create)) {}
SoftContacts::SoftContacts(SoftContacts&&) noexcept = default;
SoftContacts& SoftContacts::operator=(SoftContacts&&) noexcept = default;
SoftContacts::~SoftContacts() = default;

}  // namespace cairn::soft

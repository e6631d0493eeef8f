// SPDX-License-Identifier: Zlib
#include "cairn/soft/soft_contacts.h"

#include <BulletSoftBody/btSoftBodyConcaveCollisionAlgorithm.h>

#include <array>
#include <new>
#include <utility>

#include "bullets_answer.h"
#include "cairn/bullet/sphere_tree_shape.h"
#include "node_contacts.h"

namespace cairn::soft {

namespace {

// Types of Bullet's broad phase, by which its dispatcher finds who answers a pair.
constexpr int kSoft = SOFTBODY_SHAPE_PROXYTYPE, kTree = FAST_CONCAVE_MESH_PROXYTYPE;
constexpr std::array<std::array<int, 2>, 2> kPairs{{{kSoft, kTree}, {kTree, kSoft}}};

// A dispatcher's table can be written by all, but read only by derived classes.
struct Table : btCollisionDispatcher {
  static btCollisionAlgorithmCreateFunc* at(btCollisionDispatcher& dispatcher, int type0, int type1) {
    return (dispatcher.*(&Table::m_doubleDispatchContactPoints))[type0][type1];
  }
};

}  // namespace

/// Answers pairs of a soft body and a tree; leaves all others of these two types to Bullet.
class CreateNodeContacts final : public btCollisionAlgorithmCreateFunc {
 public:
  explicit CreateNodeContacts(btCollisionDispatcher& dispatcher) : dispatcher_(dispatcher) {
    for (const auto& [type0, type1] : kPairs) dispatcher.registerCollisionCreateFunc(type0, type1, this);
  }
  ~CreateNodeContacts() override {
    for (const auto& [type0, type1] : kPairs)
      if (Table::at(dispatcher_, type0, type1) == this)
        dispatcher_.registerCollisionCreateFunc(type0, type1, BulletsAnswer::functionOf(dispatcher_, type0, type1));
  }

  btCollisionAlgorithm* CreateCollisionAlgorithm(btCollisionAlgorithmConstructionInfo& info,
                                                 const btCollisionObjectWrapper* body0,
                                                 const btCollisionObjectWrapper* body1) override {
    const btCollisionShape& shape0 = *body0->getCollisionShape();
    const btCollisionShape& shape1 = *body1->getCollisionShape();
    if (!bullet::asSphereTree(&shape0) && !bullet::asSphereTree(&shape1))
      return BulletsAnswer::functionOf(dispatcher_, shape0.getShapeType(), shape1.getShapeType())
          ->CreateCollisionAlgorithm(info, body0, body1);
    // A configuration for soft bodies has a pool for algorithms as large as this one.
    static_assert(sizeof(NodeContacts) <= sizeof(btSoftBodyConcaveCollisionAlgorithm));
    return new (info.m_dispatcher1->allocateCollisionAlgorithm(sizeof(NodeContacts))) NodeContacts(info, dispatcher_);
  }

 private:
  btCollisionDispatcher& dispatcher_;
};

Result<SoftContacts> SoftContacts::install(btCollisionDispatcher& dispatcher) {
  const auto* const nobodys = BulletsAnswer::functionOf(dispatcher, EMPTY_SHAPE_PROXYTYPE, EMPTY_SHAPE_PROXYTYPE);
  for (const auto& [type0, type1] : kPairs) {
    const auto* const bullets = BulletsAnswer::functionOf(dispatcher, type0, type1);
    if (bullets == nobodys)
      return Error{
          "SoftContacts: the dispatcher's collision configuration knows no soft bodies; make it a "
          "btSoftBodyRigidBodyCollisionConfiguration."};
    if (Table::at(dispatcher, type0, type1) != bullets)
      return Error{
          "SoftContacts: somebody answers for soft bodies and concave shapes on this dispatcher already; install once, "
          "and destroy the former SoftContacts first."};
  }
  return SoftContacts(std::make_unique<CreateNodeContacts>(dispatcher));
}

SoftContacts::SoftContacts(std::unique_ptr<CreateNodeContacts> create) : create_(std::move(create)) {}
SoftContacts::SoftContacts(SoftContacts&&) noexcept = default;
SoftContacts& SoftContacts::operator=(SoftContacts&&) noexcept = default;
SoftContacts::~SoftContacts() = default;

}  // namespace cairn::soft

// SPDX-License-Identifier: Zlib
#include "dispatch/create_functions.h"

#include <BulletCollision/BroadphaseCollision/btCollisionAlgorithm.h>
#include <BulletCollision/CollisionDispatch/btCollisionConfiguration.h>
#include <BulletCollision/CollisionDispatch/btCollisionDispatcher.h>

#include <optional>
#include <utility>

#include "cairn/bullet/sphere_tree_shape.h"
#include "dispatch/tree_algorithm.h"

namespace cairn::bullet {

namespace {

constexpr int kOwnType = FAST_CONCAVE_MESH_PROXYTYPE;

bool isRegistered(int type) {
  return type < COMPOUND_SHAPE_PROXYTYPE && type != CONCAVE_SHAPES_START_HERE && type != CONCAVE_SHAPES_END_HERE &&
         type != IMPLICIT_CONVEX_SHAPES_START_HERE && type != EMPTY_SHAPE_PROXYTYPE;
}

// Calls `visit(type0, type1)` for every cell of the tables that is ours, once.
template <class Visit>
void forEachCell(const Visit& visit) {
  for (int type = 0; type < MAX_BROADPHASE_COLLISION_TYPES; ++type) {
    if (!isRegistered(type)) continue;
    visit(kOwnType, type);
    if (type != kOwnType) visit(type, kOwnType);
  }
}

class CreateTreeAlgorithm final : public btCollisionAlgorithmCreateFunc {
 public:
  CreateTreeAlgorithm(btCollisionConfiguration& configuration, NarrowPhase::Impl& narrowPhase, bool isForQueries)
      : configuration_(configuration), narrowPhase_(narrowPhase), isForQueries_(isForQueries) {}

  btCollisionAlgorithm* CreateCollisionAlgorithm(btCollisionAlgorithmConstructionInfo& info,
                                                 const btCollisionObjectWrapper* body0,
                                                 const btCollisionObjectWrapper* body1) override {
    const btCollisionShape& shape0 = *body0->getCollisionShape();
    const btCollisionShape& shape1 = *body1->getCollisionShape();
    const bool isTree0 = asSphereTree(&shape0) != nullptr;
    const bool hasTree = isTree0 || asSphereTree(&shape1);
    const std::optional<CounterpartKind> kind = hasTree ? kindOf(isTree0 ? shape1 : shape0) : std::nullopt;
    if (!kind)
      return original(shape0.getShapeType(), shape1.getShapeType())->CreateCollisionAlgorithm(info, body0, body1);
    void* memory = info.m_dispatcher1->allocateCollisionAlgorithm(sizeof(TreeAlgorithm));
    return new (memory) TreeAlgorithm(info, narrowPhase_, *kind, !isForQueries_);
  }

 private:
  btCollisionAlgorithmCreateFunc* original(int type0, int type1) const {
    return isForQueries_ ? configuration_.getClosestPointsAlgorithmCreateFunc(type0, type1)
                         : configuration_.getCollisionAlgorithmCreateFunc(type0, type1);
  }

  btCollisionConfiguration& configuration_;
  NarrowPhase::Impl& narrowPhase_;
  bool isForQueries_;
};

}  // namespace

Registration::Registration(btCollisionDispatcher& dispatcher, NarrowPhase::Impl& narrowPhase)
    : dispatcher_(dispatcher),
      contacts_(std::make_unique<CreateTreeAlgorithm>(*dispatcher.getCollisionConfiguration(), narrowPhase, false)),
      closestPoints_(
          std::make_unique<CreateTreeAlgorithm>(*dispatcher.getCollisionConfiguration(), narrowPhase, true)) {
  forEachCell([&](int type0, int type1) {
    dispatcher_.registerCollisionCreateFunc(type0, type1, contacts_.get());
    dispatcher_.registerClosestPointsCreateFunc(type0, type1, closestPoints_.get());
  });
}

Registration::~Registration() {
  btCollisionConfiguration& configuration = *dispatcher_.getCollisionConfiguration();
  forEachCell([&](int type0, int type1) {
    dispatcher_.registerCollisionCreateFunc(type0, type1, configuration.getCollisionAlgorithmCreateFunc(type0, type1));
    dispatcher_.registerClosestPointsCreateFunc(type0, type1,
                                                configuration.getClosestPointsAlgorithmCreateFunc(type0, type1));
  });
}

}  // namespace cairn::bullet

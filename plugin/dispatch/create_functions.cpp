// SPDX-License-Identifier: Zlib
#include "dispatch/create_functions.h"

#include <BulletCollision/BroadphaseCollision/btCollisionAlgorithm.h>
#include <BulletCollision/CollisionDispatch/btCollisionCreateFunc.h>
#include <BulletCollision/CollisionDispatch/btCollisionDispatcher.h>
#include <BulletCollision/CollisionDispatch/btDefaultCollisionConfiguration.h>
#include <BulletCollision/Gimpact/btGImpactCollisionAlgorithm.h>

#include <array>
#include <atomic>
#include <cassert>
#include <optional>
#include <utility>

#include "cairn/bullet/sphere_tree_shape.h"
#include "dispatch/compound_algorithm.h"
#include "dispatch/narrow_phase_impl.h"
#include "dispatch/tree_algorithm.h"
#include "platform/virtual_table.h"
#include "shape/unserved.h"

namespace cairn::bullet {

namespace {

constexpr int kOwnType = FAST_CONCAVE_MESH_PROXYTYPE;

bool isRegistered(int type) {
  return type < COMPOUND_SHAPE_PROXYTYPE && type != CONCAVE_SHAPES_START_HERE && type != CONCAVE_SHAPES_END_HERE &&
         type != IMPLICIT_CONVEX_SHAPES_START_HERE && type != EMPTY_SHAPE_PROXYTYPE;
}

using Functions = btCollisionAlgorithmCreateFunc* [MAX_BROADPHASE_COLLISION_TYPES][MAX_BROADPHASE_COLLISION_TYPES];

// A dispatcher's tables can be written by all, but read only by derived classes.
struct Tables : btCollisionDispatcher {
  static Functions& contacts(btCollisionDispatcher& d) { return d.*(&Tables::m_doubleDispatchContactPoints); }
  static Functions& closestPoints(btCollisionDispatcher& d) { return d.*(&Tables::m_doubleDispatchClosestPoints); }
};

// Calls `visit(type0, type1)` once for every entry of the tables that is Cairn's.
template <class Visit>
void forEachCell(const Visit& visit) {
  for (int type = 0; type < MAX_BROADPHASE_COLLISION_TYPES; ++type) {
    if (!isRegistered(type)) continue;
    visit(kOwnType, type);
    if (type != kOwnType) visit(type, kOwnType);
  }
}

// What GImpact registers: one object for all dispatchers, which it tells nobody but them.
btCollisionAlgorithmCreateFunc* askGImpact() {
  btDefaultCollisionConstructionInfo few;
  few.m_defaultMaxPersistentManifoldPoolSize = few.m_defaultMaxCollisionAlgorithmPoolSize = 1;
  btDefaultCollisionConfiguration configuration(few);
  btCollisionDispatcher dispatcher(&configuration);
  btGImpactCollisionAlgorithm::registerAlgorithm(&dispatcher);
  return Tables::contacts(dispatcher)[GIMPACT_SHAPE_PROXYTYPE][GIMPACT_SHAPE_PROXYTYPE];
}

// That object, or another of its class that somebody entered by hand.
bool isGImpacts(btCollisionAlgorithmCreateFunc* create) {
  static btCollisionAlgorithmCreateFunc* const gimpacts = askGImpact();
  return create == gimpacts || virtualTableOf(create) == virtualTableOf(gimpacts);
}

}  // namespace

// Replaces one table's entries, and forwards to the former entry for other shapes.
class CreateTreeAlgorithm final : public btCollisionAlgorithmCreateFunc {
 public:
  CreateTreeAlgorithm(Functions& table, NarrowPhase::Impl& narrowPhase, bool isForQueries)
      : table_(table), narrowPhase_(narrowPhase), isForQueries_(isForQueries) {
    forEachCell([&](int type0, int type1) {
      original(type0, type1) = table_[type0][type1];
      table_[type0][type1] = this;
    });
    ownTable() = virtualTableOf(this);
  }
  static bool isOne(const btCollisionAlgorithmCreateFunc* create) { return virtualTableOf(create) == ownTable(); }
  ~CreateTreeAlgorithm() override { giveBack(); }
  void leave() { isLeft_ = true; }
  void giveBack() {
    forEachCell([&](int type0, int type1) {
      if (table_[type0][type1] == this) table_[type0][type1] = original(type0, type1);
    });
  }

  // GImpact registers its own shapes against all others and knows nothing of trees, whose triangles it would take. Its
  // entry keeps serving other shapes.
  void takeBackFromGImpact() {
    const auto takeBack = [&](int type0, int type1) {
      btCollisionAlgorithmCreateFunc*& cell = table_[type0][type1];
      if (!isGImpacts(cell)) return;
      original(type0, type1) = cell;
      cell = this;
    };
    takeBack(kOwnType, GIMPACT_SHAPE_PROXYTYPE);
    takeBack(GIMPACT_SHAPE_PROXYTYPE, kOwnType);
  }

  btCollisionAlgorithm* CreateCollisionAlgorithm(btCollisionAlgorithmConstructionInfo& info,
                                                 const btCollisionObjectWrapper* body0,
                                                 const btCollisionObjectWrapper* body1) override {
    const btCollisionShape& shape0 = *body0->getCollisionShape();
    const btCollisionShape& shape1 = *body1->getCollisionShape();
    if (isLeft_) giveBack();
    const bool isTree0 = asSphereTree(&shape0) != nullptr;
    const bool hasTree = !isLeft_ && (isTree0 || asSphereTree(&shape1));
    const std::optional<ColliderKind> kind = hasTree ? kindOf(isTree0 ? shape1 : shape0) : std::nullopt;
    if (!kind)
      return original(shape0.getShapeType(), shape1.getShapeType())->CreateCollisionAlgorithm(info, body0, body1);
    void* memory = info.m_dispatcher1->allocateCollisionAlgorithm(sizeof(TreeAlgorithm));
    const ServedPair bodies = ServedPair::of(body0->getCollisionObject(), body1->getCollisionObject());
    return new (memory) TreeAlgorithm(info, narrowPhase_.shared_from_this(), {*kind, bodies, !isForQueries_});
  }

 private:
  // That of all there ever were: only this file makes them.
  static std::atomic<VirtualTable>& ownTable() {
    static std::atomic<VirtualTable> table{nullptr};
    return table;
  }
  btCollisionAlgorithmCreateFunc*& original(int type0, int type1) {
    const bool isFirst = type0 == kOwnType;
    return originals_[isFirst ? 0 : 1][static_cast<std::size_t>(isFirst ? type1 : type0)];
  }

  Functions& table_;
  NarrowPhase::Impl& narrowPhase_;
  bool isForQueries_;
  bool isLeft_ = false;
  std::array<std::array<btCollisionAlgorithmCreateFunc*, MAX_BROADPHASE_COLLISION_TYPES>, 2> originals_{};
};

// Replaces GImpact's entries for compounds: compounds with sphere-trees go to Bullet's own algorithm, child by child.
class CreateCompoundAlgorithm final : public btCollisionAlgorithmCreateFunc {
 public:
  explicit CreateCompoundAlgorithm(Functions& table) : table_(table) { takeFromGImpact(); }
  ~CreateCompoundAlgorithm() override { giveBack(); }
  void leave() { isLeft_ = true; }
  void giveBack() {
    if (compoundFirst() == this) compoundFirst() = gimpacts_;
    if (compoundSecond() == this) compoundSecond() = gimpacts_;
  }

  void takeFromGImpact() {
    for (btCollisionAlgorithmCreateFunc** cell : {&compoundFirst(), &compoundSecond()})
      if (isGImpacts(*cell)) gimpacts_ = std::exchange(*cell, this);
  }

  btCollisionAlgorithm* CreateCollisionAlgorithm(btCollisionAlgorithmConstructionInfo& info,
                                                 const btCollisionObjectWrapper* body0,
                                                 const btCollisionObjectWrapper* body1) override {
    const bool isFirst = body0->getCollisionShape()->isCompound();
    const btCollisionShape& other = *(isFirst ? body1 : body0)->getCollisionShape();
    if (isLeft_) giveBack();
    // What is left alone, or hides its triangles.
    if (isLeft_ || !kindOf(other)) return gimpacts_->CreateCollisionAlgorithm(info, body0, body1);
    btCollisionAlgorithmCreateFunc* const childByChild =
        isFirst ? table_[COMPOUND_SHAPE_PROXYTYPE][kOwnType] : table_[kOwnType][COMPOUND_SHAPE_PROXYTYPE];
    void* memory = info.m_dispatcher1->allocateCollisionAlgorithm(sizeof(CompoundAlgorithm));
    return new (memory) CompoundAlgorithm(info, {childByChild, gimpacts_});
  }

 private:
  btCollisionAlgorithmCreateFunc*& compoundFirst() { return table_[COMPOUND_SHAPE_PROXYTYPE][GIMPACT_SHAPE_PROXYTYPE]; }
  btCollisionAlgorithmCreateFunc*& compoundSecond() {
    return table_[GIMPACT_SHAPE_PROXYTYPE][COMPOUND_SHAPE_PROXYTYPE];
  }

  Functions& table_;
  bool isLeft_ = false;
  btCollisionAlgorithmCreateFunc* gimpacts_ = nullptr;  // one for all entries
};

bool Registration::isOn(btCollisionDispatcher& dispatcher) {
  bool isFound = false;
  forEachCell([&](int type0, int type1) {
    isFound = isFound || CreateTreeAlgorithm::isOne(Tables::contacts(dispatcher)[type0][type1]);
  });
  return isFound;
}

Registration::Registration(btCollisionDispatcher& dispatcher, NarrowPhase::Impl& narrowPhase) {
  assert(!isOn(dispatcher) && "sphere-trees are registered already");
  contacts_ = std::make_unique<CreateTreeAlgorithm>(Tables::contacts(dispatcher), narrowPhase, false);
  closestPoints_ = std::make_unique<CreateTreeAlgorithm>(Tables::closestPoints(dispatcher), narrowPhase, true);
  compoundContacts_ = std::make_unique<CreateCompoundAlgorithm>(Tables::contacts(dispatcher));
  compoundClosestPoints_ = std::make_unique<CreateCompoundAlgorithm>(Tables::closestPoints(dispatcher));
  ++servingDispatchers();
}

Registration::~Registration() {
  if (!isLeft_) --servingDispatchers();
}

void Registration::leave() {
  isLeft_ = true;
  --servingDispatchers();
  contacts_->leave();
  closestPoints_->leave();
  compoundContacts_->leave();
  compoundClosestPoints_->leave();
}

void Registration::renew() {
  contacts_->takeBackFromGImpact();
  closestPoints_->takeBackFromGImpact();
  compoundContacts_->takeFromGImpact();
  compoundClosestPoints_->takeFromGImpact();
}

}  // namespace cairn::bullet

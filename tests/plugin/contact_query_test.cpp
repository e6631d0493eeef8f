// SPDX-License-Identifier: Zlib
// Contact queries and ghosts: a tree against everything it can meet, asked either way round, near and far.
#include <gtest/gtest.h>

#include <BulletCollision/CollisionDispatch/btGhostObject.h>
#include <BulletCollision/CollisionShapes/btUniformScalingShape.h>

#include <random>
#include <set>
#include <string>

#include "front_ends.h"
#include "gimpact_mesh.h"
#include "triangle_grounds.h"

namespace cairn::test::contact_query_test {
namespace {

// Flat regions against flat or round shapes: the closest points are told within this (measured: 1e-4 at most).
constexpr double kDistanceTolerance = 5e-4;

struct Points final : btCollisionWorld::ContactResultCallback {
  int count = 0;
  btScalar deepest = 1000;
  btVector3 normalOnB{0, 0, 0};
  const btCollisionObject* partner = nullptr;
  int treePart = -1, treeIndex = -1;
  btScalar addSingleResult(btManifoldPoint& point, const btCollisionObjectWrapper* a, int partA, int indexA,
                           const btCollisionObjectWrapper* b, int partB, int indexB) override {
    ++count;
    if (point.getDistance() >= deepest) return 0;
    const bool treeIsA = bullet::asSphereTree(a->getCollisionShape()) != nullptr;
    deepest = point.getDistance();
    normalOnB = point.m_normalWorldOnB;
    partner = (treeIsA ? b : a)->getCollisionObject();
    treePart = treeIsA ? partA : partB;
    treeIndex = treeIsA ? indexA : indexB;
    return 0;
  }
};

// Something whose highest point, or face, is at height 0 above the origin.
struct Below {
  const char* name;
  std::shared_ptr<btCollisionShape> shape;
  btVector3 origin;
};

template <class Child>
std::shared_ptr<btCollisionShape> compoundOf(std::shared_ptr<Child> child) {
  auto compound = std::make_shared<btCompoundShape>();
  compound->addChildShape(btTransform(btQuaternion::getIdentity(), btVector3(0, 0, -1)), child.get());
  return {compound.get(), [compound, child](btCollisionShape*) {}};
}

std::shared_ptr<btCollisionShape> hullOf(btScalar half) {
  auto hull = std::make_shared<btConvexHullShape>();
  for (int i = 0; i < 8; ++i)
    hull->addPoint(btVector3(i & 1 ? half : -half, i & 2 ? half : -half, i & 4 ? half : -half));
  hull->setMargin(0);
  return hull;
}

// Bullet's cone is grown by its margin, apex and all.
std::shared_ptr<btCollisionShape> coneOf(btScalar radius, btScalar height) {
  auto cone = std::make_shared<btConeShapeZ>(radius, height);
  cone->setMargin(0);
  return cone;
}

std::vector<Below> everythingBelow() {
  const btVector3 under(0, 0, -1), level(0, 0, 0);
  const auto box = std::make_shared<btBoxShape>(btVector3(1, 1, 1));
  const auto half = std::make_shared<btSphereShape>(btScalar(0.5));
  const btVector3 centers[2] = {btVector3(0, 0, btScalar(0.5)), btVector3(0, 0, btScalar(-0.5))};
  const btScalar radii[2] = {btScalar(0.5), btScalar(0.4)};
  const auto tree = treeShape(plainTree(cuboid({2, 2, 2}, 4)));
  return {{"plane", std::make_shared<btStaticPlaneShape>(btVector3(0, 0, 1), btScalar(0)), level},
          {"box", box, under},
          {"sphere", std::make_shared<btSphereShape>(btScalar(1)), under},
          {"capsule", std::make_shared<btCapsuleShapeZ>(btScalar(0.5), btScalar(1)), under},
          {"cylinder", std::make_shared<btCylinderShapeZ>(btVector3(1, 1, 1)), under},
          {"cone", coneOf(1, 2), under},
          {"hull", hullOf(1), under},
          {"spheres", std::make_shared<btMultiSphereShape>(centers, radii, 2), under},
          {"scaled sphere",
           std::shared_ptr<btCollisionShape>(new btUniformScalingShape(half.get(), 2),
                                             [half](btCollisionShape* s) { delete s; }),
           under},
          {"mesh", flatGround(TriangleGround::mesh), level},
          {"scaled mesh", flatGround(TriangleGround::scaledMesh), level},
          {"terrain", flatGround(TriangleGround::terrain), level},
          {"gimpact", flatGround(TriangleGround::gimpact), level},
          {"tree", tree, under},
          {"compound of a box", compoundOf(box), level},
          {"compound of a tree", compoundOf(tree), level}};
}

class ContactQuery : public testing::TestWithParam<FrontEnd> {};
INSTANTIATE_TEST_SUITE_P(Each, ContactQuery, testing::ValuesIn(kEveryFrontEnd));

// A cube of a tree, its underside `separation` above whatever is below, each of the two added first in turn and asked
// first in turn.
TEST_P(ContactQuery, TellsDistanceAndNormalOfEverythingWithinTheThreshold) {
  struct Case {
    double separation, threshold;
    bool isFound;
  };
  const Case cases[] = {{-0.02, 0, true}, {-0.02, 0.1, true}, {0.05, 0.1, true}, {0.05, 0.03, false}, {0.05, 0, false}};
  const auto cube = treeShape(plainTree(cuboid({1, 1, 1}, 4)));
  for (const Below& below : everythingBelow())
    for (const Case& c : cases)
      for (const bool treeAddedFirst : {true, false})
        for (const bool treeAskedFirst : {true, false})
          inWorldOf(GetParam(), [&](auto& w) {
            // A little aside, so that no corner of the cube's mesh is right over the highest point.
            const btVector3 at(btScalar(0.03), btScalar(0.07), btScalar(0.5 + c.separation));
            btRigidBody* tree = treeAddedFirst ? &w.add(cube, 1, at) : nullptr;
            btRigidBody& other = w.add(below.shape, 0, below.origin);
            if (!tree) tree = &w.add(cube, 1, at);
            // Regions of leaves tell the distance to within the tree's error, triangles exactly.
            w.dispatcher.setFinest(bullet::Finest::triangles);
            Points points;
            points.m_closestDistanceThreshold = btScalar(c.threshold);
            if (treeAskedFirst)
              w.world.contactPairTest(tree, &other, points);
            else
              w.world.contactPairTest(&other, tree, points);
            SCOPED_TRACE(std::string(below.name) + ", gap " + std::to_string(c.separation) + ", threshold " +
                         std::to_string(c.threshold) + (treeAskedFirst ? ", tree asked first" : ""));
            ASSERT_EQ(points.count > 0, c.isFound);
            if (!c.isFound) return;
            EXPECT_NEAR(double(points.deepest), c.separation, kDistanceTolerance);
            EXPECT_NEAR(std::abs(points.normalOnB.z()), 1, 1e-3);
            EXPECT_TRUE(points.partner == &other || points.partner == tree);
            EXPECT_EQ(w.dispatcher.getNumManifolds(), 0) << "a query leaves nothing behind";
          });
}

// Metres by which the depth of two cubes of one metre may be less or more than that of Bullet's boxes, which is the
// least over all directions. Leaves measure depth along the faces they touch: at edges that is up to twice the least.
constexpr double kShallower = 0.01, kDeeper = 0.09;

// The depth of two cubes does not depend on the threshold of the query.
TEST(ContactQueryThreshold, DoesNotChangeHowDeepATreeIsInAMesh) {
  const auto box = std::make_shared<btBoxShape>(btVector3(btScalar(0.5), btScalar(0.5), btScalar(0.5)));
  std::mt19937 engine(3);
  std::uniform_real_distribution<float> number(-1, 1);
  const auto turned = [&] {
    const btVector3 axis(number(engine), number(engine), number(engine) + 2);
    return btQuaternion(axis, btScalar(3 * number(engine)));
  };
  int overlapping = 0;
  for (const int cells : {4, 8}) {
    const Solid solid = cuboid({1, 1, 1}, cells);
    const auto tree = treeShape(plainTree(solid));
    const auto mesh = gimpactMesh(solid, 0);
    for (int i = 0; i < 60; ++i) {
      const btQuaternion none = btQuaternion::getIdentity(), ofTree = i % 2 ? turned() : none,
                         ofOther = i % 2 ? turned() : none;
      const btVector3 at = btVector3(number(engine), number(engine), number(engine)) * btScalar(1.3);
      const auto deepest = [&](const std::shared_ptr<btCollisionShape>& first,
                               const std::shared_ptr<btCollisionShape>& second, btScalar threshold) {
        BulletWorld<> w;
        btRigidBody& a = w.add(first, 1, btVector3(0, 0, 0), ofTree);
        btRigidBody& b = w.add(second, 0, at, ofOther);
        Points points;
        points.m_closestDistanceThreshold = threshold;
        w.world.contactPairTest(&a, &b, points);
        return double(points.deepest);
      };
      const double touching = deepest(tree, mesh, 0), ofBoxes = deepest(box, box, 0);
      overlapping += touching < -0.01 ? 1 : 0;
      for (const btScalar threshold : {btScalar(0.1), btScalar(0.2), btScalar(0.4), btScalar(0.6)}) {
        SCOPED_TRACE("cells " + std::to_string(cells) + ", pose " + std::to_string(i) + ", threshold " +
                     std::to_string(threshold));
        const double asked = deepest(tree, mesh, threshold);
        if (touching < 0) EXPECT_NEAR(asked, touching, 1e-4);
        if (touching > 0) EXPECT_GE(asked, -1e-4);
        if (ofBoxes < 0 && ofBoxes > -0.2) {
          EXPECT_LT(asked, ofBoxes + kShallower);
          EXPECT_GT(asked, ofBoxes - kDeeper);
        }
      }
    }
  }
  EXPECT_GT(overlapping, 30);
}

// Of the leaves of what lies below; between trees a point may be anywhere between the two leaves that touch.
constexpr float kMaxOther = 0.307F;

// Whether a point of the body's frame is on the feature of the mesh that a contact names, within the contact distance.
bool isNearFeature(const bullet::SphereTreeShape& shape, int part, int index, const btVector3& point) {
  const auto at = [&](std::uint32_t v) {
    const Vec3& p = shape.tree().vertices()[v];
    return shape.bodyFromTree() * btVector3(btScalar(p.x), btScalar(p.y), btScalar(p.z));
  };
  const auto feature = static_cast<std::uint32_t>(index);
  const btScalar near = bullet::kSpeculativeFraction * shape.size();
  if (part == static_cast<int>(bullet::ContactPart::vertex)) return (at(feature) - point).length() < near;
  if (part == static_cast<int>(bullet::ContactPart::edge)) {
    const auto& [v, w] = shape.tree().surface().features.edges()[feature].vertex;
    return std::abs((at(v) - point).length() + (at(w) - point).length() - (at(v) - at(w)).length()) < near;
  }
  const auto& t = shape.tree().triangles()[feature];
  const btVector3 normal = (at(t[1]) - at(t[0])).cross(at(t[2]) - at(t[0])).normalized();
  return std::abs(normal.dot(point - at(t[0]))) < near;
}

// Pairs of the broad phase, of all kinds at once; the ids lead back to the tree.
TEST_P(ContactQuery, OfAWholeWorldFindsEveryNeighbourOnce) {
  inWorldOf(GetParam(), [&](auto& w) {
    const auto cube = treeShape(plainTree(cuboid({1, 1, 1}, 4)));
    std::vector<const btCollisionObject*> bodies;
    for (const Below& below : everythingBelow()) bodies.push_back(&w.add(below.shape, 0, below.origin));
    btRigidBody& tree = w.add(cube, 1, btVector3(btScalar(0.03), btScalar(0.07), btScalar(0.48)));
    struct Partners final : btCollisionWorld::ContactResultCallback {
      std::set<const btCollisionObject*> found;
      const btCollisionObject* tree = nullptr;
      int wrong = 0, features = 0;
      btScalar addSingleResult(btManifoldPoint& point, const btCollisionObjectWrapper* a, int partA, int indexA,
                               const btCollisionObjectWrapper* b, int partB, int indexB) override {
        const bool treeIsA = a->getCollisionObject() == tree;
        found.insert((treeIsA ? b : a)->getCollisionObject());
        const auto& shape = *bullet::asSphereTree((treeIsA ? a : b)->getCollisionShape());
        const int part = treeIsA ? partA : partB;
        if (part >= static_cast<int>(bullet::ContactPart::vertex)) {
          wrong +=
              isNearFeature(shape, part, treeIsA ? indexA : indexB, treeIsA ? point.m_localPointA : point.m_localPointB)
                  ? 0
                  : 1;
          ++features;
          return 0;
        }
        const auto node = static_cast<NodeId>(treeIsA ? indexA : indexB);
        const btVector3& on = treeIsA ? point.m_localPointA : point.m_localPointB;
        const Sphere leaf = shape.tree().sphere(node);
        const btVector3 center =
            shape.bodyFromTree() * btVector3(btScalar(leaf.center.x), btScalar(leaf.center.y), btScalar(leaf.center.z));
        wrong += shape.tree().isLeaf(node) && static_cast<int>(shape.tree().level(node)) == part &&
                         (on - center).length() < btScalar(leaf.radius + kMaxOther)
                     ? 0
                     : 1;
        return 0;
      }
    } partners;
    partners.tree = &tree;
    w.dispatcher.setFinest(bullet::Finest::triangles);
    w.world.contactTest(&tree, partners);
    EXPECT_EQ(partners.found.size(), bodies.size());
    EXPECT_EQ(partners.wrong, 0)
        << "part: the leaf's level, index: its name, the point near its ball; of trees features";
    EXPECT_GT(partners.features, 0);
  });
}

// A world that registered nothing still answers through the triangles, against convex shapes.
TEST(ContactQueryUnregistered, StillMeetsTheTriangles) {
  BulletWorld<btCollisionDispatcher> w;
  btRigidBody& box = w.add(std::make_shared<btBoxShape>(btVector3(1, 1, 1)), 0, btVector3(0, 0, -1));
  btRigidBody& tree = w.add(treeShape(plainTree(cuboid({1, 1, 1}, 2))), 1, btVector3(0, 0, btScalar(0.49)));
  Points points;
  w.world.contactPairTest(&tree, &box, points);
  EXPECT_GE(points.count, 1);
}

class Ghosts : public testing::TestWithParam<FrontEnd> {};
INSTANTIATE_TEST_SUITE_P(Each, Ghosts, testing::ValuesIn(kEveryFrontEnd));

TEST_P(Ghosts, SeeTreesComeAndGoAndCastAtThem) {
  btGhostPairCallback pairs;
  inWorldOf(GetParam(), [&](auto& w) {
    w.world.getBroadphase()->getOverlappingPairCache()->setInternalGhostPairCallback(&pairs);
    btBoxShape room(btVector3(1, 1, 1));
    btGhostObject ghost;
    ghost.setCollisionShape(&room);
    ghost.setCollisionFlags(btCollisionObject::CF_NO_CONTACT_RESPONSE);
    w.world.addCollisionObject(&ghost, btBroadphaseProxy::SensorTrigger, btBroadphaseProxy::AllFilter);
    btRigidBody& body = w.add(treeShape(plainTree(cuboid({1, 1, 1}, 3))), 1, btVector3(0, 0, 3));
    w.step();
    EXPECT_EQ(ghost.getNumOverlappingObjects(), 0);
    w.step(40);  // it falls into the room
    ASSERT_EQ(ghost.getNumOverlappingObjects(), 1);
    EXPECT_EQ(ghost.getOverlappingObject(0), &body);
    const btVector3 at = body.getWorldTransform().getOrigin(), from = at + btVector3(5, 0, btScalar(0.1));
    btCollisionWorld::ClosestRayResultCallback ray(from, at);
    ghost.rayTest(from, at, ray);
    EXPECT_NEAR(ray.m_closestHitFraction, 0.9, 1e-3);
    const btSphereShape probe(btScalar(0.5));
    btCollisionWorld::ClosestConvexResultCallback sweep(from, at);
    ghost.convexSweepTest(&probe, btTransform(btQuaternion::getIdentity(), from),
                          btTransform(btQuaternion::getIdentity(), at), sweep);
    EXPECT_NEAR(sweep.m_closestHitFraction, 0.8, 1e-3);
    w.step(60);
    EXPECT_EQ(ghost.getNumOverlappingObjects(), 0) << "and out of it";
    w.world.removeCollisionObject(&ghost);
  });
}

// A trigger zone of any shape: the ghost itself is a tree, hollow, and things fall through its middle.
TEST_P(Ghosts, MayBeTreesThemselves) {
  btGhostPairCallback pairs;
  inWorldOf(GetParam(), [&](auto& w) {
    w.world.getBroadphase()->getOverlappingPairCache()->setInternalGhostPairCallback(&pairs);
    const auto ring = treeShape(plainTree(torus(1, 0.25, 24)));
    btPairCachingGhostObject ghost;
    ghost.setCollisionShape(ring.get());
    ghost.setCollisionFlags(btCollisionObject::CF_NO_CONTACT_RESPONSE);
    w.world.addCollisionObject(&ghost, btBroadphaseProxy::SensorTrigger, btBroadphaseProxy::AllFilter);
    const auto contactsAt = [&](const btVector3& place) {
      btRigidBody& ball = w.add(std::make_shared<btSphereShape>(btScalar(0.2)), 1, place);
      ball.setGravity(btVector3(0, 0, 0));
      w.step();
      auto& cache = *ghost.getOverlappingPairCache();
      w.dispatcher.dispatchAllCollisionPairs(&cache, w.world.getDispatchInfo(), &w.dispatcher);
      EXPECT_EQ(cache.getNumOverlappingPairs(), 1);
      btManifoldArray manifolds;
      int contacts = 0;
      for (int i = 0; i < cache.getNumOverlappingPairs(); ++i)
        if (btCollisionAlgorithm* algorithm = cache.getOverlappingPairArray()[i].m_algorithm)
          algorithm->getAllContactManifolds(manifolds);
      for (int i = 0; i < manifolds.size(); ++i) contacts += manifolds[i]->getNumContacts();
      w.remove(ball);
      return contacts;
    };
    EXPECT_GE(contactsAt(btVector3(1, 0, btScalar(0.3))), 1) << "on the tube";
    EXPECT_EQ(contactsAt(btVector3(0, 0, 0)), 0) << "in the hole";
    w.world.removeCollisionObject(&ghost);
  });
}

// As with Bullet's own shapes: a point's index is the child's, and `getChildShape` of it is what was hit.
TEST(Queries_Compound, PointsNameTheChild) {
  const auto box = std::make_shared<btBoxShape>(btVector3(btScalar(0.3), btScalar(0.3), btScalar(0.3)));
  const auto row = std::make_shared<btCompoundShape>();
  for (int i = -1; i <= 1; ++i)
    row->addChildShape(btTransform(btQuaternion::getIdentity(), btVector3(btScalar(i), 0, 0)), box.get());
  BulletWorld<> w;
  w.add(treeShape(plainTree(cuboid({8, 8, 1}, 8))), 0, btVector3(0, 0, btScalar(-0.5)));
  btRigidBody& body = w.add(row, 1, btVector3(0, 0, btScalar(0.31)));
  btRigidBody& above = w.add(treeShape(plainTree(ball(0.3, 6))), 1, btVector3(1, 0, btScalar(0.92)));
  w.step(30);
  std::set<int> found;
  for (int i = 0; i < w.dispatcher.getNumManifolds(); ++i) {
    const btPersistentManifold& m = *w.dispatcher.getManifoldByIndexInternal(i);
    const bool isBody0 = m.getBody0() == &body;
    if (!isBody0 && m.getBody1() != &body) continue;
    for (int k = 0; k < m.getNumContacts(); ++k) {
      const btManifoldPoint& p = m.getContactPoint(k);
      const int child = isBody0 ? p.m_index0 : p.m_index1;
      ASSERT_TRUE(child >= 0 && child < 3) << child;
      const btScalar aside =
          (isBody0 ? p.m_localPointA : p.m_localPointB).x() - row->getChildTransform(child).getOrigin().x();
      EXPECT_LE(std::abs(aside), 0.31) << "child " << child;
      found.insert(child);
      if (m.getBody0() == &above || m.getBody1() == &above) EXPECT_EQ(child, 2);
    }
  }
  EXPECT_EQ(found.size(), 3U);
}

}  // namespace
}  // namespace cairn::test::contact_query_test

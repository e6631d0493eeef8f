// SPDX-License-Identifier: Zlib
// Sphere-trees on signed distance fields: what the traversal finds, and what bodies do on them.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "colliders/field_collider.h"
#include "distance_fields.h"
#include "front_ends.h"
#include "random_tree.h"
#include "still_scenes.h"

namespace cairn::test::field_collider_test {
namespace {

using namespace cairn::bullet;

constexpr std::uint32_t kSeed = 20023;
// Between the speculative distance above the ground and what Bullet's solver leaves below it.
constexpr btScalar kRestTolerance = kSpeculativeFraction;

// Four metres by four, half a metre thick above and below; no face of it lies on a face of a cell.
std::shared_ptr<btSdfCollisionShape> slab() {
  return fieldShape({{-2.5, -2.5, -1}, {2.5, 2.5, 1}, {11, 11, 9}}, boxDistance({2, 2, 0.5}));
}

struct Field {
  const char* name;
  FieldGrid grid;
  Distance distance;
};

// With edges, inward edges, coarse and fine, with cells left out, cut off by its own domain.
std::vector<Field> fields() {
  const Distance cubes = [](const Vec3d& p) {
    return std::min(boxDistance({0.5, 0.5, 0.5})(p), boxDistance({0.5, 0.5, 0.5})(p - Vec3d{0.9, 0.3, 0.2}));
  };
  const auto isFar = [](const Vec3d& p) { return std::abs(length(p) - 1) > 0.6; };
  std::vector<Field> all;
  const auto add = [&](const char* name, const FieldGrid& grid, const Distance& distance) {
    all.push_back({name, grid, distance});
  };
  add("slab", {{-2.5, -2.5, -1}, {2.5, 2.5, 1}, {11, 11, 9}}, boxDistance({2, 2, 0.5}));
  add("ball", {{-2, -2, -2}, {2, 2, 2}, {9, 9, 9}}, ballDistance(1));
  add("sparse ball", {{-2, -2, -2}, {2, 2, 2}, {16, 16, 16}, isFar}, ballDistance(1));
  add("cubes", {{-1.5, -1.5, -1.5}, {2.5, 2, 2}, {9, 8, 7}}, cubes);
  add("cut off", {{-1, -1, -1}, {1, 1, 1}, {5, 5, 5}}, boxDistance({3, 3, 0.5}));
  return all;
}

// Points of the surface that the field has, whatever it was made from.
std::vector<Vec3> surfaceOf(btSdfCollisionShape& shape, const FieldGrid& grid, std::mt19937_64& engine) {
  const auto value = [&](const Vec3d& p) {
    btScalar distance;
    btVector3 gradient;
    const bool isKnown = shape.queryPoint(btVector3(btScalar(p.x), btScalar(p.y), btScalar(p.z)), distance, gradient);
    return isKnown ? double(distance) : std::numeric_limits<double>::quiet_NaN();
  };
  const auto anywhere = [&] {
    return Vec3d{uniform(engine, grid.lower.x, grid.upper.x), uniform(engine, grid.lower.y, grid.upper.y),
                 uniform(engine, grid.lower.z, grid.upper.z)};
  };
  std::vector<Vec3> surface;
  for (int i = 0; i < 30000 && surface.size() < 1500; ++i) {
    Vec3d inside = anywhere(), outside = anywhere();
    if (!(value(inside) <= 0) || !(value(outside) > 0)) continue;
    for (int halving = 0; halving < 30; ++halving) {
      const Vec3d middle = (inside + outside) * 0.5;
      (value(middle) > 0 ? outside : inside) = middle;
    }
    if (value(inside) <= 0) surface.emplace_back(inside);
  }
  return surface;
}

TEST(FieldObstacle_Touches, MissesNothingThatBruteForceFinds) {
  std::mt19937_64 engine(kSeed);
  for (const Field& f : fields()) {
    const auto shape = fieldShape(f.grid, f.distance);
    const std::vector<Vec3> surface = surfaceOf(*shape, f.grid, engine);
    ASSERT_GT(surface.size(), 200U) << f.name;
    DistanceField field;
    field.take(*shape);
    int hits = 0, spared = 0;
    for (int trial = 0; trial < 400; ++trial) {
      const Pose inShape{randomRotation(engine), randomPoint(engine) * 0.5, uniform(engine, 0.3, 2)};
      const auto margin = static_cast<float>(uniform(engine, 0, 0.1));
      FieldObstacle obstacle;
      obstacle.place(relativePose(Pose{}, inShape), field, margin);
      Family family;
      for (std::uint32_t i = 0; i < kFamilyWidth; ++i) {
        const Vec3 center(randomPoint(engine) * 2.0);
        family.x[i] = center.x, family.y[i] = center.y, family.z[i] = center.z;
        family.radius[i] = static_cast<float>(std::exp(uniform(engine, -5, 0)));
      }
      const std::uint32_t size = 1 + static_cast<std::uint32_t>(engine() % kFamilyWidth);
      const std::uint32_t found = obstacle.touches(family, size, 0);
      EXPECT_EQ(found >> size, 0U) << "lanes that are not there";
      for (std::uint32_t i = 0; i < size; ++i) {
        const Vec3 center(inShape * Vec3d(family.x[i], family.y[i], family.z[i]));
        const float reach = family.radius[i] * static_cast<float>(inShape.scale) + margin;
        float nearest = std::numeric_limits<float>::infinity();
        for (const Vec3& p : surface) nearest = std::min(nearest, distance(p, center));
        const bool isHit = (found >> i & 1) != 0;
        if (nearest < reach) {
          EXPECT_TRUE(isHit) << f.name << ", seed " << kSeed << ", trial " << trial << ", lane " << i;
          ++hits;
        }
        if (!isHit) ++spared;
      }
    }
    EXPECT_GT(hits, 100) << f.name << ": what was to be found";
    EXPECT_GT(spared, 300) << f.name << ": an answer that always says yes finds everything too";
  }
}

// A slab long enough to slide and roll on.
Slope fieldSlope(double degrees) {
  Slope slope;
  slope.degrees = degrees;
  slope.ground = fieldShape({{-5, -1.5, -1}, {5, 1.5, 1}, {21, 7, 5}}, boxDistance({4.5, 1, 0.5}));
  slope.top = btScalar(0.5);
  slope.uphill = 3;
  return slope;
}

TriedBody triedBody(const Solid& solid) {
  TriedBody body{treeShape(plainTree(solid)), {}};
  body.shape->calculateLocalInertia(1, body.inertia);
  return body;
}

constexpr double kGravity = 9.81;

TEST(Field_Slope, CuboidSlidesAsTheTextbookSays) {
  for (const int cells : {1, 4}) {
    Slope slope = fieldSlope(30);
    slope.friction = btScalar(0.3);
    slope.height = btScalar(0.2);
    const double angle = std::numbers::pi / 6, expected = kGravity * (std::sin(angle) - 0.3 * std::cos(angle));
    const SlopeRun run = runSlope(triedBody(cuboid({0.6, 0.5, 0.4}, cells)), slope);
    EXPECT_NEAR(run.acceleration, expected, 0.02 * expected) << cells << " cells a side";
    EXPECT_NEAR(run.aside, 0, 0.02) << cells << " cells a side";
  }
}

// A rolling body loses energy to its facets (leaf-contacts.md: up to a quarter), and no more than on a plane.
TEST(Field_Slope, BallRollsAsOnAPlane) {
  constexpr double kRadius = 0.2, kLoss = 0.25;
  // Which facets strike differs with the last bits: 0.3 % of the speed each (`Trials::facetLoss`), of sixteen.
  constexpr double kAlike = 0.05;
  const TriedBody tried = triedBody(ball(kRadius, 16));
  Slope slope = fieldSlope(10);
  slope.height = btScalar(kRadius);
  slope.radius = kRadius;
  const double expected = kGravity * std::sin(slope.degrees * std::numbers::pi / 180) /
                          (1 + double(tried.inertia.x()) / (kRadius * kRadius));
  const SlopeRun run = runSlope(tried, slope);
  EXPECT_NEAR(run.acceleration, expected, kLoss * expected);
  Slope plane = slope;
  plane.ground = std::make_shared<btStaticPlaneShape>(btVector3(0, 0, 1), btScalar(0));
  plane.top = 0;
  EXPECT_NEAR(run.acceleration, runSlope(tried, plane).acceleration, kAlike * expected);
  EXPECT_NEAR(run.slip, 0, 0.05);
  EXPECT_NEAR(run.aside, 0, 0.05);
}

// The corners of a large leaf lie far above round ground that its middle touches.
TEST(Field_Round, CoarseLeavesNeitherFloatNorSinkIn) {
  const auto ground = fieldShape({{-1.5, -1.5, -1.5}, {1.5, 1.5, 1.5}, {13, 13, 13}}, ballDistance(1));
  btScalar offTop = 0;
  btVector3 gradient;
  ASSERT_TRUE(ground->queryPoint(btVector3(0, 0, 1), offTop, gradient));
  for (const int cells : {1, 2, 5})
    for (const btScalar aside : {btScalar(0), btScalar(0.1), btScalar(0.3)}) {
      BulletWorld<> w;
      w.add(ground, 0, btVector3(0, 0, -1));
      btRigidBody& body = w.add(treeShape(plainTree(cuboid({1, 1, 1}, cells))), 1, btVector3(0, aside, btScalar(0.56)));
      body.setLinearFactor(btVector3(0, 0, 1));
      body.setAngularFactor(btVector3(0, 0, 0));
      w.step(200);
      // The speculative distance of a cube, and what the interpolation is off there.
      const btScalar tolerance = kRestTolerance * btScalar(1.7320508) + std::abs(offTop);
      EXPECT_NEAR(body.getWorldTransform().getOrigin().z() - btScalar(0.5), 0, tolerance)
          << cells << " cells a side, " << aside << " m aside";
    }
}

// A field that ends under a body: what is lowest lies beyond its border, where nothing touches, and what is not does.
TEST(Field_Border, BodyAcrossItTouchesWithinIt) {
  const auto ground = fieldShape({{-3, -3, -1}, {1, 3, 1}, {8, 12, 4}}, [](const Vec3d& p) { return p.z; });
  SphereTreeData data = PlainTreeBuilder(ball(1, 10), 100).build();
  for (NodeData& node : data.nodes) {  // as a good builder's are: every leaf's ball all but the whole
    node.center = {};
    node.radius = 1 + 1e-5F;
    node.error = 0.02F;
  }
  const auto tree = std::make_shared<const SphereTree>(std::move(SphereTree::create(std::move(data))).value());
  for (const btScalar x : {btScalar(1.02), btScalar(1.05), btScalar(1.1), btScalar(1.2)}) {
    BulletWorld<> w;
    w.add(ground, 0, btVector3(0, 0, 0));
    w.add(treeShape(tree), 1, btVector3(x, 0, btScalar(0.9)));
    w.world.performDiscreteCollisionDetection();
    int contacts = 0;
    for (int i = 0; i < w.dispatcher.getNumManifolds(); ++i)
      contacts += w.dispatcher.getManifoldByIndexInternal(i)->getNumContacts();
    EXPECT_GT(contacts, 0) << "centre " << x << " m along, the border at 1";
  }
}

class FieldWorlds : public testing::TestWithParam<FrontEnd> {};
INSTANTIATE_TEST_SUITE_P(FrontEnds, FieldWorlds, testing::ValuesIn(kEveryFrontEnd));

std::shared_ptr<btCompoundShape> compoundOf(btCollisionShape* child, btScalar at) {
  auto compound = std::make_shared<btCompoundShape>();
  compound->addChildShape(btTransform(btQuaternion::getIdentity(), btVector3(0, 0, at)), child);
  return compound;
}

TEST_P(FieldWorlds, ChildrenOfCompoundsRest) {
  for (const bool treeIsChild : {false, true})
    for (const bool fieldIsChild : {false, true})
      inWorldOf(GetParam(), [&](auto& w) {
        const auto tree = treeShape(plainTree(cuboid({0.6, 0.5, 0.4}, 4)));
        const auto ground = slab();
        const auto groundBody = fieldIsChild ? std::shared_ptr<btCollisionShape>(compoundOf(ground.get(), 0)) : ground;
        const auto bodyShape = treeIsChild ? std::shared_ptr<btCollisionShape>(compoundOf(tree.get(), 0)) : tree;
        w.add(groundBody, 0, btVector3(0, 0, btScalar(-0.5)));
        btRigidBody& body = w.add(bodyShape, 1, btVector3(0, 0, btScalar(0.23)));
        w.step(120);
        EXPECT_NEAR(body.getWorldTransform().getOrigin().z(), 0.2, kRestTolerance) << treeIsChild << fieldIsChild;
        while (w.world.getNumCollisionObjects() > 0)  // the children's owners go before the world does
          w.world.removeCollisionObject(w.world.getCollisionObjectArray()[0]);
      });
}

TEST_P(FieldWorlds, KinematicFieldLiftsWhatLiesOnIt) {
  inWorldOf(GetParam(), [&](auto& w) {
    btRigidBody& lift = w.add(slab(), 0, btVector3(0, 0, btScalar(-0.5)));
    lift.setCollisionFlags(lift.getCollisionFlags() | btCollisionObject::CF_KINEMATIC_OBJECT);
    lift.setActivationState(DISABLE_DEACTIVATION);
    btRigidBody& body = w.add(treeShape(plainTree(cuboid({0.6, 0.5, 0.4}, 4))), 1, btVector3(0, 0, btScalar(0.2)));
    body.setActivationState(DISABLE_DEACTIVATION);
    for (int i = 1; i <= 120; ++i) {
      btTransform at = lift.getWorldTransform();
      at.setOrigin(btVector3(0, 0, btScalar(-0.5 + 0.5 * i / 60)));
      lift.setWorldTransform(at);
      w.step();
    }
    // It is told where the lift is, and moves with what it was told: half a step's way behind at most.
    EXPECT_NEAR(body.getWorldTransform().getOrigin().z(), 1.2, kRestTolerance + 0.5 / 60);
  });
}

// A body at a field that says nothing moves to the last bit as one alone does.
using Operations = std::optional<std::int64_t>;
void expectNothingIsMet(FrontEnd frontEnd, const std::shared_ptr<btCollisionShape>& ground,
                        const std::vector<Operations>& budgets = {{}, 0, 100}) {
  for (const Operations& budget : budgets)
    inWorldOf(frontEnd, [&](auto& w) {
      BulletWorld<> alone;
      StateHash with, without;
      w.add(ground, 0, btVector3(0, 0, 0));
      ASSERT_TRUE(w.dispatcher.setBudget({budget, {}}).ok());
      const auto shape = treeShape(plainTree(cuboid({0.6, 0.5, 0.4}, 4)));
      const btVector3 at(0, 0, btScalar(1.1));
      btRigidBody &body = w.add(shape, 1, at), &free = alone.add(shape, 1, at);
      w.step(60);
      alone.step(60);
      addState(with, body);
      addState(without, free);
      EXPECT_EQ(with.value(), without.value()) << body.getWorldTransform().getOrigin().z();
    });
}

TEST_P(FieldWorlds, FieldThatWasNotTakenMeetsNothing) {
  FieldFile file({{-2, -2, -1}, {2, 2, 1}, {4, 4, 4}}, boxDistance({1.5, 1.5, 0.5}));
  file.bytes().push_back(0);
  auto shape = std::make_shared<btSdfCollisionShape>();
  ASSERT_FALSE(shape->initializeSDF(file.bytes().data(), static_cast<int>(file.bytes().size())));
  expectNothingIsMet(GetParam(), shape);
}

TEST_P(FieldWorlds, WhatIsNoDistanceMeetsNothing) {
  const FieldGrid grid{{-2, -2, -1}, {2, 2, 1}, {4, 4, 4}};
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  const auto constant = [&](double value) { return fieldShape(grid, [value](const Vec3d&) { return value; }); };
  for (const double value : {nan, infinity, -infinity}) expectNothingIsMet(GetParam(), constant(value));
  // Solid with no way out: no contacts, but guards hold a body before its domain until more is known.
  for (const double value : {0.0, -1.0}) expectNothingIsMet(GetParam(), constant(value), {{}});
  FieldGrid empty = grid;
  empty.isLeftOut = [](const Vec3d&) { return true; };
  expectNothingIsMet(GetParam(), fieldShape(empty, boxDistance({1, 1, 1})));
}

// Its box is whatever was in that memory, so no world is asked to keep it.
TEST(Field_WithoutData, IsMetNowhere) {
  const auto tree = treeShape(plainTree(ball(0.5, 3)));
  const btSdfCollisionShape shape;
  PairPlacement placement;
  placement.treeShape = tree.get();
  placement.treeBody.setIdentity();
  placement.tree = PlacedTree(tree->tree(), Pose{});
  placement.otherShape = &shape;
  placement.other.setIdentity();
  placement.maxSeparation = 0.01F;
  FieldCollider collider;
  std::vector<NodePair> known;
  std::vector<Contact> contacts;
  collider.place(placement);
  collider.start(known, 0);
  Budget budget = Budget::unlimited();
  collider.traversal().refine(budget);
  collider.appendContacts(collider.traversal().leafPairs(), contacts);
  collider.appendRootContacts(contacts);
  EXPECT_TRUE(contacts.empty());
  EXPECT_GE(collider.boundingContact({kRootNode, 0}).separation, placement.maxSeparation);
}

// Bullet's field is not scaled and has no margin, whatever it was told: its own shapes show it.
TEST(Field_Scaling, IsIgnoredAsBulletDoes) {
  const auto ground = slab();
  ground->setLocalScaling(btVector3(2, 2, 2));
  ground->setMargin(btScalar(0.3));
  BulletWorld<> w;
  w.add(ground, 0, btVector3(0, 0, btScalar(-0.5)));
  btRigidBody& body = w.add(treeShape(plainTree(cuboid({0.6, 0.5, 0.4}, 4))), 1, btVector3(-1, 0, btScalar(0.23)));
  btRigidBody& box = w.add(std::make_shared<btBoxShape>(btVector3(btScalar(0.3), btScalar(0.25), btScalar(0.2))), 1,
                           btVector3(1, 0, btScalar(0.23)));
  w.step(180);
  EXPECT_NEAR(body.getWorldTransform().getOrigin().z(), 0.2, kRestTolerance);
  EXPECT_NEAR(box.getWorldTransform().getOrigin().z(), 0.2, 0.01) << "Bullet's contacts begin at depth 0";
}

// The solid goes on to the ends of the domain; what lies beyond holds nothing.
TEST_P(FieldWorlds, BodyThatLeavesTheDomainFalls) {
  inWorldOf(GetParam(), [&](auto& w) {
    btRigidBody& ground = w.add(fieldShape({{-1.5, -1.5, -0.5}, {1.5, 1.5, 0.5}, {6, 6, 2}}, boxDistance({5, 5, 0.25})),
                                0, btVector3(0, 0, btScalar(-0.25)));
    ground.setFriction(0);
    btRigidBody& body = w.add(treeShape(plainTree(cuboid({0.6, 0.5, 0.4}, 4))), 1, btVector3(0, 0, btScalar(0.2)));
    body.setLinearVelocity(btVector3(1, 0, 0));
    w.step(60);
    EXPECT_NEAR(body.getWorldTransform().getOrigin().z(), 0.2, 2 * kRestTolerance) << "on the field";
    w.step(120);
    EXPECT_LT(body.getWorldTransform().getOrigin().z(), -1);
    EXPECT_TRUE(isSane(body));
  });
}

TEST_P(FieldWorlds, OtherDataAreNoticedByWhatLiesStill) {
  inWorldOf(GetParam(), [&](auto& w) {
    w.world.setGravity(btVector3(0, 0, 0));
    const auto ground = slab();
    w.add(ground, 0, btVector3(0, 0, btScalar(-0.5)));
    btRigidBody& body = w.add(treeShape(plainTree(cuboid({0.6, 0.5, 0.4}, 4))), 1, btVector3(0, 0, btScalar(0.45)));
    body.setActivationState(DISABLE_DEACTIVATION);
    w.step(10);
    EXPECT_EQ(body.getWorldTransform().getOrigin().z(), btScalar(0.45))
        << "a quarter of a metre above, so that no leaf is near";
    const Distance box = boxDistance({2, 2, 0.5});
    FieldFile raised({{-2.5, -2.5, -1}, {2.5, 2.5, 1}, {11, 11, 9}},
                     [&](const Vec3d& p) { return box(p - Vec3d(0, 0, 0.3)); });
    ASSERT_TRUE(ground->initializeSDF(raised.bytes().data(), static_cast<int>(raised.bytes().size())));
    w.step(60);
    EXPECT_GT(body.getWorldTransform().getOrigin().z(), 0.49) << "pushed out of what has come up to it";
  });
}

// Guards and known contacts stand in for a traversal that is cut off.
TEST_P(FieldWorlds, BodiesAreHeldOnAnyBudget) {
  for (const std::int64_t operations : {0, 10, 100, 1000})
    inWorldOf(GetParam(), [&](auto& w) {
      ASSERT_TRUE(w.dispatcher.setBudget({operations, {}}).ok());
      w.add(slab(), 0, btVector3(0, 0, btScalar(-0.5)));
      btRigidBody& body = w.add(treeShape(plainTree(cuboid({0.6, 0.5, 0.4}, 4))), 1, btVector3(0, 0, btScalar(0.21)));
      w.step(180);
      ASSERT_TRUE(isSane(body));
      EXPECT_GT(body.getWorldTransform().getOrigin().z(), 0.2 - 0.02) << operations << " operations";
    });
}

}  // namespace
}  // namespace cairn::test::field_collider_test

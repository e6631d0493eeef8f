// SPDX-License-Identifier: Zlib
// The functions that Bullet calls on every shape, beside boxes, inertia and triangles (shape_test.cpp).
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "bullet_world.h"
#include "random_tree.h"

namespace cairn::test::shape_interface_test {
namespace {

using bullet::BodyFrame;
using bullet::SphereTreeShape;

std::vector<btVector3> inBodyFrame(const SphereTreeShape& shape, const Solid& solid) {
  std::vector<btVector3> points;
  for (const Vec3d& v : solid.vertices)
    points.push_back(shape.bodyFromMesh() * (btVector3(btScalar(v.x), btScalar(v.y), btScalar(v.z)) * shape.scale()));
  return points;
}

constexpr btScalar kMargin = btScalar(0.125);

class EveryFrame : public testing::TestWithParam<BodyFrame> {
 protected:
  EveryFrame() {
    shape = SphereTreeShape::create(plainTree(solid), GetParam(), btScalar(1.5)).value();
    shape->setMargin(kMargin);
  }
  Solid solid = twoCuboids({0.5, 0.4, 0.3}, {0.9, 0.2, 0.1}, 3);
  std::unique_ptr<SphereTreeShape> shape;
};

TEST_P(EveryFrame, BoundingSphereIsTheRootsAndHoldsTheGrownSurface) {
  btVector3 center;
  btScalar radius;
  shape->getBoundingSphere(center, radius);
  EXPECT_NEAR(radius, shape->tree().sphere(kRootNode).radius * shape->scale() + kMargin, 1e-6);
  for (const btVector3& p : inBodyFrame(*shape, solid)) EXPECT_LE((p - center).length() + kMargin, radius + 1e-6);
}

TEST_P(EveryFrame, AngularMotionDiscReachesTheFarthestPoint) {
  btScalar farthest = 0;
  for (const btVector3& p : inBodyFrame(*shape, solid)) farthest = std::max(farthest, p.length());
  EXPECT_GE(shape->getAngularMotionDisc(), farthest + kMargin - 1e-6);
  EXPECT_LE(shape->getAngularMotionDisc(), farthest + kMargin + btScalar(2e-4) * shape->size());
}

TEST_P(EveryFrame, ContactBreakingThresholdIsBulletsFractionOfIt) {
  EXPECT_EQ(shape->getContactBreakingThreshold(gContactBreakingThreshold),
            shape->getAngularMotionDisc() * gContactBreakingThreshold);
}

// Shapes of both frames at one place: the principal axes lead from one to the other, whatever the scale.
TEST_P(EveryFrame, PrincipalAxesLeadToTheFrameOfTheSame) {
  btTransform principal;
  btVector3 inertia, expected;
  shape->calculatePrincipalAxisTransform(3, principal, inertia);
  const auto turned = SphereTreeShape::create(shape->sharedTree(), BodyFrame::principalAxes, shape->scale()).value();
  turned->calculateLocalInertia(3, expected);
  EXPECT_EQ(inertia, expected);
  const btTransform meshInBody = principal * turned->bodyFromMesh();
  EXPECT_LT((meshInBody.getOrigin() - shape->bodyFromMesh().getOrigin()).length(), 1e-6);
  for (int i = 0; i < 3; ++i)
    EXPECT_LT((meshInBody.getBasis()[i] - shape->bodyFromMesh().getBasis()[i]).length(), 1e-6);
  if (GetParam() == BodyFrame::principalAxes) EXPECT_EQ(principal, btTransform::getIdentity());
}

INSTANTIATE_TEST_SUITE_P(SphereTreeShape, EveryFrame, testing::Values(BodyFrame::principalAxes, BodyFrame::mesh));

// A cuboid away from its origin, beside Bullet's compound of one box.
TEST(SphereTreeShape_PrincipalAxes, AreBulletsOwn) {
  const Vec3d size{0.4, 1.0, 0.6}, at{2, -1, 0.5};
  Solid solid = cuboid(size, 2);
  for (Vec3d& v : solid.vertices) v += at;
  btTransform principal, expectedPrincipal;
  btVector3 inertia, expected;
  treeShape(plainTree(solid))->calculatePrincipalAxisTransform(3, principal, inertia);

  btBoxShape box(btVector3(btScalar(size.x), btScalar(size.y), btScalar(size.z)) / 2);
  btCompoundShape compound;
  compound.addChildShape(
      btTransform(btQuaternion::getIdentity(), btVector3(btScalar(at.x), btScalar(at.y), btScalar(at.z))), &box);
  const btScalar mass = 3;
  compound.calculatePrincipalAxisTransform(&mass, expectedPrincipal, expected);
  EXPECT_LT((principal.getOrigin() - expectedPrincipal.getOrigin()).length(), 1e-5);
  for (int i = 0; i < 3; ++i)  // the same moment about the same axis, in whatever order
    for (int k = 0; k < 3; ++k)
      if (std::abs(principal.getBasis().getColumn(i).dot(expectedPrincipal.getBasis().getColumn(k))) > btScalar(0.999))
        EXPECT_NEAR(inertia[i], expected[k], 1e-4);
  EXPECT_NEAR(inertia.x() + inertia.y() + inertia.z(), expected.x() + expected.y() + expected.z(), 1e-4);
}

TEST(SphereTreeShape_Scaling, UnevenIsRefusedInOneSentenceAndChangesNothing) {
  const auto shape = treeShape(plainTree(cuboid({1, 1, 1}, 1)), 2);
  testing::internal::CaptureStderr();
  shape->setLocalScaling(btVector3(1, 2, 1));
  const std::string reported = testing::internal::GetCapturedStderr();
  EXPECT_NE(reported.find("uniform scale"), std::string::npos) << reported;
  EXPECT_EQ(std::count(reported.begin(), reported.end(), '\n'), 1);
  EXPECT_EQ(shape->getLocalScaling(), btVector3(2, 2, 2));
  testing::internal::CaptureStderr();
  shape->setLocalScaling(btVector3(3, 3, 3));
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(shape->scale(), 3);
}

TEST(SphereTreeShape_Scaling, ReachesChildrenOfCompounds) {
  const auto shape = treeShape(plainTree(cuboid({1, 1, 1}, 1)));
  btCompoundShape compound;
  compound.addChildShape(btTransform(btQuaternion::getIdentity(), btVector3(1, 0, 0)), shape.get());
  compound.setLocalScaling(btVector3(2, 2, 2));
  EXPECT_EQ(shape->scale(), 2);
  testing::internal::CaptureStderr();
  compound.setLocalScaling(btVector3(2, 4, 2));
  EXPECT_NE(testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(shape->scale(), 2) << "uneven: the tree's size stays";
}

TEST(SphereTreeShape_Margin, HoldsBodiesApart) {
  BulletWorld<> w;
  w.addGround();
  const auto shape = treeShape(plainTree(cuboid({1, 1, 1}, 4)));
  EXPECT_EQ(shape->getMargin(), 0);
  shape->setMargin(kMargin);
  btRigidBody& body = w.add(shape, 1, btVector3(0, 0, btScalar(0.7)));
  w.step(240);
  EXPECT_NEAR(body.getWorldTransform().getOrigin().z(), 0.5 + kMargin, 0.01);
}

TEST(SphereTreeShape_Margin, OfNoLengthIsRefusedInOneSentenceAndChangesNothing) {
  const auto shape = treeShape(plainTree(cuboid({1, 1, 1}, 1)));
  shape->setMargin(kMargin);
  for (const btScalar wrong : {btScalar(-0.1), btScalar(NAN), btScalar(INFINITY)}) {
    testing::internal::CaptureStderr();
    shape->setMargin(wrong);
    const std::string reported = testing::internal::GetCapturedStderr();
    EXPECT_EQ(std::count(reported.begin(), reported.end(), '\n'), 1) << reported;
    EXPECT_EQ(shape->getMargin(), kMargin);
  }
}

// At 1e10 times the size what it touched became no number.
TEST(SphereTreeShape_Margin, ThatDwarfsTheMeshIsRefusedAndNeighboursStayNumbers) {
  const auto shape = treeShape(plainTree(cuboid({1, 1, 1}, 3))), other = treeShape(plainTree(cuboid({1, 1, 1}, 3)));
  const btScalar most = shape->size() * btScalar(1 << 23);
  BulletWorld<> w;
  w.addGround();
  w.add(shape, 1, btVector3(0, 0, btScalar(0.5)));
  const btRigidBody& neighbour = w.add(other, 1, btVector3(0, 0, btScalar(1.5)));
  w.step(20);
  for (const btScalar margin : {most * btScalar(1.01), btScalar(1e10), btScalar(1e19), btScalar(1e30)}) {
    testing::internal::CaptureStderr();
    shape->setMargin(margin);
    const std::string reported = testing::internal::GetCapturedStderr();
    EXPECT_EQ(std::count(reported.begin(), reported.end(), '\n'), 1) << reported;
    EXPECT_EQ(shape->getMargin(), 0);
    w.step(20);
    ASSERT_TRUE(isSane(neighbour)) << margin;
  }
  testing::internal::CaptureStderr();
  shape->setMargin(most * btScalar(0.99));
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  w.step(60);
  EXPECT_TRUE(isSane(neighbour));
}

TEST(SphereTreeShape_Name, IsThatOfTheKind) {
  EXPECT_STREQ(treeShape(plainTree(cuboid({1, 1, 1}, 1)))->getName(), "CairnSphereTree");
}

// Shapes of a tree and bodies of a shape add nothing to it.
TEST(SphereTreeShape_Memory, OfOneTreeIsSharedByAllItsShapesAndBodies) {
  auto tree = plainTree(ball(0.3, 12));
  const SphereTree* const only = tree.get();
  const std::size_t treeBytes = tree->memoryBytes();
  BulletWorld<> w;
  std::vector<std::shared_ptr<SphereTreeShape>> shapes;
  for (int i = 0; i < 20; ++i) shapes.push_back(treeShape(tree, btScalar(1 + i % 3)));
  for (int i = 0; i < 200; ++i) w.add(shapes[static_cast<std::size_t>(i % 20)], 1, btVector3(0, 0, btScalar(2 * i)));
  EXPECT_EQ(tree.use_count(), 1 + 20) << "one for each shape, none for a body";
  tree.reset();
  for (const auto& shape : shapes) {
    EXPECT_EQ(&shape->tree(), only);
    EXPECT_LT(shape->memoryBytes(), treeBytes / 4);
    EXPECT_GT(shape->memoryBytes(), sizeof(SphereTreeShape));
  }
  const std::weak_ptr<const SphereTree> last = shapes[0]->sharedTree();
  w.step(10);
  EXPECT_EQ(last.use_count(), 20) << "a step takes none";
}

}  // namespace
}  // namespace cairn::test::shape_interface_test

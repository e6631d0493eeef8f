// SPDX-License-Identifier: Zlib
// The file that btDefaultSerializer makes of a world with sphere-trees, loaded by Bullet's own importer and by ours.
#include <BulletWorldImporter/btBulletWorldImporter.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <set>

#include "bullet_world.h"
#include "cairn/bullet/world_importer.h"
#include "random_tree.h"
#include "saved_world.h"

namespace cairn::test::bullet_file_test {
namespace {

using bullet::BodyFrame;
using bullet::SphereTreeShape;
using bullet::WorldImporter;
using Bytes = std::vector<std::byte>;

// The file holds the spheres in float, whatever the precision.
constexpr double kFloatRounding = 1e-6;

// An importer that takes what it loaded with it.
template <class Importer>
struct Loaded : Importer {
  using Importer::Importer;
  ~Loaded() override { this->deleteAllData(); }
};
using StockImporter = Loaded<btBulletWorldImporter>;
using TreeImporter = Loaded<WorldImporter>;

bool load(StockImporter& importer, Bytes& file) {
  return importer.loadFileFromMemory(reinterpret_cast<char*>(file.data()), static_cast<int>(file.size()));
}

btTransform randomPose(std::mt19937_64& engine) {
  const Mat3d r = randomRotation(engine);
  const Vec3d p = randomPoint(engine) * 5;
  return btTransform(btMatrix3x3(r(0, 0), r(0, 1), r(0, 2), r(1, 0), r(1, 1), r(1, 2), r(2, 0), r(2, 1), r(2, 2)),
                     btVector3(p.x, p.y, p.z));
}

void expectSameBody(const btCollisionObject& saved, const btCollisionObject& loaded) {
  const btTransform &s = saved.getWorldTransform(), &l = loaded.getWorldTransform();
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(s.getOrigin()[i], l.getOrigin()[i]);
    for (int j = 0; j < 3; ++j) EXPECT_EQ(s.getBasis()[i][j], l.getBasis()[i][j]);
  }
  const btRigidBody &body = *btRigidBody::upcast(&saved), &copy = *btRigidBody::upcast(&loaded);
  EXPECT_NEAR(copy.getInvMass(), body.getInvMass(), kFloatRounding);
  EXPECT_EQ(copy.getFriction(), body.getFriction());
}

// Four bodies with trees, two of them with one shape, on a plane.
class SavedWorld {
 public:
  SavedWorld() {
    std::mt19937_64 engine(5);
    shapeA = SphereTreeShape::create(treeA, BodyFrame::principalAxes, btScalar(1.5)).value();
    shapeA->setMargin(btScalar(0.0625));
    shapeA2 = treeShape(treeA, btScalar(0.5));
    shapeA2->setCompoundLevel(treeA->depth());
    shapeB = treeShape(treeB);
    w.addGround();
    const std::shared_ptr<btCollisionShape> shapes[] = {shapeA, shapeA, shapeA2, shapeB};
    for (int i = 0; i < 4; ++i) {
      btRigidBody& body = w.add(shapes[i], btScalar(i == 3 ? 0 : 1 + 2 * i), btVector3(0, 0, 0));
      body.setWorldTransform(randomPose(engine));
      body.setFriction(btScalar(0.25) * btScalar(i));
    }
    file = saved(w.world, {{shapeA.get(), "rock"}, {shapeB.get(), "pebble"}, {&body(1), "first"}});
  }
  const btCollisionObject& body(int i) { return *w.world.getCollisionObjectArray()[i]; }

  std::shared_ptr<const SphereTree> treeA = plainTree(twoCuboids({0.5, 0.4, 0.3}, {0.9, 0.2, 0.1}, 3)),
                                    treeB = plainTree(ball(0.3, 5));
  BulletWorld<> w;
  std::shared_ptr<SphereTreeShape> shapeA, shapeA2, shapeB;
  Bytes file;
};

void expectSpheresOf(const SphereTreeShape& shape, const btCollisionShape* loaded) {
  ASSERT_EQ(loaded->getShapeType(), COMPOUND_SHAPE_PROXYTYPE);
  const auto& compound = static_cast<const btCompoundShape&>(*loaded);
  const std::vector<NodeId> nodes = shape.tree().levelCut(shape.compoundLevel());
  ASSERT_EQ(compound.getNumChildShapes(), static_cast<int>(nodes.size()));
  const double rounding = kFloatRounding * double(shape.size());
  for (int i = 0; i < compound.getNumChildShapes(); ++i) {
    ASSERT_EQ(compound.getChildShape(i)->getShapeType(), SPHERE_SHAPE_PROXYTYPE);
    const Sphere sphere = shape.tree().sphere(nodes[static_cast<std::size_t>(i)]);
    const auto& ball = static_cast<const btSphereShape&>(*compound.getChildShape(i));
    EXPECT_NEAR(ball.getRadius(), btScalar(sphere.radius) * shape.scale() + shape.getMargin(), rounding);
    EXPECT_EQ(ball.getMargin(), ball.getRadius());
    const btVector3 center =
        shape.bodyFromTree() * (btVector3(sphere.center.x, sphere.center.y, sphere.center.z) * shape.scale());
    EXPECT_LT((compound.getChildTransform(i).getOrigin() - center).length(), rounding);
  }
}

TEST(BulletFile, StockImporterLoadsCompoundsOfSpheres) {
  SavedWorld s;
  StockImporter importer;
  ASSERT_TRUE(load(importer, s.file));
  ASSERT_EQ(importer.getNumRigidBodies(), 5);
  for (int i = 0; i < 5; ++i) expectSameBody(s.body(i), *importer.getRigidBodyByIndex(i));
  expectSpheresOf(*s.shapeA, importer.getRigidBodyByIndex(1)->getCollisionShape());
  expectSpheresOf(*s.shapeA2, importer.getRigidBodyByIndex(3)->getCollisionShape());
  expectSpheresOf(*s.shapeB, importer.getRigidBodyByIndex(4)->getCollisionShape());
  EXPECT_EQ(importer.getRigidBodyByIndex(1)->getCollisionShape(), importer.getRigidBodyByIndex(2)->getCollisionShape());
  EXPECT_EQ(importer.getCollisionShapeByName("rock"), importer.getRigidBodyByIndex(1)->getCollisionShape());
}

TEST(BulletFile, StockImporterMakesNoShapeTwice) {
  SavedWorld s;
  StockImporter importer;
  ASSERT_TRUE(load(importer, s.file));
  const auto spheres = [](const SphereTreeShape& shape) {
    return static_cast<int>(shape.tree().levelCut(shape.compoundLevel()).size());
  };
  EXPECT_EQ(importer.getNumCollisionShapes(), 1 + 3 + spheres(*s.shapeA) + spheres(*s.shapeA2) + spheres(*s.shapeB));
}

const SphereTreeShape& treeOf(const btCollisionObject& object) {
  const SphereTreeShape* shape = bullet::asSphereTree(object.getCollisionShape());
  if (shape == nullptr) throw std::runtime_error("not a sphere-tree");
  return *shape;
}

void expectSameShape(const SphereTreeShape& saved, const SphereTreeShape& loaded) {
  EXPECT_EQ(loaded.tree().data(), saved.tree().data());
  EXPECT_EQ(loaded.scale(), saved.scale());
  EXPECT_EQ(loaded.getMargin(), saved.getMargin());
  EXPECT_EQ(loaded.bodyFrame(), saved.bodyFrame());
  EXPECT_EQ(loaded.bodyFromMesh(), saved.bodyFromMesh());
}

TEST(BulletFile, OurImporterGivesTheTreesBack) {
  SavedWorld s;
  TreeImporter importer;
  const Status status = importer.loadFileFromMemory(s.file);
  ASSERT_TRUE(status.ok()) << status.error().message;
  ASSERT_EQ(importer.getNumRigidBodies(), 5);
  for (int i = 0; i < 5; ++i) expectSameBody(s.body(i), *importer.getRigidBodyByIndex(i));
  const SphereTreeShape* shapes[] = {s.shapeA.get(), s.shapeA.get(), s.shapeA2.get(), s.shapeB.get()};
  for (int i = 0; i < 4; ++i) expectSameShape(*shapes[i], treeOf(*importer.getRigidBodyByIndex(i + 1)));
  const btRigidBody& body = *btRigidBody::upcast(importer.getRigidBodyByIndex(1));
  EXPECT_EQ(body.getInvInertiaDiagLocal(), btRigidBody::upcast(&s.body(1))->getInvInertiaDiagLocal());
}

TEST(BulletFile, SharedTreesAndShapesAreSharedAgainAndStoredOnce) {
  SavedWorld s;
  EXPECT_EQ(countOf(s.file, "CARN"), 2 * 2) << "one chunk a tree, and each begins with the identifier of a .cairn file";
  TreeImporter importer;
  ASSERT_TRUE(importer.loadFileFromMemory(s.file).ok());
  const auto& first = treeOf(*importer.getRigidBodyByIndex(1));
  EXPECT_EQ(&first, &treeOf(*importer.getRigidBodyByIndex(2)));
  EXPECT_EQ(first.sharedTree(), treeOf(*importer.getRigidBodyByIndex(3)).sharedTree());
  EXPECT_NE(first.sharedTree(), treeOf(*importer.getRigidBodyByIndex(4)).sharedTree());
  EXPECT_EQ(first.sharedTree().use_count(), 2) << "two shapes, and nothing left behind";
}

TEST(BulletFile, NamesLeadToTheTrees) {
  SavedWorld s;
  TreeImporter importer;
  ASSERT_TRUE(importer.loadFileFromMemory(s.file).ok());
  EXPECT_EQ(importer.getCollisionShapeByName("rock"), &treeOf(*importer.getRigidBodyByIndex(1)));
  EXPECT_EQ(importer.getCollisionShapeByName("pebble"), &treeOf(*importer.getRigidBodyByIndex(4)));
  EXPECT_STREQ(importer.getNameForPointer(&treeOf(*importer.getRigidBodyByIndex(1))), "rock");
  EXPECT_EQ(importer.getRigidBodyByName("first"), importer.getRigidBodyByIndex(1));
  EXPECT_EQ(importer.getNumCollisionShapes(), 1 + 3) << "a plane and three trees; what stood in for them is gone";
}

TEST(BulletFile, BodiesArePutIntoTheWorldAndMeetThere) {
  SavedWorld s;
  BulletWorld<> w;
  TreeImporter importer(&w.world);
  ASSERT_TRUE(importer.loadFileFromMemory(s.file).ok());
  EXPECT_EQ(w.world.getNumCollisionObjects(), 5);
  EXPECT_EQ(w.world.getGravity(), s.w.world.getGravity());
  w.step(30);
  s.w.step(30);
  for (int i = 0; i < 5; ++i) {
    const btVector3 moved = w.world.getCollisionObjectArray()[i]->getWorldTransform().getOrigin();
    EXPECT_LT((moved - s.body(i).getWorldTransform().getOrigin()).length(), 1e-3) << "body " << i;
  }
  importer.deleteAllData();
}

TEST(BulletFile, WhatIsLoadedIsSavedAsTheSame) {
  SavedWorld s;
  const Bytes before = s.file;
  BulletWorld<> w;
  TreeImporter importer(&w.world);
  ASSERT_TRUE(importer.loadFileFromMemory(s.file).ok());
  Bytes again = saved(w.world);
  const auto first = bullet::readStoredShapes(before), second = bullet::readStoredShapes(again);
  ASSERT_TRUE(first.ok() && second.ok());
  ASSERT_EQ(first.value().size(), second.value().size());
  for (std::size_t i = 0; i < first.value().size(); ++i) {
    EXPECT_EQ(first.value()[i].tree->data(), second.value()[i].tree->data());
    EXPECT_EQ(first.value()[i].scale, second.value()[i].scale);
  }
  importer.deleteAllData();
}

TEST(BulletFile, TreesAreChildrenOfCompounds) {
  const auto tree = plainTree(ball(0.3, 5));
  const auto shape = treeShape(tree);
  auto inner = std::make_shared<btCompoundShape>();
  inner->addChildShape(btTransform(btQuaternion::getIdentity(), btVector3(0, 0, 2)), shape.get());
  auto outer = std::make_shared<btCompoundShape>();
  btSphereShape ball(btScalar(0.5));
  btCompoundShape empty;
  outer->addChildShape(btTransform(btQuaternion::getIdentity(), btVector3(1, 0, 0)), &ball);
  outer->addChildShape(btTransform(btQuaternion::getIdentity(), btVector3(-1, 0, 0)), &empty);
  outer->addChildShape(btTransform(btQuaternion::getIdentity(), btVector3(2, 0, 0)), shape.get());
  outer->addChildShape(btTransform(btQuaternion::getIdentity(), btVector3(0, 3, 0)), inner.get());
  BulletWorld<> w;
  w.add(outer, 2, btVector3(0, 0, 1));
  w.add(shape, 1, btVector3(0, 0, 9));  // Bullet writes its chunk once more
  Bytes file = saved(w.world, {{shape.get(), "rock"}}), copy = file;

  StockImporter stock;
  ASSERT_TRUE(load(stock, copy));
  ASSERT_EQ(stock.getNumRigidBodies(), 2);
  expectSpheresOf(*shape, stock.getRigidBodyByIndex(1)->getCollisionShape());
  expectSpheresOf(*shape,
                  static_cast<btCompoundShape*>(stock.getRigidBodyByIndex(0)->getCollisionShape())->getChildShape(2));

  TreeImporter importer;
  const Status status = importer.loadFileFromMemory(file);
  ASSERT_TRUE(status.ok()) << status.error().message;
  const auto& body = *btRigidBody::upcast(importer.getRigidBodyByIndex(0));
  const auto& compound = static_cast<const btCompoundShape&>(*body.getCollisionShape());
  ASSERT_EQ(compound.getNumChildShapes(), 4);
  EXPECT_EQ(compound.getChildShape(0)->getShapeType(), SPHERE_SHAPE_PROXYTYPE);
  EXPECT_TRUE(compound.getChildShape(1)->isCompound());
  const SphereTreeShape* own = bullet::asSphereTree(compound.getChildShape(2));
  ASSERT_NE(own, nullptr);
  expectSameShape(*shape, *own);
  const auto& nested = static_cast<const btCompoundShape&>(*compound.getChildShape(3));
  EXPECT_EQ(nested.getChildShape(0), own);
  EXPECT_EQ(compound.getChildTransform(2).getOrigin(), btVector3(2, 0, 0));
  EXPECT_EQ(importer.getRigidBodyByIndex(1)->getCollisionShape(), own);
  EXPECT_EQ(importer.getCollisionShapeByName("rock"), own);
  const auto& before = *btRigidBody::upcast(w.world.getCollisionObjectArray()[0]);
  EXPECT_NEAR(body.getInvInertiaDiagLocal().x(), before.getInvInertiaDiagLocal().x(), 1e-4);
}

// Two blocks of one tree, as tests/data holds them from both precisions.
struct Blocks {
  std::shared_ptr<SphereTreeShape> shape = treeShape(plainTree(cuboid({1, 2, 3}, 1)), btScalar(1.5));
  BulletWorld<> w;
  Blocks() {
    shape->setMargin(btScalar(0.0625));
    for (int i = 0; i < 2; ++i) w.add(shape, btScalar(1 + i), btVector3(btScalar(4 * i), btScalar(0.5), -2));
  }
};
const std::filesystem::path kData = CAIRN_TEST_DATA_DIR;

// A file of this precision has the size of the stored one, addresses in it aside, and reads as it does. After
// a change on purpose copy the new one, whose place is printed, into tests/data.
TEST(BulletFile, ThisPrecisionWritesWhatIsHeld) {
  Blocks blocks;
  const char* name = sizeof(btScalar) == 4 ? "blocks_float.bullet" : "blocks_double.bullet";
  const std::filesystem::path fresh = std::filesystem::path(testing::TempDir()) / (std::string("written_") + name);
  ASSERT_TRUE(writeFileAtomically(fresh, saved(blocks.w.world)).ok());
  EXPECT_EQ(std::filesystem::file_size(fresh), std::filesystem::file_size(kData / name)) << fresh;
  for (const std::filesystem::path& file : {fresh, kData / name}) {
    TreeImporter importer;
    const Status status = importer.loadFile(file);
    ASSERT_TRUE(status.ok()) << status.error().message;
    ASSERT_EQ(importer.getNumRigidBodies(), 2);
    for (int i = 0; i < 2; ++i)
      expectSameBody(*blocks.w.world.getCollisionObjectArray()[i], *importer.getRigidBodyByIndex(i));
  }
}

TEST(BulletFile, FilesOfBothPrecisionsAreRead) {
  Blocks blocks;
  for (const char* name : {"blocks_float.bullet", "blocks_double.bullet"}) {
    TreeImporter importer;
    const Status status = importer.loadFile(kData / name);
    ASSERT_TRUE(status.ok()) << status.error().message;
    ASSERT_EQ(importer.getNumRigidBodies(), 2);
    for (int i = 0; i < 2; ++i) {
      const btCollisionObject& body = *importer.getRigidBodyByIndex(i);
      expectSameBody(*blocks.w.world.getCollisionObjectArray()[i], body);
      expectSameShape(*blocks.shape, treeOf(body));
    }
    StockImporter stock;
    ASSERT_TRUE(stock.loadFile((kData / name).c_str()));
    expectSpheresOf(*blocks.shape, stock.getRigidBodyByIndex(1)->getCollisionShape());
  }
}

TEST(BulletFile, ADamagedTreeLoadsNothing) {
  SavedWorld s;
  const Bytes letters = {std::byte{'C'}, std::byte{'A'}, std::byte{'R'}, std::byte{'N'}};
  const auto tree = std::search(s.file.begin(), s.file.end(), letters.begin(), letters.end());
  *(tree + 200) ^= std::byte{1};
  Bytes copy = s.file;
  TreeImporter importer;
  const Status status = importer.loadFileFromMemory(s.file);
  ASSERT_FALSE(status.ok());
  EXPECT_NE(status.error().message.find("damaged"), std::string::npos) << status.error().message;
  EXPECT_EQ(importer.getNumRigidBodies(), 0);
  EXPECT_EQ(importer.getNumCollisionShapes(), 0);
  StockImporter stock;
  EXPECT_TRUE(load(stock, copy)) << "the compounds are whole";
  EXPECT_EQ(stock.getNumRigidBodies(), 5);
}

TEST(BulletFile, ErrorsNameTheFile) {
  const auto path = std::filesystem::temp_directory_path() / "cairn_cut_short.bullet";
  SavedWorld s;
  std::ofstream(path, std::ios::binary).write(reinterpret_cast<const char*>(s.file.data()), 300);
  TreeImporter importer;
  const Status status = importer.loadFile(path);
  std::filesystem::remove(path);
  ASSERT_FALSE(status.ok());
  EXPECT_NE(status.error().message.find("cairn_cut_short.bullet is cut short"), std::string::npos)
      << status.error().message;
  EXPECT_FALSE(importer.loadFile(path / "nothing.bullet").ok());
}

TEST(BulletFile, FilesWithoutTreesLoadAsEver) {
  BulletWorld<> w;
  w.addGround();
  w.add(std::make_shared<btBoxShape>(btVector3(1, 1, 1)), 1, btVector3(0, 0, 3));
  Bytes file = saved(w.world);
  TreeImporter importer;
  const Status status = importer.loadFileFromMemory(file);
  ASSERT_TRUE(status.ok()) << status.error().message;
  EXPECT_EQ(importer.getNumRigidBodies(), 2);
}

}  // namespace
}  // namespace cairn::test::bullet_file_test

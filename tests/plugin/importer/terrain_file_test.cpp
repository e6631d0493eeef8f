// SPDX-License-Identifier: Zlib
// A `.bullet` file holds no terrain: whoever saves one is told, and what stands beside it is loaded.
#include <BulletWorldImporter/btBulletWorldImporter.h>
#include <gtest/gtest.h>

#include "bullet_world.h"
#include "cairn/bullet/world_importer.h"
#include "saved_world.h"
#include "terrains.h"

namespace cairn::test::terrain_file_test {
namespace {

template <class Importer>
struct Loaded : Importer {
  using Importer::Importer;
  ~Loaded() override { this->deleteAllData(); }
};

TEST(SavedTerrain, IsLeftOutAndSaysSo) {
  BulletWorld<> w;
  w.add(flatTerrain(bullet::TerrainDiagonals::rising, {5, 5, 1}), 0, btVector3(0, 0, 0));
  w.add(treeShape(plainTree(ball(0.5, 4))), 2, btVector3(1, 2, 3));
  testing::internal::CaptureStderr();
  std::vector<std::byte> file = saved(w.world);
  EXPECT_EQ(testing::internal::GetCapturedStderr(),
            "cairn: a terrain's heights are not written to .bullet files: make it again from its grid\n");
  const auto expectTheTree = [](btBulletWorldImporter& importer) {
    ASSERT_EQ(importer.getNumRigidBodies(), 1);
    EXPECT_EQ(importer.getRigidBodyByIndex(0)->getWorldTransform().getOrigin(), btVector3(1, 2, 3));
  };
  Loaded<btBulletWorldImporter> stock(nullptr);
  std::vector<std::byte> bytes = file;  // a loader may change them
  ASSERT_TRUE(stock.loadFileFromMemory(reinterpret_cast<char*>(bytes.data()), static_cast<int>(bytes.size())));
  expectTheTree(stock);
  Loaded<bullet::WorldImporter> trees(nullptr);
  ASSERT_TRUE(trees.loadFileFromMemory(file).ok());
  expectTheTree(trees);
  EXPECT_NE(bullet::asSphereTree(trees.getRigidBodyByIndex(0)->getCollisionShape()), nullptr);
}

}  // namespace
}  // namespace cairn::test::terrain_file_test

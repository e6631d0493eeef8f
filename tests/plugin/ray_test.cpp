// SPDX-License-Identifier: Zlib
// Rays at a sphere-tree: the same hits as from all triangles one by one, through every way Bullet asks.
#include <gtest/gtest.h>

#include <BulletCollision/NarrowPhaseCollision/btRaycastCallback.h>

#include <algorithm>
#include <tuple>
#include <vector>

#include "bullet_world.h"
#include "casts.h"

namespace cairn::test {
namespace {

struct Hit {
  btScalar fraction;
  int part, triangle;
  btVector3 normal;

  auto key() const { return std::tuple(triangle, part, fraction, normal.x(), normal.y(), normal.z()); }
  bool operator==(const Hit& other) const { return key() == other.key(); }
  bool operator<(const Hit& other) const { return key() < other.key(); }
};

struct Collect final : btTriangleRaycastCallback {
  Collect(const Way& way, unsigned int flags, bool wantsAll)
      : btTriangleRaycastCallback(way.from, way.to, flags), all(wantsAll) {}
  btScalar reportHit(const btVector3& normal, btScalar fraction, int part, int triangle) override {
    hits.push_back({fraction, part, triangle, normal});
    return all ? m_hitFraction : fraction;
  }
  void processTriangle(btVector3* triangle, int part, int index) override {
    ++asked;
    btTriangleRaycastCallback::processTriangle(triangle, part, index);
  }
  const bool all;
  std::vector<Hit> hits;
  std::size_t asked = 0;
};

using Flags = btTriangleRaycastCallback::EFlags;
constexpr unsigned int kEveryFlags[] = {Flags::kF_None, Flags::kF_FilterBackfaces, Flags::kF_KeepUnflippedNormal,
                                        Flags::kF_FilterBackfaces | Flags::kF_KeepUnflippedNormal};

std::vector<std::shared_ptr<bullet::SphereTreeShape>> everyShape() {
  return {treeShape(plainTree(twoCuboids({0.5, 0.4, 0.3}, {0.9, 0.2, 0.1}, 6), 3), btScalar(1.7)),
          treeShape(plainTree(ball(1, 12), 8), btScalar(0.01)), treeShape(plainTree(torus(1, 0.3, 24), 2)),
          treeShape(plainTree(cuboid({1, 1, 1}, 1), 1), btScalar(30))};
}

struct Totals {
  std::size_t rays = 0, hits = 0, asked = 0, triangles = 0;
};

// Compares one ray's hits with the oracle's, all or the closest one.
void expectSameHits(const bullet::SphereTreeShape& shape, const Way& way, unsigned int flags, bool all,
                    Totals& totals) {
  Collect fast(way, flags, all), slow(way, flags, all);
  btVector3 lower = way.from, upper = way.from;
  lower.setMin(way.to);
  upper.setMax(way.to);
  shape.processAllTriangles(&fast, lower, upper);
  castOverAll(shape, slow);
  ++totals.rays;
  totals.hits += slow.hits.empty() ? 0 : 1;
  totals.asked += fast.asked;
  totals.triangles += slow.asked;
  if (all) {
    std::sort(fast.hits.begin(), fast.hits.end());
    std::sort(slow.hits.begin(), slow.hits.end());
    ASSERT_TRUE(fast.hits == slow.hits) << fast.hits.size() << " hits instead of " << slow.hits.size();
    return;
  }
  ASSERT_EQ(fast.hits.empty(), slow.hits.empty());
  if (!fast.hits.empty()) ASSERT_EQ(fast.hits.back().fraction, slow.hits.back().fraction);
}

TEST(Ray, FindsWhatAllTrianglesGiveWhateverIsAskedFor) {
  constexpr std::uint64_t kSeed = 20;
  std::mt19937_64 engine(kSeed);
  Totals totals;
  for (const auto& shape : everyShape())
    for (int trial = 0; trial < 4000; ++trial) {
      // From within the body to three hundred of its sizes away.
      const Way way = randomWay(engine, double(shape->size()), std::pow(10, uniform(engine, -1, 2.5)));
      SCOPED_TRACE("seed " + std::to_string(kSeed) + ", trial " + std::to_string(trial));
      expectSameHits(*shape, way, kEveryFlags[engine() % 4], trial % 2 == 0, totals);
      if (testing::Test::HasFatalFailure()) return;
    }
  EXPECT_GT(totals.hits, totals.rays / 8);
  std::printf("%zu rays, %zu hit; %.1f triangles asked a ray, of %.0f\n", totals.rays, totals.hits,
              double(totals.asked) / double(totals.rays), double(totals.triangles) / double(totals.rays));
}

// Rays in the planes of faces, through corners and along edges: what is a hit there is decided by roundings, which must
// be the same.
TEST(Ray, AlongEdgesAndFacesFindsWhatAllTrianglesGive) {
  constexpr std::uint64_t kSeed = 21;
  std::mt19937_64 engine(kSeed);
  Totals totals;
  for (const double scale : {1.0, 0.3}) {
    const auto shape = treeShape(plainTree(cuboid({1, 1, 1}, 4), 2), btScalar(scale));
    const auto onGrid = [&] { return scale * (static_cast<double>(engine() % 9) / 8 - 0.5); };
    for (int trial = 0; trial < 4000; ++trial) {
      Vec3d from(onGrid(), onGrid(), onGrid()), to(onGrid(), onGrid(), onGrid());
      from[static_cast<int>(engine() % 3)] = scale * (engine() % 2 == 0 ? 2 : -2);
      if (engine() % 2 == 0) to = from;
      to[static_cast<int>(engine() % 3)] = scale * (engine() % 2 == 0 ? 3 : -3);
      SCOPED_TRACE("seed " + std::to_string(kSeed) + ", trial " + std::to_string(trial));
      expectSameHits(*shape, {toBt(from), toBt(to)}, kEveryFlags[engine() % 4], trial % 2 == 0, totals);
      if (testing::Test::HasFatalFailure()) return;
    }
  }
  EXPECT_GT(totals.hits, totals.rays / 8);
}

}  // namespace
}  // namespace cairn::test

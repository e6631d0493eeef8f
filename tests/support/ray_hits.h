// SPDX-License-Identifier: Zlib
#pragma once

#include <BulletCollision/NarrowPhaseCollision/btRaycastCallback.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <tuple>
#include <vector>

#include "casts.h"

namespace cairn::test {

struct Hit {
  btScalar fraction;
  int part, triangle;
  btVector3 normal;

  auto key() const { return std::tuple(triangle, part, fraction, normal.x(), normal.y(), normal.z()); }
  bool operator==(const Hit& other) const { return key() == other.key(); }
  bool operator<(const Hit& other) const { return key() < other.key(); }
};

/// Bullet's ray callback that keeps what it hits, all of it or ever nearer ones, and counts the triangles it is asked
/// about.
struct RayHits final : btTriangleRaycastCallback {
  RayHits(const Way& way, unsigned int flags, bool wantsAll)
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

/// The hits of many rays.
struct RayTotals {
  std::size_t rays = 0, hits = 0, asked = 0, triangles = 0;
};

/// Compares one ray's hits at a shape with those of all its triangles one by one: all, or the closest one.
inline void expectSameHits(const btConcaveShape& shape, const Way& way, unsigned int flags, bool all,
                           RayTotals& totals) {
  RayHits fast(way, flags, all), slow(way, flags, all);
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

}  // namespace cairn::test

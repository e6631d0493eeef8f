// SPDX-License-Identifier: Zlib
#pragma once

#include <btBulletDynamicsCommon.h>

#include <random>

#include "cairn/bullet/sphere_tree_shape.h"
#include "random_tree.h"

namespace cairn::test {

/// Hands a shape's triangles on to `to`. The shape does not see what kind of callback that is: it gives all triangles
/// near the box, one after the other.
struct HandOn final : btTriangleCallback {
  explicit HandOn(btTriangleCallback& callback) : to(callback) {}
  void processTriangle(btVector3* triangle, int part, int index) override { to.processTriangle(triangle, part, index); }
  btTriangleCallback& to;
};

/// The oracle of every cast: all triangles of the shape, no box.
inline void castOverAll(const btConcaveShape& shape, btTriangleCallback& callback) {
  const btScalar end(1e9);
  HandOn all(callback);
  shape.processAllTriangles(&all, btVector3(-end, -end, -end), btVector3(end, end, end));
}

/// The shape's triangles, in its frame and order, for one of Bullet's own mesh shapes.
inline void copyTriangles(const btConcaveShape& shape, btTriangleMesh& mesh) {
  struct Copy final : btTriangleCallback {
    explicit Copy(btTriangleMesh& out) : to(out) {}
    void processTriangle(btVector3* t, int, int) override { to.addTriangle(t[0], t[1], t[2]); }
    btTriangleMesh& to;
  } copy(mesh);
  castOverAll(shape, copy);
}

inline btVector3 toBt(const Vec3d& v) {
  return {btScalar(v.x), btScalar(v.y), btScalar(v.z)};
}

inline btTransform randomTransform(std::mt19937_64& engine, double spread = 5) {
  const Mat3d r = randomRotation(engine);
  const btMatrix3x3 basis(btScalar(r(0, 0)), btScalar(r(0, 1)), btScalar(r(0, 2)), btScalar(r(1, 0)), btScalar(r(1, 1)),
                          btScalar(r(1, 2)), btScalar(r(2, 0)), btScalar(r(2, 1)), btScalar(r(2, 2)));
  return btTransform(basis, toBt(randomPoint(engine) * spread));
}

/// A way that begins within `spread` times the shape's size around it and aims at a place near it. One in four ends
/// where it aims.
struct Way {
  btVector3 from, to;
};
inline Way randomWay(std::mt19937_64& engine, double size, double spread) {
  const Vec3d from = randomPoint(engine) * (spread * size), at = randomPoint(engine) * (0.5 * size);
  const bool ends = engine() % 4 == 0;
  return {toBt(from), toBt(ends ? at : at + (at - from) * uniform(engine, 0.5, 2))};
}

}  // namespace cairn::test

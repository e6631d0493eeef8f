// SPDX-License-Identifier: GPL-3.0-or-later
#include "pair_oracle.h"

#include <algorithm>

#include "brute_force_pairs.h"

namespace cairn::fuzz {
namespace {

// Relative to `origin`, so that nothing is lost far from the world's.
builder::TriangleMesh placed(const TreeBody& body, const btVector3& origin) {
  const btTransform fromTree = body.pose * body.shape->bodyFromTree();
  builder::TriangleMesh mesh;
  for (const Vec3& vertex : body.shape->tree().vertices()) {
    const Vec3d v = Vec3d(vertex) * double(body.shape->scale());
    Vec3d at;
    for (int i = 0; i < 3; ++i) {
      const btVector3& row = fromTree.getBasis()[i];
      at[i] = double(row.x()) * v.x + double(row.y()) * v.y + double(row.z()) * v.z +
              (double(fromTree.getOrigin()[i]) - double(origin[i]));
    }
    mesh.vertices.push_back(at);
  }
  mesh.triangles.assign(body.shape->tree().triangles().begin(), body.shape->tree().triangles().end());
  return mesh;
}

}  // namespace

bool areWithin(const TreeBody& a, const TreeBody& b, double distance) {
  const builder::TriangleMesh meshA = placed(a, a.pose.getOrigin()), meshB = placed(b, a.pose.getOrigin());
  for (const Vec3d& p : meshA.vertices)
    for (const Vec3d& q : meshB.vertices)
      if (length(p - q) <= distance) return true;
  const test::BruteForcePair pair(meshA, meshB, {});
  return pair.deepestVertex() > 0 || pair.separation() <= distance;
}

double depthWhereTheyCross(const TreeBody& a, const TreeBody& b) {
  const builder::TriangleMesh meshA = placed(a, a.pose.getOrigin()), meshB = placed(b, a.pose.getOrigin());
  const test::BruteForcePair pair(meshA, meshB, {});
  return pair.cross() ? pair.deepestVertex() : 0;
}

}  // namespace cairn::fuzz

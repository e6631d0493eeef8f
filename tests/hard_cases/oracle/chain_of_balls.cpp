// SPDX-License-Identifier: GPL-3.0-or-later
#include "oracle/chain_of_balls.h"

#include "random_tree.h"

namespace cairn::hard {
namespace {

bool holds(const Sphere& ball, const Wide& point) {
  const auto radius = static_cast<long double>(ball.radius);
  return lengthSq(point - Wide(ball.center)) <= radius * radius;
}

bool heldBelow(const SphereTree& tree, NodeId node, const Wide& point) {
  if (!holds(tree.sphere(node), point)) return false;
  if (tree.isLeaf(node)) return true;
  const std::uint32_t family = tree.childFamily(node);
  for (std::uint32_t lane = 0; lane < tree.childCount(node); ++lane)
    if (heldBelow(tree, family * kFamilyWidth + lane, point)) return true;
  return false;
}

}  // namespace

bool liesInAChain(const SphereTree& tree, const Wide& point) {
  return heldBelow(tree, kRootNode, point - Wide(tree.origin()));
}

Wide randomSurfacePoint(const builder::TriangleMesh& mesh, std::mt19937_64& engine) {
  const auto corners = mesh.corners(static_cast<std::uint32_t>(engine() % mesh.triangles.size()));
  const Wide a(corners[0]), b(corners[1]), c(corners[2]);
  const std::uint64_t kind = engine() % 8;
  auto u = static_cast<long double>(test::uniform(engine)), v = static_cast<long double>(test::uniform(engine));
  if (kind == 0) return a;
  if (kind == 1) return a + (b - a) * u;
  if (u + v > 1) {
    u = 1 - u;
    v = 1 - v;
  }
  return a + (b - a) * u + (c - a) * v;
}

}  // namespace cairn::hard

// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include "cairn/builder/certify.h"
#include "cairn/core/tree_pair_traversal.h"
#include "certificate_cases.h"
#include "certificates/probe_tree.h"
#include "certificates/small_solids.h"
#include "certificates/wide_matrix.h"
#include "certificates/worst_places.h"
#include "oracle/chain_of_balls.h"
#include "placement/tree_pose.h"

// A proof in double has to hold for the numbers of a traversal: floats, moved into another body's frame,
// millimetres or kilometres large, ten kilometres from the origin.
//
//         .--.                               A: the tree           x: a point of A's surface, known in B's
//       .' .-.'.   <-- leaf, ancestors       B: a tree of points      frame to the last bit
//       | ( x )|                             the traversal of A and B must end with x in a leaf of A that
//        '.'-'.'                             holds it
//          ''
namespace cairn::hard {
namespace {

struct Found {
  std::uint64_t points = 0, outsideTree = 0, unseen = 0;
  std::uint64_t ballPoints = 0, tooFar = 0;
  double nearest = -HUGE_VAL;  ///< of the ball points: distance less stated error, in stated errors

  void operator+=(const Found& o) {
    points += o.points;
    outsideTree += o.outsideTree;
    unseen += o.unseen;
    ballPoints += o.ballPoints;
    tooFar += o.tooFar;
    nearest = std::max(nearest, o.nearest);
  }
};

/// Where two bodies stand: both about `away` from the origin, as near each other as their size.
struct Poses {
  Pose a, b;
  Poses(const bullet::SphereTreeShape& shapeA, const bullet::SphereTreeShape& shapeB, double away,
        std::mt19937_64& engine) {
    const btVector3 place = randomDirection(engine) * btScalar(away);
    const btVector3 apart = randomDirection(engine) * (shapeA.size() * btScalar(test::uniform(engine)));
    a = bullet::treePose(shapeA, btTransform(randomTurn(engine), place));
    b = bullet::treePose(shapeB, btTransform(randomTurn(engine), place + apart));
  }
};

/// Points of one round, so that neighbours are near each other: by octants of octants of octants.
std::vector<Wide> orderedSurfacePoints(const builder::TriangleMesh& mesh, std::mt19937_64& engine) {
  std::vector<Wide> points;
  for (std::uint32_t i = 0; i < kProbes; ++i) points.push_back(randomSurfacePoint(mesh, engine));
  const builder::Bounds bounds = builder::boundsOf(mesh);
  const auto octant = [&](const Wide& p) {
    int key = 0;
    for (int bit = 2; bit >= 0; --bit)
      for (int axis = 0; axis < 3; ++axis) {
        const double size = bounds.upper[axis] - bounds.lower[axis];
        const int cell = std::min(7, int(8 * (double(p[axis]) - bounds.lower[axis]) / size));
        key = 2 * key + (cell >> bit & 1);
      }
    return key;
  };
  std::ranges::stable_sort(points, {}, octant);
  return points;
}

/// `kProbes` points of A's surface, each the least ball B can make of it.
Found traverseOnce(const SmallSolid& solid, const bullet::SphereTreeShape& shape, double away,
                   std::mt19937_64& engine) {
  const SphereTree& tree = *solid.tree;
  const std::vector<Wide> points = orderedSurfacePoints(solid.mesh, engine);
  const Poses poses(shape, shape, away, engine);
  const WideMatrix turnA(poses.a.rotation), turnB(poses.b.rotation);
  std::vector<Wide> inB;
  for (const Wide& p : points) {
    const Wide world = turnA * ((p - Wide(tree.origin())) * static_cast<long double>(poses.a.scale));
    const Wide apart = world + (Wide(poses.a.translation) - Wide(poses.b.translation));
    inB.push_back(turnB.solved(apart) / static_cast<long double>(poses.b.scale));
  }
  const SphereTree probes = probeTree(inB);
  TreePairTraversal traversal;
  traversal.start(tree, probes, poses.a, poses.b, 0);
  Budget budget = Budget::unlimited();
  (void)traversal.refine(budget);

  std::vector<std::uint8_t> seen(std::size_t{kFamilyWidth} * probes.families().size());
  std::vector<const Wide*> pointOf(seen.size());
  for (std::uint32_t i = 0; i < kProbes; ++i) pointOf[nodeOfProbe(probes, i)] = &points[i];
  for (const NodePair& pair : traversal.leafPairs()) {
    const Sphere ball = tree.sphere(pair.a);
    const auto radius = static_cast<long double>(ball.radius);
    const Wide offset = *pointOf[pair.b] - Wide(tree.origin()) - Wide(ball.center);
    if (lengthSq(offset) <= radius * radius) seen[pair.b] = 1;
  }
  Found found;
  for (std::uint32_t i = 0; i < kProbes; ++i) {
    ++found.points;
    found.outsideTree += liesInAChain(tree, points[i]) ? 0 : 1;
    found.unseen += seen[nodeOfProbe(probes, i)] != 0 ? 0 : 1;
  }
  return found;
}

/// Points of nodes' balls: the one the certificate says is farthest from the solid, and others, most on the sphere.
Found measureBalls(const SmallSolid& solid, const bullet::SphereTreeShape& shape,
                   const builder::Certificate& certificate, std::uint64_t points, std::mt19937_64& engine) {
  const SphereTree& tree = *solid.tree;
  const std::vector<Wide> none(kProbes);
  const SphereTree probes = probeTree(none);  // errors 0: a pair's error is the other node's
  const Poses poses(shape, shape, 0, engine);
  TreePairTraversal traversal;
  traversal.start(tree, probes, poses.a, poses.b, 0);
  Found found;
  for (std::uint64_t i = 0; i < points; ++i) {
    const auto record = static_cast<std::uint32_t>(engine() % tree.nodeCount());
    const NodeData& node = tree.data().nodes[record];
    const double reach = engine() % 4 == 0 ? std::cbrt(test::uniform(engine)) : 1;
    Vec3d p = Vec3d(node.center) +
              normalized(test::randomPoint(engine) + Vec3d(1e-9, 0, 0)) * (reach * double(node.radius) * (1 - 0x1p-50));
    if (engine() % 8 == 0) p = certificate.nodes[record].witness - tree.origin();
    const double stated = double(traversal.pairError({tree.nodeAt(record), kRootNode}));
    const double outside = std::max(0.0, -solid.surface->depth(p)) * poses.a.scale;
    ++found.ballPoints;
    found.tooFar += outside > stated ? 1 : 0;
    if (stated > 0) found.nearest = std::max(found.nearest, outside / stated - 1);
  }
  return found;
}

Outcome runSinglePrecision(Effort effort) {
  const bool quick = effort == Effort::quick;
  const std::uint64_t rounds = quick ? 8 : 720, ballPoints = quick ? 4000 : 100000;
  std::mt19937_64 engine(31);
  Found found;
  for (const SmallSolid& solid : smallSolids(quick ? 2 : 3)) {
    const auto certificate = builder::certify(*solid.tree, solid.mesh);
    if (!certificate) throw std::runtime_error(certificate.error().message);
    for (const btScalar scale : {btScalar(1e-3), btScalar(1), btScalar(1e3)}) {
      const auto shape = shapeOf(solid.tree, scale);
      found += measureBalls(solid, *shape, certificate.value(), ballPoints, engine);
      for (const double away : {0.0, 1e4})
        for (std::uint64_t round = 0; round < rounds; ++round) found += traverseOnce(solid, *shape, away, engine);
    }
  }
  const WorstPlaces worst = climbToWorstPlaces(quick ? 2 : 20, quick ? 200000 : 1000000, engine);
  std::string byDepth = "Of the slack used by bodies, and by trees in one to four compounds:";
  for (const double used : worst.usedByDepth) byDepth += fmt::format(" {:.2f}", used);
  const std::string points = "of " + std::to_string(found.points), balls = "of " + std::to_string(found.ballPoints);
  return {{{"surface points in no chain of balls", double(found.outsideTree), 0, Bound::atMost, points, "", 0},
           {"surface points the traversal loses", double(found.unseen), 0, Bound::atMost, points, "", 0},
           {"points of balls beyond the stated error", double(found.tooFar), 0, Bound::atMost, balls, "", 0},
           {"nearest to the stated error, over it, less 1", found.nearest, 0, Bound::atMost, "", "", 0},
           {"common points lost where rounding adds up worst", double(worst.lost), 0, Bound::atMost,
            "of " + std::to_string(worst.places), "", 0},
           {"of the slack used there", std::ranges::max(worst.usedByDepth), 1, Bound::atMost, "", "", 0}},
          byDepth};
}

}  // namespace

HardCase singlePrecision() {
  return {
      "C1", "certificates in single precision",
      "of 1e7 points of triangles and balls, of bodies 1e-3, 1 and 1e3 times as large, at the origin and 10 km from "
      "it, none is lost by a traversal in float or farther out than it states; no tolerance: points are known to "
      "2^-62, and the float a traversal is asked with is a ball that holds its point; nor is one that two bodies, or "
      "children of compounds up to four deep, share at the places that a search for the worst rounding ends at",
      runSinglePrecision};
}

}  // namespace cairn::hard

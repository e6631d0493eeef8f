// SPDX-License-Identifier: Zlib
#include "pairs/coarse_ground.h"

#include <BulletCollision/CollisionDispatch/btCollisionObjectWrapper.h>

#include <algorithm>

#include "cairn/bullet/sphere_tree_shape.h"
#include "cairn/bullet/terrain_shape.h"
#include "placement/tree_pose.h"
#include "terrain/terrain_balls.h"

namespace cairn::bullet {

namespace {

const TerrainLattice& latticeOf(const btCollisionObjectWrapper& ground) {
  return static_cast<const TerrainShape&>(*ground.getCollisionShape()).lattice();
}

// Places points of a tree in the pair's frame and in the terrain's.
struct TreeOverGround {
  const SphereTree& tree;
  const TerrainLattice& lattice;
  Pose pairFromTree, groundFromTree;
  Mat3d pairFromGround;
  double margin, reach;

  TreeOverGround(const btCollisionObjectWrapper& treeBody, const btCollisionObjectWrapper& ground, btScalar wanted)
      : TreeOverGround(*asSphereTree(treeBody.getCollisionShape()), treeBody.getWorldTransform(), ground, wanted) {}
  TreeOverGround(const SphereTreeShape& shape, const btTransform& body, const btCollisionObjectWrapper& ground,
                 btScalar wanted)
      : tree(shape.tree()),
        lattice(latticeOf(ground)),
        pairFromTree(treePose(shape, btTransform(body.getBasis()))),
        pairFromGround(toMat3d(ground.getWorldTransform().getBasis())),
        margin(double(shape.getMargin())),
        reach(double(wanted)) {
    const Mat3d groundFromPair = transpose(pairFromGround);
    const Vec3d way = toVec3d(body.getOrigin()) - toVec3d(ground.getWorldTransform().getOrigin());
    groundFromTree = {groundFromPair * pairFromTree.rotation, groundFromPair * (way + pairFromTree.translation),
                      pairFromTree.scale};
  }

  // Of a node, if it has one.
  bool contact(NodeId node, Contact& contact) const;
};

// Height over the plane of the triangle below a point; false where there is none.
bool measure(const TerrainLattice& lattice, const Vec3d& at, Vec3d& normal, double& height, int& index) {
  TerrainLattice::Corners below;
  if (!lattice.cornersOver(at.x, at.y, below, index)) return false;
  normal = normalized(below.normal());
  height = dot(normal, at - toVec3d(below.at[0]));
  return true;
}

bool TreeOverGround::contact(NodeId node, Contact& contact) const {
  const Sphere ball = tree.sphere(node);
  Vec3d normal;
  double height = 0;
  int index = 0;
  if (!measure(lattice, groundFromTree * Vec3d(ball.center), normal, height, index)) return false;
  if (height > double(ball.radius) * groundFromTree.scale + margin + reach) return false;
  const SupportBlock& points = tree.support(node);
  const Vec3 point = points.point(supportLane(points, Vec3(transpose(groundFromTree.rotation) * -normal)));
  if (!measure(lattice, groundFromTree * Vec3d(point), normal, height, index)) return false;
  contact.gap = static_cast<float>(height - margin);
  if (double(contact.gap) >= reach) return false;
  contact.normal = Vec3(pairFromGround * normal);
  contact.position = Vec3(pairFromTree * Vec3d(point)) - contact.normal * static_cast<float>(0.5 * (height + margin));
  contact.pair = {node, 0};
  contact.id = {static_cast<int>(tree.level(node)), static_cast<int>(node), 0, index};
  return true;
}

}  // namespace

CoarseGround::CoarseGround(const btCollisionObjectWrapper& tree, const btCollisionObjectWrapper& ground,
                           btScalar reach) {
  const TreeOverGround placed(tree, ground, reach);
  const std::uint32_t family = placed.tree.childFamily(kRootNode);
  const std::uint32_t nodes = placed.tree.familySize(family);
  for (std::uint32_t lane = 0; lane < nodes; ++lane)
    if (placed.contact(kFamilyWidth * family + lane, contacts_[count_])) ++count_;
  std::ranges::sort(contacts(), deeper);
}

bool isClearOfGround(const btCollisionObjectWrapper& tree, const btCollisionObjectWrapper& ground, btScalar travel) {
  const SphereTreeShape& shape = *asSphereTree(tree.getCollisionShape());
  const btTransform &body = tree.getWorldTransform(), &groundPose = ground.getWorldTransform();
  btVector3 center;
  btScalar radius = 0;
  shape.getBoundingSphere(center, radius);
  const btVector3 arm = body.getBasis() * center;
  const Vec3d way = toVec3d(body.getOrigin()) - toVec3d(groundPose.getOrigin());
  const Vec3d inGround = transpose(toMat3d(groundPose.getBasis())) * (way + toVec3d(arm));
  const btScalar wanted = radius + btScalar(kSpeculativeFraction) * shape.size() + travel;
  const auto reach = double(wanted + btScalar(kOverlapSlack) * 4 * (arm.length() + wanted));
  return groundBelow(latticeOf(ground), inGround, reach).leastDistance() > reach;
}

}  // namespace cairn::bullet

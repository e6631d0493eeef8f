// SPDX-License-Identifier: Zlib
#include "pairs/coarse_ground.h"

#include <BulletCollision/CollisionDispatch/btCollisionObjectWrapper.h>
#include <BulletCollision/CollisionShapes/btStaticPlaneShape.h>

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

// The ground below a body. A terrain's cells are cached, because the body's points lie over few of them. A static plane
// is one infinite triangle.
class CellsBelow {
 public:
  explicit CellsBelow(const btCollisionObjectWrapper& ground);

  struct Plane {
    int index = -1;  // of the triangle, if it is one
    bool isMissing = false;
    Vec3d normal, corner;

    // Height above the plane.
    double over(const Vec3d& at) const { return dot(normal, at - corner); }
  };
  // The plane of the triangle below a point; null where there is none. Valid until the next call.
  const Plane* planeBelow(const Vec3d& at);

 private:
  struct Cell {
    double fromX, toX, fromY, toY;
    std::int64_t column, row;
    bool isRising;
    std::array<Plane, 2> planes;  // lower, upper; computed when they are needed

    bool contains(const Vec3d& at) const { return at.x >= fromX && at.x < toX && at.y >= fromY && at.y < toY; }
    bool isUpperBelow(const Vec3d& at) const {
      const double u = (at.x - fromX) * (toY - fromY), v = (at.y - fromY) * (toX - fromX);
      return isRising ? v > u : u + v > (toX - fromX) * (toY - fromY);
    }
  };
  Cell* cellBelow(const Vec3d& at);
  void look(const Cell& cell, bool isUpper, Plane& plane) const;

  static constexpr std::size_t kMax = 4;
  const TerrainLattice* lattice_ = nullptr;
  Plane plane_;                   // of a static plane
  std::array<Cell, kMax> cells_;  // the cells looked up last
  std::size_t count_ = 0;
};

CellsBelow::CellsBelow(const btCollisionObjectWrapper& ground) {
  if (ground.getCollisionShape()->getShapeType() == STATIC_PLANE_PROXYTYPE) {
    const auto& plane = static_cast<const btStaticPlaneShape&>(*ground.getCollisionShape());
    plane_.normal = toVec3d(plane.getPlaneNormal());
    plane_.corner = plane_.normal * double(plane.getPlaneConstant());
  } else {
    lattice_ = &latticeOf(ground);
  }
}

CellsBelow::Cell* CellsBelow::cellBelow(const Vec3d& at) {
  const std::size_t known = std::min(count_, kMax);
  for (std::size_t i = 0; i < known; ++i)
    if (cells_[i].contains(at)) return &cells_[i];
  TerrainLattice::Over over;
  if (!lattice_->locate(at.x, at.y, over)) return nullptr;
  const auto from = [](std::span<const btScalar> points, std::int64_t i) {
    return double(points[static_cast<std::size_t>(i)]);
  };
  Cell& cell = cells_[count_++ % kMax];
  cell.fromX = from(lattice_->xs(), over.column);
  cell.toX = from(lattice_->xs(), over.column + 1);
  cell.fromY = from(lattice_->ys(), over.row);
  cell.toY = from(lattice_->ys(), over.row + 1);
  cell.column = over.column;
  cell.row = over.row;
  cell.isRising = lattice_->isRising(over.column, over.row);
  cell.planes[0].index = cell.planes[1].index = -1;
  return &cell;
}

const CellsBelow::Plane* CellsBelow::planeBelow(const Vec3d& at) {
  if (!lattice_) return &plane_;
  Cell* const cell = cellBelow(at);
  if (!cell) return nullptr;
  const bool isUpper = cell->isUpperBelow(at);
  Plane& plane = cell->planes[isUpper ? 1 : 0];
  if (plane.index < 0) look(*cell, isUpper, plane);
  return plane.isMissing ? nullptr : &plane;
}

void CellsBelow::look(const Cell& cell, bool isUpper, Plane& plane) const {
  TerrainLattice::Corners corners;
  plane.index = lattice_->indexOf(cell.column, cell.row, isUpper);
  plane.isMissing = !lattice_->corners(cell.column, cell.row, isUpper, corners);
  plane.normal = normalized(corners.normal());
  plane.corner = toVec3d(corners.at[0]);
}

// Places points of a tree in the pair's frame and in the terrain's.
struct TreeOverGround {
  const SphereTree& tree;
  CellsBelow cells;
  Pose pairFromTree, groundFromTree;
  Mat3d treeFromGround;  // rotation only
  Mat3d pairFromGround;
  double margin, maxSeparation;

  TreeOverGround(const btCollisionObjectWrapper& treeBody, const btCollisionObjectWrapper& ground, btScalar wanted)
      : TreeOverGround(*asSphereTree(treeBody.getCollisionShape()), treeBody.getWorldTransform(), ground, wanted) {}
  TreeOverGround(const SphereTreeShape& shape, const btTransform& body, const btCollisionObjectWrapper& ground,
                 btScalar wanted)
      : tree(shape.tree()),
        cells(ground),
        pairFromTree(treePose(shape, btTransform(body.getBasis()))),
        pairFromGround(toMat3d(ground.getWorldTransform().getBasis())),
        margin(double(shape.getMargin())),
        maxSeparation(double(wanted)) {
    const Mat3d groundFromPair = transpose(pairFromGround);
    const Vec3d way = toVec3d(body.getOrigin()) - toVec3d(ground.getWorldTransform().getOrigin());
    groundFromTree = {groundFromPair * pairFromTree.rotation, groundFromPair * (way + pairFromTree.translation),
                      pairFromTree.scale};
    treeFromGround = transpose(groundFromTree.rotation);
  }

  // The contact of a node, if it has one.
  bool contact(NodeId node, Contact& contact);
};

bool TreeOverGround::contact(NodeId node, Contact& contact) {
  const Sphere ball = tree.sphere(node);
  const Vec3d center = groundFromTree * Vec3d(ball.center);
  const CellsBelow::Plane* plane = cells.planeBelow(center);
  if (!plane) return false;
  if (plane->over(center) > double(ball.radius) * groundFromTree.scale + margin + maxSeparation) return false;
  const SupportBlock& points = tree.support(node);
  const Vec3 point = points.point(supportLane(points, Vec3(treeFromGround * -plane->normal)));
  const Vec3d at = groundFromTree * Vec3d(point);
  plane = cells.planeBelow(at);
  if (!plane) return false;
  const double height = plane->over(at);
  contact.separation = static_cast<float>(height - margin);
  if (double(contact.separation) >= maxSeparation) return false;
  contact.normal = Vec3(pairFromGround * plane->normal);
  contact.position = Vec3(pairFromTree * Vec3d(point)) - contact.normal * static_cast<float>(0.5 * (height + margin));
  contact.pair = {node, 0};
  contact.id = {static_cast<int>(tree.level(node)), static_cast<int>(node), plane->index < 0 ? -1 : 0, plane->index};
  return true;
}

}  // namespace

CoarseGround::CoarseGround(const btCollisionObjectWrapper& tree, const btCollisionObjectWrapper& ground,
                           btScalar maxSeparation) {
  TreeOverGround placed(tree, ground, maxSeparation);
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
  const auto maxSeparation = double(wanted + btScalar(kOverlapSlack) * 4 * (arm.length() + wanted));
  // Points no higher than that are no farther away either; most bodies asked about stand on the ground.
  const TerrainLattice& lattice = latticeOf(ground);
  if (inGround.z - lattice.heightOver(inGround.x, inGround.y) <= maxSeparation) return false;
  return groundBelow(lattice, inGround, maxSeparation).leastDistance() > maxSeparation;
}

}  // namespace cairn::bullet

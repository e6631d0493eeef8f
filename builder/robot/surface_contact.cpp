// SPDX-License-Identifier: GPL-3.0-or-later
#include "robot/surface_contact.h"

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/math/bv/OBBRSS.h>
#include <fcl/narrowphase/collision.h>

namespace cairn::builder {
namespace {

fcl::Transform3d toFcl(const RigidPose& pose) {
  fcl::Transform3d transform = fcl::Transform3d::Identity();
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) transform(row, column) = pose.rotation(row, column);
    transform(row, 3) = pose.translation[row];
  }
  return transform;
}

}  // namespace

struct LinkSurface::Tree {
  fcl::BVHModel<fcl::OBBRSSd> model;
};

LinkSurface::LinkSurface(const std::vector<TriangleMesh>& meshes) {
  std::vector<fcl::Vector3d> vertices;
  std::vector<fcl::Triangle> triangles;
  for (const TriangleMesh& mesh : meshes) {
    const std::size_t first = vertices.size();
    for (const Vec3d& v : mesh.vertices) vertices.emplace_back(v.x, v.y, v.z);
    for (const Triangle& t : mesh.triangles) triangles.emplace_back(first + t[0], first + t[1], first + t[2]);
  }
  if (triangles.empty()) return;
  tree_ = std::make_unique<Tree>();
  tree_->model.beginModel(static_cast<int>(triangles.size()), static_cast<int>(vertices.size()));
  tree_->model.addSubModel(vertices, triangles);
  tree_->model.endModel();
}

LinkSurface::~LinkSurface() = default;
LinkSurface::LinkSurface(LinkSurface&&) noexcept = default;

bool LinkSurface::meets(const LinkSurface& other, const RigidPose& pose) const {
  if (empty() || other.empty()) return false;
  const fcl::CollisionRequestd request(1, false);
  fcl::CollisionResultd result;
  fcl::collide(&tree_->model, fcl::Transform3d::Identity(), &other.tree_->model, toFcl(pose), request, result);
  return result.isCollision();
}

}  // namespace cairn::builder

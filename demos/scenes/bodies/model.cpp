// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenes/bodies/model.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace cairn::scenes {
namespace {

double boundingBoxDiagonal(std::span<const Vec3> vertices) {
  Vec3d lower(vertices[0]), upper(vertices[0]);
  for (const Vec3& v : vertices) {
    for (int axis = 0; axis < 3; ++axis) {
      lower[axis] = std::min(lower[axis], static_cast<double>(v[axis]));
      upper[axis] = std::max(upper[axis], static_cast<double>(v[axis]));
    }
  }
  return length(upper - lower);
}

}  // namespace

Vec3d Model::bodyFromTree(const Vec3& p) const {
  const MassProperties& mass = tree->mass();
  return transpose(mass.principalAxes) * ((Vec3d(p) + tree->origin() - mass.centerOfMass) * scale);
}

Model makeModel(std::shared_ptr<const SphereTree> tree, double size) {
  assert(tree && size > 0);
  Model model;
  model.tree = std::move(tree);
  model.size = size;
  model.scale = size / boundingBoxDiagonal(model.tree->vertices());
  for (const Vec3& v : model.tree->vertices()) {
    model.vertices.push_back(model.bodyFromTree(v));
    model.reach = std::max(model.reach, length(model.vertices.back()));
  }
  model.triangles.assign(model.tree->triangles().begin(), model.tree->triangles().end());
  model.inertia = toBullet(model.tree->mass().principalMoments * (model.scale * model.scale));
  return model;
}

}  // namespace cairn::scenes

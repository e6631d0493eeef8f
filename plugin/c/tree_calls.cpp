// SPDX-License-Identifier: Zlib
//
// Trees and shapes in C; cairn/cairn.h says what the calls mean.
#include <algorithm>
#include <cstddef>
#include <span>

#include "c/calls.h"
#include "cairn/core/log.h"
#include "cairn/core/tree_file.h"
#include "cairn/core/version.h"

using cairn::SphereTree;
using cairn::Vec3;
using cairn::Vec3d;
using cairn::c::done;
using cairn::c::made;

namespace {

cairn::Result<std::shared_ptr<const SphereTree>> shared(cairn::Result<SphereTree> tree) {
  if (!tree) return tree.error();
  return std::make_shared<const SphereTree>(std::move(tree).value());
}

// A point of the tree frame in the mesh's own.
void writeInMesh(const SphereTree& tree, const Vec3& p, float* numbers) {
  const Vec3 inMesh(Vec3d(p) + tree.origin());
  for (int axis = 0; axis < 3; ++axis) numbers[axis] = inMesh[axis];
}

}  // namespace

const char* cairnVersion(void) {
  return cairn::version();
}

const char* cairnError(void) {
  return cairn::c::lastError().c_str();
}

void cairnSetLog(void (*function)(const char* message, void* user), void* user) {
  cairn::setLog(function, user);
}

CairnTree* cairnLoadTree(const char* path) {
  return made<CairnTree>([&] { return shared(cairn::loadTree(path)); });
}

CairnTree* cairnReadTree(const void* bytes, size_t size) {
  return made<CairnTree>(
      [&] { return shared(cairn::decodeTree(std::span(static_cast<const std::byte*>(bytes), size))); });
}

void cairnFreeTree(CairnTree* tree) {
  delete tree;
}

void cairnDescribeTree(const CairnTree* handle, CairnTreeInfo* info) {
  const SphereTree& tree = *handle->tree;
  const cairn::MassProperties& mass = tree.mass();
  *info = {tree.depth(),
           tree.nodeCount(),
           tree.leafCount(),
           static_cast<std::uint32_t>(tree.vertices().size()),
           static_cast<std::uint32_t>(tree.triangles().size()),
           tree.levelMeshCount(),
           tree.memoryBytes(),
           mass.volume,
           {mass.centerOfMass.x, mass.centerOfMass.y, mass.centerOfMass.z},
           {}};
  for (int i = 0; i < 9; ++i) info->inertia[i] = mass.inertia(i / 3, i % 3);
}

size_t cairnTreeSpheres(const CairnTree* handle, uint32_t level, CairnSphere* spheres, size_t room) {
  const SphereTree& tree = *handle->tree;
  std::size_t count = 0;
  done([&]() -> cairn::Status {
    const std::vector<cairn::NodeId> cut = tree.levelCut(level);
    count = cut.size();
    for (std::size_t i = 0; i < std::min(count, room); ++i) {
      writeInMesh(tree, tree.sphere(cut[i]).center, spheres[i].center);
      spheres[i].radius = tree.sphere(cut[i]).radius;
      spheres[i].error = tree.error(cut[i]);
    }
    return {};
  });
  return count;
}

void cairnTreeMesh(const CairnTree* handle, float* vertices, uint32_t* triangles) {
  const SphereTree& tree = *handle->tree;
  for (std::size_t i = 0; vertices && i < tree.vertices().size(); ++i)
    writeInMesh(tree, tree.vertices()[i], vertices + 3 * i);
  for (std::size_t i = 0; triangles && i < tree.triangles().size(); ++i)
    std::ranges::copy(tree.triangles()[i], triangles + 3 * i);
}

CairnShape* cairnMakeShape(const CairnTree* tree, const CairnShapeOptions* given) {
  const CairnShapeOptions options = given ? *given : CairnShapeOptions{};
  return made<CairnShape>([&]() -> cairn::Result<std::shared_ptr<cairn::bullet::SphereTreeShape>> {
    const auto scale = btScalar(options.scale == 0 ? 1 : options.scale);
    auto shape = cairn::bullet::SphereTreeShape::create(tree->tree, cairn::bullet::BodyFrame::principalAxes, scale);
    if (!shape) return shape.error();
    if (const cairn::Status status = shape.value()->setMaxContactError(btScalar(options.maxContactError)); !status)
      return status.error();
    return std::shared_ptr(std::move(shape).value());
  });
}

void cairnFreeShape(CairnShape* shape) {
  delete shape;
}

float cairnShapeSize(const CairnShape* shape) {
  return float(shape->shape->size());
}

void* cairnBulletShape(CairnShape* shape) {
  return shape->shape.get();
}

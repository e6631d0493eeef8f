// SPDX-License-Identifier: Zlib
//
// What JavaScript calls of memory, trees and shapes; wasm/js/tree.mjs says what they mean.
#include <cstdlib>
#include <span>

#include "cairn/bullet/sphere_tree_shape.h"
#include "cairn/core/tree_file.h"
#include "cairn/core/version.h"
#include "calls.h"
#include "exported.h"
#include "tree_views.h"

namespace {

using namespace cairn::wasm;
using TreeHandle = std::shared_ptr<const cairn::SphereTree>;
using ShapeHandle = std::shared_ptr<cairn::bullet::SphereTreeShape>;

cairn::Result<TreeHandle> shared(cairn::Result<cairn::SphereTree> tree) {
  if (!tree) return tree.error();
  return TreeHandle(std::make_shared<const cairn::SphereTree>(std::move(tree).value()));
}

// Leaves the list that `make` returns.
template <class T, class Make>
const T* put(std::vector<T>& place, const Make& make) {
  return listed(place, [&]() -> cairn::Status {
    place = make();
    return {};
  });
}

}  // namespace

CAIRN_WASM(void*) cairn_allocate(std::size_t bytes) {
  return std::malloc(bytes);
}

CAIRN_WASM(void) cairn_deallocate(void* memory) {
  std::free(memory);
}

CAIRN_WASM(const char*) cairn_error() {
  return answer().error.c_str();
}

CAIRN_WASM(std::size_t) cairn_count() {
  return answer().count;
}

CAIRN_WASM(const char*) cairn_version() {
  return cairn::version();
}

CAIRN_WASM(TreeHandle*) cairn_tree_read(const std::byte* bytes, std::size_t count) {
  return made<TreeHandle>([&] { return shared(cairn::decodeTree(std::span(bytes, count))); });
}

CAIRN_WASM(TreeHandle*) cairn_tree_cut(const TreeHandle* tree, int depth) {
  return made<TreeHandle>([&] { return shared(cutBelow(**tree, depth)); });
}

CAIRN_WASM(void) cairn_tree_free(TreeHandle* tree) {
  delete tree;
}

CAIRN_WASM(const std::byte*) cairn_tree_bytes(const TreeHandle* tree) {
  return put(answer().bytes, [&] { return cairn::encodeTree(**tree); });
}

/// Depth, nodes, leaves, levels with meshes, bytes, volume, centre of mass (3), inertia per kilogram (9).
CAIRN_WASM(const double*) cairn_tree_numbers(const TreeHandle* tree) {
  return put(answer().doubles, [&] { return numbersOf(**tree); });
}

CAIRN_WASM(const float*) cairn_tree_vertices(const TreeHandle* tree) {
  return put(answer().floats, [&] { return meshVertices(**tree); });
}

CAIRN_WASM(const std::uint32_t*) cairn_tree_triangles(const TreeHandle* tree) {
  return put(answer().integers, [&] { return meshTriangles(**tree); });
}

CAIRN_WASM(const float*) cairn_tree_spheres(const TreeHandle* tree, int level) {
  return put(answer().floats, [&] { return spheresOf(**tree, static_cast<std::uint32_t>(level)); });
}

CAIRN_WASM(ShapeHandle*) cairn_shape_make(const TreeHandle* tree, float scale, int ofMesh, float maxContactError) {
  return made<ShapeHandle>([&]() -> cairn::Result<ShapeHandle> {
    using cairn::bullet::BodyFrame;
    auto shape =
        cairn::bullet::SphereTreeShape::create(*tree, ofMesh ? BodyFrame::mesh : BodyFrame::principalAxes, scale);
    if (!shape) return shape.error();
    if (const auto status = shape.value()->setMaxContactError(maxContactError); !status) return status.error();
    return ShapeHandle(std::move(shape).value());
  });
}

CAIRN_WASM(void) cairn_shape_free(ShapeHandle* shape) {
  delete shape;
}

CAIRN_WASM(float) cairn_shape_size(const ShapeHandle* shape) {
  return (*shape)->size();
}

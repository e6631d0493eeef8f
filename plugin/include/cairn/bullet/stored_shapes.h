// SPDX-License-Identifier: Zlib
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "cairn/bullet/sphere_tree_shape.h"
#include "cairn/core/export.h"

namespace cairn::bullet {

/// A sphere-tree shape as stored in a `.bullet` file.
struct StoredShape {
  /// Its indices among the file's shape chunks, from 0, in the order of `bParse::btBulletFile::m_collisionShapes`.
  /// There are several where Bullet wrote the shape more than once.
  std::vector<std::size_t> chunks;
  std::shared_ptr<const SphereTree> tree;      ///< one object for all shapes that shared it when they were written
  BodyFrame frame = BodyFrame::principalAxes;  ///< as at `SphereTreeShape::create`
  double scale = 1;                            ///< metres per mesh unit
  double margin = 0;                           ///< metres
};

/// Reads the sphere-tree shapes of a `.bullet` file with their trees, in the order they were written. The result is
/// empty for a file without any.
///
///     auto shapes = cairn::bullet::readStoredShapes(bytes);
///     if (!shapes) return fail(path + " " + shapes.error().message);
///
/// For your own importers; `WorldImporter` uses it together with Bullet's importer. Nothing is trusted: it checks
/// lengths, names and numbers, and verifies trees as `decodeTree` does for `.cairn` files. The error says what is
/// wrong, without the file's name. Cost: linear in the file's size.
CAIRN_BULLET_EXPORT
Result<std::vector<StoredShape>> readStoredShapes(std::span<const std::byte> bulletFile);

}  // namespace cairn::bullet

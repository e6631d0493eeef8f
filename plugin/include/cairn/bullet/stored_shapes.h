// SPDX-License-Identifier: Zlib
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "cairn/bullet/sphere_tree_shape.h"

namespace cairn::bullet {

/// A sphere-tree shape as a `.bullet` file tells of it.
struct StoredShape {
  /// Its places among the file's shape chunks, counted from 0 in the order `bParse::btBulletFile::m_collisionShapes`
  /// has. More than one where Bullet wrote the shape more than once.
  std::vector<std::size_t> chunks;
  std::shared_ptr<const SphereTree> tree;  ///< one object for all shapes that shared it when they were written
  BodyFrame frame = BodyFrame::principalAxes;
  double scale = 1;
  double margin = 0;  ///< metres
};

/// The sphere-tree shapes a `.bullet` file holds, in the order they were written, with their trees; none for a file of
/// others. Nothing is trusted: lengths, names and numbers are checked, and the trees' bytes are verified as those of
/// `.cairn` files are (`decodeTree`). The error names what is wrong, without the file's name. Linear in the file's
/// size.
///
/// For importers of one's own; `WorldImporter` uses it on top of Bullet's.
Result<std::vector<StoredShape>> readStoredShapes(std::span<const std::byte> bulletFile);

}  // namespace cairn::bullet

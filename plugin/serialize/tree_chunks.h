// SPDX-License-Identifier: Zlib
#pragma once

#include <LinearMath/btSerializer.h>

#include <cstdint>
#include <type_traits>

namespace cairn::bullet {

/// The chunks of sphere-trees in a `.bullet` file, beside Bullet's own. The file's dictionary has no structures of
/// these names, so Bullet's importer skips them.

/// The bytes of a `.cairn` file, once per tree.
inline constexpr int kTreeChunk = BT_MAKE_ID('C', 'A', 'R', 'N');
/// One `TreeShapeRecord` per shape.
inline constexpr int kTreeShapeChunk = BT_MAKE_ID('C', 'T', 'S', 'H');
/// The "structure" of both chunks: Bullet writes names in the same way.
inline constexpr const char* kPlainBytes = "char";

inline constexpr std::uint32_t kTreeShapeVersion = 1;

/// The data of a shape, in the file's byte order, as all numbers of a `.bullet` file.
struct TreeShapeRecord {
  std::uint32_t version = kTreeShapeVersion;
  std::uint32_t frame = 0;      ///< the number of a `BodyFrame`
  std::uint64_t shapeName = 0;  ///< the pointer that names the shape's chunk in the file
  std::uint64_t treeName = 0;   ///< the pointer that names the tree's chunk in the file
  double scale = 1;
  double margin = 0;  ///< metres, as the shape's margin
};
static_assert(sizeof(TreeShapeRecord) == 40 && std::is_trivially_copyable_v<TreeShapeRecord>);

}  // namespace cairn::bullet

// SPDX-License-Identifier: Zlib
#pragma once

#include <LinearMath/btSerializer.h>

#include <cstdint>
#include <type_traits>

namespace cairn::bullet {

/// What a `.bullet` file holds of sphere-trees beside Bullet's own chunks. Bullet has no structure of these names in
/// its file's dictionary, so its importer steps over them.

/// The bytes of a `.cairn` file, once per tree.
inline constexpr int kTreeChunk = BT_MAKE_ID('C', 'A', 'R', 'N');
/// One `TreeShapeRecord` per shape.
inline constexpr int kTreeShapeChunk = BT_MAKE_ID('C', 'T', 'S', 'H');
/// The "structure" both are written as: Bullet writes names the same way.
inline constexpr const char* kPlainBytes = "char";

inline constexpr std::uint32_t kTreeShapeVersion = 1;

/// What a shape is made of, in the file's byte order, as all numbers of a `.bullet` file are.
struct TreeShapeRecord {
  std::uint32_t version = kTreeShapeVersion;
  std::uint32_t frame = 0;      ///< the number of a `BodyFrame`
  std::uint64_t shapeName = 0;  ///< which shape: the pointer its chunk is known by in the file
  std::uint64_t treeName = 0;   ///< which tree, likewise
  double scale = 1;
  double margin = 0;  ///< metres, as the shape's
};
static_assert(sizeof(TreeShapeRecord) == 40 && std::is_trivially_copyable_v<TreeShapeRecord>);

}  // namespace cairn::bullet

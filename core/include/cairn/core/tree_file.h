// SPDX-License-Identifier: Zlib
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <vector>

#include "cairn/core/export.h"
#include "cairn/core/sphere_tree.h"

namespace cairn {

/// Version of the `.cairn` format this library writes and the only one it reads.
inline constexpr std::uint32_t kTreeFileVersion = 1;

/// The tree as the bytes of a `.cairn` file (FlatBuffers, little-endian, checksummed): the same tree gives the same
/// bytes.
CAIRN_CORE_EXPORT std::vector<std::byte> encodeTree(const SphereTree& tree);

/// Reads the bytes of a `.cairn` file. Nothing in them is trusted: length, identifier, version, checksum, FlatBuffers
/// structure and every element are verified first. The error names what is wrong, without the file's name.
CAIRN_CORE_EXPORT Result<SphereTree> decodeTree(std::span<const std::byte> bytes);

/// Reads a `.cairn` file; the error names the file.
CAIRN_CORE_EXPORT Result<SphereTree> loadTree(const std::filesystem::path& path);

/// Writes a `.cairn` file completely or not at all.
CAIRN_CORE_EXPORT Status saveTree(const SphereTree& tree, const std::filesystem::path& path);

}  // namespace cairn

// SPDX-License-Identifier: Zlib
#pragma once

#include <cstddef>
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
CAIRN_CORE_EXPORT Result<SphereTree> loadTree(const char* path);

/// Writes a `.cairn` file completely or not at all.
CAIRN_CORE_EXPORT Status saveTree(const SphereTree& tree, const char* path);

#ifdef _WIN32
/// The same for the names that Windows gives to files.
CAIRN_CORE_EXPORT Result<SphereTree> loadTree(const wchar_t* path);
CAIRN_CORE_EXPORT Status saveTree(const SphereTree& tree, const wchar_t* path);
#endif

/// A `std::string` or a `std::filesystem::path`. The header of the latter is half as large as Bullet's.
template <class Path>
concept PathLike = requires(const Path& path) {
  path.c_str();
};

/// Reads a `.cairn` file; the error names the file.
template <PathLike Path>
Result<SphereTree> loadTree(const Path& path) {
  return loadTree(path.c_str());
}
/// Writes a `.cairn` file completely or not at all.
template <PathLike Path>
Status saveTree(const SphereTree& tree, const Path& path) {
  return saveTree(tree, path.c_str());
}

}  // namespace cairn

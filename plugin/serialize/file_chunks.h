// SPDX-License-Identifier: Zlib
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "cairn/core/result.h"

namespace cairn::bullet {

/// One chunk of a `.bullet` file.
struct FileChunk {
  int code = 0;
  int structure = -1;      ///< index of its structure in the file's dictionary; -1: none
  std::uint64_t name = 0;  ///< the pointer by which other chunks refer to it
  std::span<const std::byte> data;
};

/// Splits a `.bullet` file into its chunks, in order, without the dictionary at its end.
///
///     const auto chunks = chunksOf(file);
///     if (!chunks) return chunks.error();
///
/// Reads files of 32-bit and 64-bit programs, in single and double precision. Every length is checked against the
/// file's. Fails for other files, and for files that are cut short or have the other byte order. The chunks point into
/// `file`. Cost: linear in the number of chunks.
Result<std::vector<FileChunk>> chunksOf(std::span<const std::byte> file);

}  // namespace cairn::bullet

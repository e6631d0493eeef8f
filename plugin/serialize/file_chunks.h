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
  int structure = -1;      ///< which of the dictionary's structures it holds; -1: none
  std::uint64_t name = 0;  ///< the pointer other chunks know it by
  std::span<const std::byte> data;
};

/// The chunks of a `.bullet` file in their order, without the dictionary at its end. Written by a program of 32 or 64
/// bits, in single or double precision. Every length is checked against the file's. Fails for what is no such file, was
/// cut short, or was written in the other byte order. The chunks point into `file`.
Result<std::vector<FileChunk>> chunksOf(std::span<const std::byte> file);

}  // namespace cairn::bullet

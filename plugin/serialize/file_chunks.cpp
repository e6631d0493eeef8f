// SPDX-License-Identifier: Zlib
#include "serialize/file_chunks.h"

#include <LinearMath/btSerializer.h>

#include <bit>
#include <cstring>
#include <string>

namespace cairn::bullet {

namespace {

using Bytes = std::span<const std::byte>;

// "BULLET", f or d for the precision, - for 64 bits or _ for 32, v for little-endian or V, three digits of the version.
constexpr std::size_t kPointerSizeAt = 7, kByteOrderAt = 8;
constexpr int kOldDictionary = BT_MAKE_ID('S', 'D', 'N', 'A');

char letter(Bytes file, std::size_t at) {
  return static_cast<char>(file[at]);
}

template <class T>
T take(Bytes& bytes) {
  T value;
  std::memcpy(&value, bytes.data(), sizeof value);
  bytes = bytes.subspan(sizeof value);
  return value;
}

Status checkHeader(Bytes file) {
  constexpr char kOwnOrder = std::endian::native == std::endian::little ? 'v' : 'V';
  if (file.size() < BT_HEADER_LENGTH || std::memcmp(file.data(), "BULLET", 6) != 0)
    return Error{"is no .bullet file; write one with btDefaultSerializer"};
  if (letter(file, kByteOrderAt) != kOwnOrder)
    return Error{
        "was written on a machine with the other byte order; sphere-trees are read from files of this one's only, so "
        "write it there with Bullet's shapes or here"};
  return {};
}

}  // namespace

Result<std::vector<FileChunk>> chunksOf(Bytes file) {
  if (Status status = checkHeader(file); !status) return status.error();
  const bool wide = letter(file, kPointerSizeAt) == '-';
  const std::size_t headSize = wide ? 24 : 20;
  std::vector<FileChunk> chunks;
  Bytes rest = file.subspan(BT_HEADER_LENGTH);
  while (!rest.empty()) {
    const std::size_t at = file.size() - rest.size();
    const auto cut = [&] {
      return Error{"is cut short or damaged at byte " + std::to_string(at) + "; write it again"};
    };
    if (rest.size() < headSize) return cut();
    FileChunk chunk;
    chunk.code = take<int>(rest);
    const int length = take<int>(rest);
    chunk.name = wide ? take<std::uint64_t>(rest) : take<std::uint32_t>(rest);
    chunk.structure = take<int>(rest);
    take<int>(rest);  // number of structures
    if (length < 0 || static_cast<std::size_t>(length) > rest.size()) return cut();
    if (chunk.code == BT_DNA_CODE || chunk.code == kOldDictionary) break;
    chunk.data = rest.first(static_cast<std::size_t>(length));
    rest = rest.subspan(chunk.data.size());
    chunks.push_back(chunk);
  }
  return chunks;
}

}  // namespace cairn::bullet

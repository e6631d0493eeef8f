// SPDX-License-Identifier: Zlib
#pragma once

#include <LinearMath/btSerializer.h>

#include <cstddef>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

namespace cairn::test {

using Names = std::vector<std::pair<const void*, const char*>>;

/// The bytes of the `.bullet` file `btDefaultSerializer` writes of a world.
template <class World>
std::vector<std::byte> saved(World& world, const Names& names = {}) {
  btDefaultSerializer serializer;
  for (const auto& [what, name] : names) serializer.registerNameForPointer(what, name);
  world.serialize(&serializer);
  const auto* first = reinterpret_cast<const std::byte*>(serializer.getBufferPointer());
  return {first, first + serializer.getCurrentBufferSize()};
}

/// How often four letters occur in a file.
inline int countOf(const std::vector<std::byte>& bytes, const std::string& letters) {
  int count = 0;
  for (std::size_t i = 0; i + letters.size() <= bytes.size(); ++i)
    count += std::memcmp(&bytes[i], letters.data(), letters.size()) == 0;
  return count;
}

}  // namespace cairn::test

// SPDX-License-Identifier: GPL-3.0-or-later
#include "tool/sphere_file.h"

#include <algorithm>
#include <filesystem>

#include "cairn/core/atomic_file.h"

namespace cairn::tool {

bool isTreeFile(const std::string& path) {
  if (std::filesystem::path(path).extension() == ".cairn") return true;
  const auto bytes = readFile(path);
  return bytes && std::find(bytes.value().begin(), bytes.value().end(), std::byte{0}) != bytes.value().end();
}

}  // namespace cairn::tool

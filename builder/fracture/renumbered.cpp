// SPDX-License-Identifier: GPL-3.0-or-later
#include "fracture/renumbered.h"

#include <cstdint>
#include <vector>

namespace cairn::builder {

TriangleMesh renumbered(const TriangleMesh& mesh) {
  TriangleMesh result;
  constexpr std::uint32_t kUnused = ~0U;
  std::vector<std::uint32_t> numbers(mesh.vertices.size(), kUnused);
  for (const Triangle& t : mesh.triangles) {
    Triangle& named = result.triangles.emplace_back();
    for (int i = 0; i < 3; ++i) {
      if (numbers[t[i]] == kUnused) {
        numbers[t[i]] = static_cast<std::uint32_t>(result.vertices.size());
        result.vertices.push_back(mesh.vertices[t[i]]);
      }
      named[i] = numbers[t[i]];
    }
  }
  return result;
}

}  // namespace cairn::builder

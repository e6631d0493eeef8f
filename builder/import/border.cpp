// SPDX-License-Identifier: GPL-3.0-or-later
#include "import/border.h"

#include <cstddef>
#include <map>

namespace cairn::builder {

std::vector<HalfEdge> borderEdges(const TriangleMesh& mesh) {
  const std::vector<HalfEdge> all = sortedHalfEdges(mesh);
  std::vector<HalfEdge> border;
  for (std::size_t first = 0, last = 0; first < all.size(); first = last) {
    for (last = first; last < all.size() && all[last].sameEdge(all[first]);) ++last;
    if (last - first == 1) border.push_back(all[first]);
  }
  return border;
}

std::vector<std::vector<HalfEdge>> borderLoops(const TriangleMesh& mesh) {
  std::map<std::uint32_t, std::vector<HalfEdge>> leaving;  // by vertex, not yet visited
  for (const HalfEdge& e : borderEdges(mesh)) leaving[e.from].push_back(e);
  std::vector<std::vector<HalfEdge>> loops;
  for (auto& [start, edges] : leaving) {
    while (!edges.empty()) {
      std::vector<HalfEdge> path;
      std::map<std::uint32_t, std::size_t> position;  // of the vertices on the path
      for (std::uint32_t at = start;;) {
        if (const auto seen = position.find(at); seen != position.end()) {
          const auto first = path.begin() + static_cast<std::ptrdiff_t>(seen->second);
          loops.emplace_back(first, path.end());
          for (auto e = first; e != path.end(); ++e) position.erase(e->from);
          path.erase(first, path.end());
        }
        const auto next = leaving.find(at);
        if (next == leaving.end() || next->second.empty()) break;
        position[at] = path.size();
        path.push_back(next->second.back());
        next->second.pop_back();
        at = path.back().to;
      }
    }
  }
  return loops;
}

}  // namespace cairn::builder

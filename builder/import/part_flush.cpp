// SPDX-License-Identifier: GPL-3.0-or-later
#include "import/part_flush.h"

#include <algorithm>
#include <numeric>
#include <set>
#include <vector>

#include "import/bodies.h"
#include "import/near_triangles.h"
#include "import/raise_faces.h"
#include "import/settle.h"

namespace cairn::builder {
namespace {

bool haveNearBoxes(const Body& a, const Body& b, double distance) {
  for (int axis = 0; axis < 3; ++axis)
    if (a.bounds.lower[axis] > b.bounds.upper[axis] + distance ||
        b.bounds.lower[axis] > a.bounds.upper[axis] + distance)
      return false;
  return true;
}

/// Bodies by size, the largest first.
std::vector<std::uint32_t> bySize(const std::vector<Body>& bodies) {
  std::vector<std::uint32_t> order(bodies.size());
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return bodies[a].bounds.diagonal() > bodies[b].bounds.diagonal();
  });
  return order;
}

std::size_t partOnce(TriangleMesh& mesh, double tolerance) {
  // What counts as flush is less than what a face then moves, so that moved faces are not flush again.
  constexpr double kFlush = 0.25, kMove = 1.5;
  std::vector<Body> bodies = separated(mesh, bodiesOf(mesh));
  const std::vector<std::uint32_t> order = bySize(bodies);
  std::vector<int> height(bodies.size(), 0);  // how many moves the faces of a body have made
  std::size_t moved = 0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    Body& body = bodies[order[i]];
    std::set<std::uint32_t> flush;
    for (std::size_t j = 0; j < i; ++j) {
      const Body& larger = bodies[order[j]];
      if (!haveNearBoxes(body, larger, kFlush * tolerance)) continue;
      const std::vector<std::uint32_t> found = trianglesFlush(body.mesh, larger.mesh, kFlush * tolerance);
      if (!found.empty()) height[order[i]] = std::max(height[order[i]], height[order[j]] + 1);
      flush.insert(found.begin(), found.end());
    }
    if (flush.empty()) continue;
    raiseFaces(body.mesh, {flush.begin(), flush.end()}, height[order[i]] * kMove * tolerance);
    putBack(body, mesh);
    moved += flush.size();
  }
  if (moved > 0) mesh = settled(mesh);
  return moved;
}

}  // namespace

std::size_t partFlushFaces(TriangleMesh& mesh, double tolerance) {
  constexpr int kMaxRounds = 4;  // a moved face may be flush with a third body
  std::size_t moved = 0;
  for (int round = 0; round < kMaxRounds && tolerance > 0; ++round) {
    const std::size_t now = partOnce(mesh, tolerance);
    moved += now;
    if (now == 0) break;
  }
  return moved;
}

}  // namespace cairn::builder

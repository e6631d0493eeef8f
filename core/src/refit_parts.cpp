// SPDX-License-Identifier: Zlib
#include "refit_parts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include "refit_tuning.h"

namespace cairn {

namespace {

struct Part {
  std::array<FixedPlace, 3> corners;
  int halvings = 0;
};

// For each triangle the leaves that list it, by record.
struct LeavesOf {
  explicit LeavesOf(const SphereTree& tree) : first(tree.triangles().size() + 1, 0) {
    forEach(tree, [&](std::uint32_t, std::uint32_t triangle) { ++first[triangle + 1]; });
    for (std::size_t t = 0; t + 1 < first.size(); ++t) first[t + 1] += first[t];
    records.resize(first.back());
    std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
    forEach(tree, [&](std::uint32_t record, std::uint32_t triangle) { records[next[triangle]++] = record; });
  }
  std::span<const std::uint32_t> of(std::uint32_t triangle) const {
    return std::span(records).subspan(first[triangle], first[triangle + 1] - first[triangle]);
  }

  std::vector<std::uint32_t> first, records;

 private:
  template <class Visit>
  static void forEach(const SphereTree& tree, const Visit& visit) {
    for (std::uint32_t record = 0; record < tree.nodeCount(); ++record)
      if (tree.isLeaf(tree.nodeAt(record)))
        for (const std::uint32_t triangle : tree.regionTriangles(tree.nodeAt(record))) visit(record, triangle);
  }
};

class Cutter {
 public:
  Cutter(const SphereTree& tree, std::vector<std::vector<FixedPlace>>& out) : tree_(tree), leaves_(tree), out_(out) {}

  void cut(std::uint32_t triangle) {
    for (std::size_t k = 0; k < 3; ++k) vertex_[k] = Vec3d(tree_.vertices()[tree_.triangles()[triangle][k]]);
    waiting_.assign(1, {{FixedPlace{triangle, 0, 0}, {triangle, 1, 0}, {triangle, 0, 1}}, 0});
    while (!waiting_.empty()) {
      const Part part = waiting_.back();
      waiting_.pop_back();
      place(part, leaves_.of(triangle));
    }
  }

 private:
  Vec3d at(const FixedPlace& p) const {
    return vertex_[0] + (vertex_[1] - vertex_[0]) * p.b + (vertex_[2] - vertex_[0]) * p.c;
  }

  // Gives the part to the leaf that it sticks out of least, or cuts it.
  void place(const Part& part, std::span<const std::uint32_t> leaves) {
    const std::array<Vec3d, 3> corners{at(part.corners[0]), at(part.corners[1]), at(part.corners[2])};
    std::uint32_t best = leaves.front();
    double least = excess(corners, best);
    for (const std::uint32_t leaf : leaves.subspan(1))
      if (const double e = excess(corners, leaf); e < least) {
        least = e;
        best = leaf;
      }
    std::size_t longest = 0;
    const auto side = [&](std::size_t k) { return distance(corners[k], corners[(k + 1) % 3]); };
    for (std::size_t k = 1; k < 3; ++k)
      if (side(k) > side(longest)) longest = k;
    const double radius = double(tree_.node(tree_.nodeAt(best)).radius);
    if (leaves.size() == 1 || least <= 0 || part.halvings == refit::kMaxHalvings ||
        side(longest) <= refit::kSmallest * radius)
      out_[best].insert(out_[best].end(), part.corners.begin(), part.corners.end());
    else
      halve(part, longest);
  }

  // Out of the sphere and its bound, in radii.
  double excess(std::span<const Vec3d> corners, std::uint32_t leaf) const {
    const NodeId node = tree_.nodeAt(leaf);
    const double own = excess(corners, tree_.sphere(node));
    return tree_.spheresPerNode() == 1 ? own : std::max(own, excess(corners, tree_.bound(node)));
  }

  static double excess(std::span<const Vec3d> corners, const Sphere& ball) {
    double farthest = 0;
    for (const Vec3d& corner : corners) farthest = std::max(farthest, distance(corner, Vec3d(ball.center)));
    return farthest / double(ball.radius) - 1;
  }

  void halve(const Part& part, std::size_t side) {
    const FixedPlace &p = part.corners[side], &q = part.corners[(side + 1) % 3];
    const FixedPlace middle{p.triangle, (p.b + q.b) / 2, (p.c + q.c) / 2};
    for (const std::size_t replaced : {side, (side + 1) % 3}) {
      waiting_.push_back(part);
      waiting_.back().corners[replaced] = middle;
      ++waiting_.back().halvings;
    }
  }

  const SphereTree& tree_;
  LeavesOf leaves_;
  std::vector<std::vector<FixedPlace>>& out_;
  std::array<Vec3d, 3> vertex_;
  std::vector<Part> waiting_;
};

double turn(const FixedPlace& p, const FixedPlace& q, const FixedPlace& r) {
  return (q.b - p.b) * (r.c - p.c) - (q.c - p.c) * (r.b - p.b);
}

// Corners of the convex hull of one triangle's places, which are sorted and distinct: Andrew's chains.
void appendHull(std::span<const FixedPlace> places, std::vector<FixedPlace>& out) {
  if (places.size() < 3) {
    out.insert(out.end(), places.begin(), places.end());
    return;
  }
  const std::size_t start = out.size();
  const auto add = [&](const FixedPlace& p, std::size_t from) {
    while (out.size() >= from + 2 && turn(out[out.size() - 2], out.back(), p) <= 0) out.pop_back();
    out.push_back(p);
  };
  for (const FixedPlace& p : places) add(p, start);
  out.pop_back();
  const std::size_t back = out.size();
  for (std::size_t i = places.size(); i-- > 0;) add(places[i], back);
  out.pop_back();
}

void reduceToHulls(std::vector<FixedPlace>& places) {
  const auto key = [](const FixedPlace& p) { return std::tuple(p.triangle, p.b, p.c); };
  std::ranges::sort(places, {}, key);
  const auto isSame = [&](const FixedPlace& p, const FixedPlace& q) { return key(p) == key(q); };
  places.erase(std::unique(places.begin(), places.end(), isSame), places.end());
  std::vector<FixedPlace> hulls;
  for (std::size_t i = 0; i < places.size();) {
    std::size_t end = i;
    while (end < places.size() && places[end].triangle == places[i].triangle) ++end;
    appendHull(std::span(places).subspan(i, end - i), hulls);
    i = end;
  }
  places.swap(hulls);
}

}  // namespace

std::vector<std::vector<FixedPlace>> cornersOfParts(const SphereTree& tree) {
  std::vector<std::vector<FixedPlace>> corners(tree.nodeCount());
  Cutter cutter(tree, corners);
  for (std::uint32_t triangle = 0; triangle < tree.triangles().size(); ++triangle) cutter.cut(triangle);
  for (std::uint32_t record = tree.nodeCount(); record-- > 0;) {
    reduceToHulls(corners[record]);
    corners[record].shrink_to_fit();
    if (record == 0) continue;
    std::vector<FixedPlace>& above = corners[tree.data().nodes[record].parent];
    above.insert(above.end(), corners[record].begin(), corners[record].end());
  }
  return corners;
}

std::uint32_t firstUnlisted(const SphereTree& tree) {
  const LeavesOf leaves(tree);
  std::uint32_t triangle = 0;
  while (triangle < tree.triangles().size() && !leaves.of(triangle).empty()) ++triangle;
  return triangle;
}

}  // namespace cairn

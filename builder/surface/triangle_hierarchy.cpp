// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/triangle_hierarchy.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numeric>

#include "surface/infinity.h"

namespace cairn::builder {
namespace {

struct Box {
  Vec3d lower{kInfinity, kInfinity, kInfinity}, upper{-kInfinity, -kInfinity, -kInfinity};

  void add(const Vec3d& p) {
    for (int axis = 0; axis < 3; ++axis) {
      lower[axis] = std::min(lower[axis], p[axis]);
      upper[axis] = std::max(upper[axis], p[axis]);
    }
  }
  void add(const Box& b) {
    add(b.lower);
    add(b.upper);
  }
  bool empty() const { return lower.x > upper.x; }
  double halfArea() const {
    const Vec3d d = upper - lower;
    return empty() ? 0 : d.x * d.y + d.y * d.z + d.z * d.x;
  }
};

struct Range {
  std::uint32_t begin = 0, end = 0;
  std::uint32_t count() const { return end - begin; }
};

}  // namespace

class TriangleHierarchy::Builder {
 public:
  Builder(const TriangleMesh& mesh, std::vector<HierarchyNode>& nodes, std::vector<TrianglePacket>& packets)
      : mesh_(mesh), nodes_(nodes), packets_(packets) {
    const auto count = static_cast<std::uint32_t>(mesh.triangles.size());
    order_.resize(count);
    std::iota(order_.begin(), order_.end(), 0U);
    for (std::uint32_t t = 0; t < count; ++t) {
      Box box;
      for (const Vec3d& corner : mesh.corners(t)) box.add(corner);
      boxes_.push_back(box);
      centers_.push_back((box.lower + box.upper) * 0.5);
      for (int axis = 0; axis < 3; ++axis)
        largest_ = std::max({largest_, std::abs(box.lower[axis]), std::abs(box.upper[axis])});
    }
    buildNode({0, count}, 0);
  }

 private:
  static constexpr int kBins = 16;
  struct Split {
    double cost = kInfinity;
    int axis = 0;
    int bin = 0;  // first bin of the right part
  };

  std::uint32_t buildNode(Range range, std::uint32_t depth) {
    const auto index = static_cast<std::uint32_t>(nodes_.size());
    nodes_.emplace_back();
    std::array<Range, HierarchyNode::kWidth> parts{range};
    const int count = divide(parts, depth);
    for (int lane = 0; lane < count; ++lane) {
      const Box box = boxOf(parts[lane]);
      for (int axis = 0; axis < 3; ++axis) {
        nodes_[index].lower[axis][lane] = box.lower[axis];
        nodes_[index].upper[axis][lane] = box.upper[axis];
      }
      setSlab(nodes_[index], lane, parts[lane]);
      nodes_[index].firstPacket[lane] = static_cast<std::uint32_t>(packets_.size());
      const bool leaf = parts[lane].count() <= TrianglePacket::kWidth;
      const std::uint32_t child = leaf ? buildLeaf(parts[lane]) : buildNode(parts[lane], depth + 1);
      nodes_[index].child[lane] = child;  // after the recursion, which may move the nodes
    }
    return index;
  }

  /// The slab's direction: the mean normal of the range's triangles, by area.
  void setSlab(HierarchyNode& node, int lane, Range range) const {
    Vec3d sum;
    for (std::uint32_t i = range.begin; i < range.end; ++i) {
      const auto& [a, b, c] = mesh_.corners(order_[i]);
      sum += cross(b - a, c - a);
    }
    const double norm = length(sum);
    if (!(norm > 0)) return;  // the surface is closed, or its area vanishes in double precision
    const Vec3d normal = sum / norm;
    double lower = kInfinity, upper = -kInfinity;
    for (std::uint32_t i = range.begin; i < range.end; ++i) {
      for (const Vec3d& corner : mesh_.corners(order_[i])) {
        lower = std::min(lower, dot(normal, corner));
        upper = std::max(upper, dot(normal, corner));
      }
    }
    for (int axis = 0; axis < 3; ++axis) node.normal[axis][lane] = normal[axis];
    node.slabLower[lane] = lower - HierarchyNode::kSlabShare * largest_;
    node.slabUpper[lane] = upper + HierarchyNode::kSlabShare * largest_;
  }

  /// Splits the costliest part until there are four parts or all fit a leaf. Returns the number of parts.
  int divide(std::array<Range, HierarchyNode::kWidth>& parts, std::uint32_t depth) {
    int count = 1;
    while (count < HierarchyNode::kWidth) {
      int worst = -1;
      double worstCost = 0;
      for (int i = 0; i < count; ++i) {
        if (parts[i].count() <= TrianglePacket::kWidth) continue;
        const double cost = boxOf(parts[i]).halfArea() * parts[i].count();
        if (worst < 0 || cost > worstCost) worst = i, worstCost = cost;
      }
      if (worst < 0) break;
      const Range whole = parts[worst];
      const std::uint32_t middle = split(whole, depth);
      parts[worst] = {whole.begin, middle};
      parts[count++] = {middle, whole.end};
    }
    return count;
  }

  std::uint32_t buildLeaf(Range range) {
    const auto index = static_cast<std::uint32_t>(packets_.size());
    packets_.emplace_back();
    // Free lanes repeat the last triangle. They can tie with it, but never be nearer.
    for (std::uint32_t lane = 0; lane < TrianglePacket::kWidth; ++lane) {
      const std::uint32_t triangle = order_[std::min(range.begin + lane, range.end - 1)];
      packets_.back().set(static_cast<int>(lane), triangle, mesh_.corners(triangle));
    }
    return index | HierarchyNode::kPacketBit;
  }

  Box boxOf(Range range) const {
    Box box;
    for (std::uint32_t i = range.begin; i < range.end; ++i) box.add(boxes_[order_[i]]);
    return box;
  }

  /// Reorders a range into two non-empty parts and returns where the second begins.
  std::uint32_t split(Range range, std::uint32_t depth) {
    Box centers;
    for (std::uint32_t i = range.begin; i < range.end; ++i) centers.add(centers_[order_[i]]);
    const Split best = depth < kMaxHeuristicDepth ? bestSplit(range, centers) : Split{};
    if (best.cost == kInfinity) return splitByCount(range, centers);
    const auto left = [&](std::uint32_t t) { return binOf(t, best.axis, centers) < best.bin; };
    const auto middle = std::stable_partition(order_.begin() + range.begin, order_.begin() + range.end, left);
    return static_cast<std::uint32_t>(middle - order_.begin());
  }

  int binOf(std::uint32_t triangle, int axis, const Box& centers) const {
    const double extent = centers.upper[axis] - centers.lower[axis];
    const double position = (centers_[triangle][axis] - centers.lower[axis]) / extent;
    return std::min(static_cast<int>(position * kBins), kBins - 1);
  }

  Split bestSplit(Range range, const Box& centers) const {
    Split best;
    for (int axis = 0; axis < 3; ++axis) {
      if (!(centers.upper[axis] > centers.lower[axis])) continue;
      std::array<Box, kBins> boxes;
      std::array<std::uint32_t, kBins> counts{};
      for (std::uint32_t i = range.begin; i < range.end; ++i) {
        const int bin = binOf(order_[i], axis, centers);
        boxes[bin].add(boxes_[order_[i]]);
        ++counts[bin];
      }
      sweep(boxes, counts, axis, best);
    }
    return best;
  }

  static void sweep(const std::array<Box, kBins>& boxes, const std::array<std::uint32_t, kBins>& counts, int axis,
                    Split& best) {
    std::array<double, kBins> rightCost{};
    Box right;
    std::uint32_t rightCount = 0;
    for (int bin = kBins - 1; bin > 0; --bin) {
      right.add(boxes[bin]);
      rightCount += counts[bin];
      rightCost[bin] = rightCount == 0 ? kInfinity : right.halfArea() * rightCount;
    }
    Box left;
    std::uint32_t leftCount = 0;
    for (int bin = 1; bin < kBins; ++bin) {
      left.add(boxes[bin - 1]);
      leftCount += counts[bin - 1];
      const double cost = leftCount == 0 ? kInfinity : left.halfArea() * leftCount + rightCost[bin];
      if (cost < best.cost) best = {cost, axis, bin};
    }
  }

  std::uint32_t splitByCount(Range range, const Box& centers) {
    const Vec3d extent = centers.upper - centers.lower;
    const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
    const std::uint32_t middle = range.begin + range.count() / 2;
    std::nth_element(order_.begin() + range.begin, order_.begin() + middle, order_.begin() + range.end,
                     [&](std::uint32_t a, std::uint32_t b) {
                       return std::pair(centers_[a][axis], a) < std::pair(centers_[b][axis], b);
                     });
    return middle;
  }

  const TriangleMesh& mesh_;
  std::vector<HierarchyNode>& nodes_;
  std::vector<TrianglePacket>& packets_;
  std::vector<std::uint32_t> order_;
  std::vector<Box> boxes_;
  std::vector<Vec3d> centers_;
  double largest_ = 0;  // coordinate
};

TriangleHierarchy::TriangleHierarchy(const TriangleMesh& mesh) {
  assert(!mesh.triangles.empty());
  Builder(mesh, nodes_, packets_);
  places_.resize(mesh.triangles.size());
  for (std::uint32_t packet = 0; packet < packets_.size(); ++packet) {
    for (int lane = 0; lane < TrianglePacket::kWidth; ++lane) places_[packets_[packet].triangle[lane]] = {packet, lane};
  }
}

}  // namespace cairn::builder

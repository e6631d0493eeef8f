// SPDX-License-Identifier: Zlib
#include "queries/region_balls.h"

#include <algorithm>
#include <array>

namespace cairn::bullet {

namespace {

struct Bounds {
  Vec3 lower{Family::kNowhere, Family::kNowhere, Family::kNowhere};
  Vec3 upper{-Family::kNowhere, -Family::kNowhere, -Family::kNowhere};

  void add(const Vec3& p) {
    for (int axis = 0; axis < 3; ++axis) {
      lower[axis] = std::min(lower[axis], p[axis]);
      upper[axis] = std::max(upper[axis], p[axis]);
    }
  }
  int longestAxis() const {
    const Vec3 extent = upper - lower;
    if (extent.x >= extent.y && extent.x >= extent.z) return 0;
    return extent.y >= extent.z ? 1 : 2;
  }
};

}  // namespace

RegionBalls::RegionBalls(const SphereTree& tree) : tree_(&tree), firstFamily_(tree.traversalNodes().size(), kNone) {
  for (std::uint32_t record = 0; record < tree.nodeCount(); ++record) {
    const NodeId leaf = tree.nodeAt(record);
    const auto region = tree.regionTriangles(leaf);
    if (!tree.isLeaf(leaf) || region.size() <= kAtOnce) continue;
    const auto first = static_cast<std::uint32_t>(order_.size());
    order_.insert(order_.end(), region.begin(), region.end());
    firstFamily_[leaf] = addFamily({first, static_cast<std::uint32_t>(region.size())});
  }
}

std::uint32_t RegionBalls::addFamily(Part whole) {
  const auto family = static_cast<std::uint32_t>(families_.size());
  families_.emplace_back();
  living_.push_back(0);
  parts_.resize(parts_.size() + kFamilyWidth);
  std::array<Part, kFamilyWidth> parts{whole};
  std::uint32_t count = 1;
  while (count < kFamilyWidth) count = halve(parts.data(), count);
  for (std::uint32_t lane = 0; lane < count; ++lane) {
    families_[family].set(lane, ballAround(parts[lane]));
    living_[family] |= 1U << lane;
    const Part part = parts[lane].count > kAtOnce ? Part{addFamily(parts[lane]), 0} : parts[lane];
    parts_[family * kFamilyWidth + lane] = part;
  }
  return family;
}

void RegionBalls::follow(const SphereTree& moved) {
  tree_ = &moved;
  for (std::uint32_t family = 0; family < families_.size(); ++family)
    for (std::uint32_t lanes = living_[family]; lanes != 0; lanes &= lanes - 1) {
      const auto lane = static_cast<std::uint32_t>(std::countr_zero(lanes));
      const Part part = parts_[family * kFamilyWidth + lane];
      families_[family].set(lane, ballAround(part.count == 0 ? wholeOf(part.first) : part));
    }
}

// Lanes hold what was cut apart, one after the other.
RegionBalls::Part RegionBalls::wholeOf(std::uint32_t family) const {
  const auto partOf = [&](std::uint32_t lane) {
    const Part part = parts_[family * kFamilyWidth + lane];
    return part.count == 0 ? wholeOf(part.first) : part;
  };
  const Part first = partOf(0), last = partOf(static_cast<std::uint32_t>(std::bit_width(living_[family])) - 1);
  return {first.first, last.first + last.count - first.first};
}

// Cuts each part along its longest axis, into equal numbers of triangles, so that the same mesh gives the same balls.
std::uint32_t RegionBalls::halve(Part* parts, std::uint32_t count) {
  for (std::uint32_t i = count; i-- > 0;) {
    const Part part = parts[i];
    const auto begin = order_.begin() + part.first, end = begin + part.count;
    Bounds middles;
    for (auto it = begin; it != end; ++it) middles.add(middle(*it));
    const int axis = middles.longestAxis();
    std::nth_element(begin, begin + part.count / 2, end, [&](std::uint32_t s, std::uint32_t t) {
      const float a = middle(s)[axis], b = middle(t)[axis];
      return a != b ? a < b : s < t;
    });
    parts[2 * i] = {part.first, part.count / 2};
    parts[2 * i + 1] = {part.first + part.count / 2, part.count - part.count / 2};
  }
  return 2 * count;
}

Sphere RegionBalls::ballAround(Part part) const {
  Bounds bounds;
  const auto forEachCorner = [&](const auto& visit) {
    for (std::uint32_t i = part.first; i < part.first + part.count; ++i)
      for (const std::uint32_t corner : tree_->triangles()[order_[i]]) visit(tree_->vertices()[corner]);
  };
  forEachCorner([&](const Vec3& p) { bounds.add(p); });
  Sphere ball{(bounds.lower + bounds.upper) * 0.5F, 0};
  forEachCorner([&](const Vec3& p) { ball.radius = std::max(ball.radius, distance(p, ball.center)); });
  ball.radius *= 1 + kOverlapSlack;
  return ball;
}

Vec3 RegionBalls::middle(std::uint32_t triangle) const {
  const auto& t = tree_->triangles()[triangle];
  return (tree_->vertices()[t[0]] + tree_->vertices()[t[1]] + tree_->vertices()[t[2]]) / 3.0F;
}

}  // namespace cairn::bullet

// SPDX-License-Identifier: GPL-3.0-or-later
#include "balls/nearest_ball.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace cairn::builder {

namespace {

constexpr std::uint32_t kLeafSize = 8;

}  // namespace

NearestBall::NearestBall(std::vector<EnclosingBall> balls) : balls_(std::move(balls)), order_(balls_.size()) {
  assert(!balls_.empty());
  std::iota(order_.begin(), order_.end(), 0U);
  build(0, static_cast<std::uint32_t>(order_.size()));
}

void NearestBall::build(std::uint32_t begin, std::uint32_t end) {
  const auto index = static_cast<std::uint32_t>(nodes_.size());
  Node node{balls_[order_[begin]].center, balls_[order_[begin]].center, 0, begin, end, 0};
  for (std::uint32_t i = begin; i < end; ++i) {
    const EnclosingBall& ball = balls_[order_[i]];
    node.radius = std::max(node.radius, ball.radius);
    for (int axis = 0; axis < 3; ++axis) {
      node.lower[axis] = std::min(node.lower[axis], ball.center[axis]);
      node.upper[axis] = std::max(node.upper[axis], ball.center[axis]);
    }
  }
  nodes_.push_back(node);
  if (end - begin <= kLeafSize) return;
  const Vec3d extent = node.upper - node.lower;
  const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
  const std::uint32_t middle = begin + (end - begin) / 2;
  std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                   [&](std::uint32_t a, std::uint32_t b) {
                     return std::pair(balls_[a].center[axis], a) < std::pair(balls_[b].center[axis], b);
                   });
  build(begin, middle);
  nodes_[index].right = static_cast<std::uint32_t>(nodes_.size());
  build(middle, end);
}

/// Lower bound of the distance to all balls of the node. Every operation here is monotone, also after rounding.
double NearestBall::bound(const Node& node, const Vec3d& point) {
  Vec3d gap;
  for (int axis = 0; axis < 3; ++axis)
    gap[axis] = std::max({node.lower[axis] - point[axis], point[axis] - node.upper[axis], 0.0});
  return length(gap) - node.radius;
}

void NearestBall::search(std::uint32_t index, const Vec3d& point, Best& best) const {
  const Node& node = nodes_[index];
  if (bound(node, point) > best.distance) return;
  if (node.right == 0) {
    for (std::uint32_t i = node.begin; i < node.end; ++i) {
      const std::uint32_t ball = order_[i];
      const double d = distance(point, balls_[ball].center) - balls_[ball].radius;
      if (d < best.distance || (d == best.distance && ball < best.ball)) best = {d, ball};
    }
    return;
  }
  std::uint32_t near = index + 1, far = node.right;
  if (bound(nodes_[far], point) < bound(nodes_[near], point)) std::swap(near, far);
  search(near, point, best);
  search(far, point, best);
}

std::size_t NearestBall::to(const Vec3d& point) const {
  Best best{std::numeric_limits<double>::infinity(), 0};
  search(0, point, best);
  return best.ball;
}

}  // namespace cairn::builder

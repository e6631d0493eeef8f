// SPDX-License-Identifier: Zlib
#include "kernel/near_patches.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "kernel/near_box.h"

namespace cairn::bullet {

namespace {

using Node = SurfacePatches::Node;

// Boxes of one side, seen from the other.
struct BoxView {
  Similarity to;
  Mat3 sizes;  // absolute values of the linear part
  NearLimits limits;  // in the other's frame
  float scale;  // the other's

  BoxView(const PlacedSurface& side, const PlacedSurface& other, const ContactLimits& of)
      : to(side.toOther), limits(other.scale, of), scale(other.scale) {
    for (std::size_t row = 0; row < 3; ++row)
      for (int column = 0; column < 3; ++column)
        sizes.rows[row][column] = std::abs(to.linear.rows[row][column]);
  }

  struct Placed {
    Vec3 middle, half;
  };
  Placed place(const Box& box) const { return {to * box.middle(), sizes * ((box.upper - box.lower) * 0.5F)}; }
};

// How far a box is from another on the axis on which they are farthest apart; negative: overlaps on all.
float boxesApart(const BoxView::Placed& box, const Box& other) {
  float most = -std::numeric_limits<float>::infinity();
  for (int axis = 0; axis < 3; ++axis)
    most = std::max({most, box.middle[axis] - box.half[axis] - other.upper[axis],
                     other.lower[axis] - box.middle[axis] - box.half[axis]});
  return most;
}

float size(const Node& node, float scale) {
  return lengthSq(node.box.upper - node.box.lower) * scale * scale;
}

}  // namespace

bool NearPatches::find(const SurfacePair& surfaces, const ContactLimits& limits, Budget& budget) {
  const std::span<const Node> ofA = surfaces.a.surface().patches.nodes(), ofB = surfaces.b.surface().patches.nodes();
  const BoxView fromA(surfaces.a, surfaces.b, limits), fromB(surfaces.b, surfaces.a, limits);
  found_.clear();
  apart_ = std::numeric_limits<float>::infinity();
  waiting_.assign(1, {0, 0});
  while (!waiting_.empty()) {
    const Pair pair = waiting_.back();
    waiting_.pop_back();
    const Node &a = ofA[pair.a], &b = ofB[pair.b];
    if (!budget.charge(kOverlapTestCost)) return false;
    const BoxView::Placed aInB = fromA.place(a.box), bInA = fromB.place(b.box);
    if (boxesApart(aInB, fromA.limits.around(b.box, b.normals)) > 0 ||
        boxesApart(bInA, fromB.limits.around(a.box, a.normals)) > 0) {
      apart_ = std::min(apart_, std::max(boxesApart(aInB, b.box) * fromA.scale, boxesApart(bInA, a.box) * fromB.scale));
      continue;
    }
    if (a.isLeaf() && b.isLeaf()) {
      found_.push_back({a.patch, b.patch});
    } else if (b.isLeaf() || (!a.isLeaf() && size(a, surfaces.a.scale) > size(b, surfaces.b.scale))) {
      waiting_.push_back({a.second, pair.b});
      waiting_.push_back({pair.a + 1, pair.b});
    } else {
      waiting_.push_back({pair.a, b.second});
      waiting_.push_back({pair.a, pair.b + 1});
    }
  }
  apart_ -= limits.margins;
  return true;
}

}  // namespace cairn::bullet

// SPDX-License-Identifier: Zlib
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>

#include "extruded.h"

namespace cairn::test {

/// An outline of distances from the z axis and heights, turned around that axis; counterclockwise, with the distances
/// to the right.
inline Solid turnedAround(const Outline& outline, int sides) {
  detail::SolidWriter out;
  const auto at = [&](std::size_t i, int side) {
    const auto& [distance, height] = outline[i % outline.size()];
    const double angle = 2 * std::numbers::pi * (side % sides) / sides;
    return Vec3d(distance * std::cos(angle), distance * std::sin(angle), height);
  };
  for (std::size_t i = 0; i < outline.size(); ++i)
    for (int side = 0; side < sides; ++side) {
      const Vec3d a = at(i, side), b = at(i, side + 1), c = at(i + 1, side + 1), d = at(i + 1, side);
      const bool startsOnAxis = outline[i][0] == 0, endsOnAxis = outline[(i + 1) % outline.size()][0] == 0;
      if (!startsOnAxis) out.triangle(a, b, endsOnAxis ? d : c);
      if (!endsOnAxis) out.triangle(a, c, d);
    }
  return out.solid;
}

/// A tube between two outlines of as many corners, given by angle: each may be twisted, by so many radians a metre. An
/// inner one of no size makes it solid.
struct Tube {
  std::function<double(double)> outer, inner;  // distances from the axis
  double outerTwist = 0, innerTwist = 0;
};

inline Solid twisted(const Tube& tube, int sides, double lower, double upper, int layers) {
  detail::SolidWriter out;
  const auto at = [&](const std::function<double(double)>& distance, double twist, int side, int layer) {
    const double angle = 2 * std::numbers::pi * (side % sides) / sides;
    const double z = lower + (upper - lower) * layer / layers, turned = angle + twist * z, r = distance(angle);
    return Vec3d(r * std::cos(turned), r * std::sin(turned), z);
  };
  const auto outer = [&](int side, int layer) { return at(tube.outer, tube.outerTwist, side, layer); };
  const auto inner = [&](int side, int layer) {
    return tube.inner ? at(tube.inner, tube.innerTwist, side, layer) : at([](double) { return 0; }, 0, 0, layer);
  };
  const auto quad = [&](const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& d) {
    out.triangle(a, b, c);
    if (tube.inner) out.triangle(a, c, d);
  };
  for (int side = 0; side < sides; ++side) {
    for (int layer = 0; layer < layers; ++layer) {
      const Vec3d a = outer(side, layer), b = outer(side + 1, layer), c = outer(side + 1, layer + 1);
      out.triangle(a, b, c);
      out.triangle(a, c, outer(side, layer + 1));
      if (!tube.inner) continue;
      const Vec3d d = inner(side, layer), e = inner(side + 1, layer + 1);
      out.triangle(d, e, inner(side + 1, layer));
      out.triangle(d, inner(side, layer + 1), e);
    }
    quad(outer(side, layers), outer(side + 1, layers), inner(side + 1, layers), inner(side, layers));
    quad(outer(side + 1, 0), outer(side, 0), inner(side, 0), inner(side + 1, 0));
  }
  return out.solid;
}

}  // namespace cairn::test

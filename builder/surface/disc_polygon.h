// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

namespace cairn::builder {

/// A point of a plane.
struct Point2 {
  double u = 0, v = 0;
};

/// Integrals over a part of a disc around the plane's origin.
struct DiscMoments {
  double area = 0;
  double u = 0, v = 0;            ///< of the coordinates
  double uu = 0, uv = 0, vv = 0;  ///< of their products
  double solidAngle = 0;          ///< as seen from `height` above the origin
};

/// A convex polygon, counter-clockwise.
class ConvexPolygon {
 public:
  /// A square around the origin, `half` being half of its edge.
  explicit ConvexPolygon(double half);

  bool empty() const { return corners_.empty(); }
  /// Keeps what lies where a u + b v <= c. Linear.
  void cut(double a, double b, double c);
  /// Integrals over the polygon's part in the disc of `radius`, in closed form: triangles and sectors between the
  /// origin and each edge, signed. `height` >= 0.
  DiscMoments withinDisc(double radius, double height) const;

 private:
  std::vector<Point2> corners_, kept_;
};

}  // namespace cairn::builder

// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/disc_polygon.h"

#include <algorithm>
#include <cmath>

namespace cairn::builder {
namespace {

double cross(const Point2& a, const Point2& b) {
  return a.u * b.v - a.v * b.u;
}

Point2 between(const Point2& a, const Point2& b, double t) {
  return {a.u + t * (b.u - a.u), a.v + t * (b.v - a.v)};
}

class DiscSum {
 public:
  DiscSum(double radius, double height) : radius_(radius), height_(height) {}

  /// What lies between the origin and an edge, counter-clockwise positive.
  void addEdge(const Point2& a, const Point2& b) {
    const Point2 d{b.u - a.u, b.v - a.v};
    const double dd = d.u * d.u + d.v * d.v, ad = a.u * d.u + a.v * d.v;
    const double root = ad * ad - dd * (a.u * a.u + a.v * a.v - radius_ * radius_);
    if (!(dd > 0)) return;
    if (root <= 0) return addSector(a, b);
    const double t1 = (-ad - std::sqrt(root)) / dd, t2 = (-ad + std::sqrt(root)) / dd;
    if (t2 <= 0 || t1 >= 1) return addSector(a, b);
    const Point2 p = t1 > 0 ? between(a, b, t1) : a, q = t2 < 1 ? between(a, b, t2) : b;
    if (t1 > 0) addSector(a, p);
    addTriangle(p, q);
    if (t2 < 1) addSector(q, b);
  }

  const DiscMoments& sum() const { return sum_; }

 private:
  void addTriangle(const Point2& p, const Point2& q) {
    const double area = cross(p, q) / 2;
    const Point2 s{p.u + q.u, p.v + q.v};
    sum_.area += area;
    sum_.u += area * s.u / 3;
    sum_.v += area * s.v / 3;
    sum_.uu += area / 12 * (p.u * p.u + q.u * q.u + s.u * s.u);
    sum_.uv += area / 12 * (p.u * p.v + q.u * q.v + s.u * s.v);
    sum_.vv += area / 12 * (p.v * p.v + q.v * q.v + s.v * s.v);
    // Van Oosterom and Strackee 1983, for corners at the origin, p and q, seen from `height` above the origin.
    const double h2 = height_ * height_, pq = p.u * q.u + p.v * q.v;
    const double toP = std::sqrt(p.u * p.u + p.v * p.v + h2), toQ = std::sqrt(q.u * q.u + q.v * q.v + h2);
    sum_.solidAngle +=
        2 * std::atan2(height_ * cross(p, q), height_ * toP * toQ + h2 * toQ + h2 * toP + (pq + h2) * height_);
  }

  /// The sector between the directions of a and b.
  void addSector(const Point2& a, const Point2& b) {
    const double angle = std::atan2(cross(a, b), a.u * b.u + a.v * b.v);
    const double toA = std::hypot(a.u, a.v), toB = std::hypot(b.u, b.v);
    if (!(toA > 0 && toB > 0)) return;
    const double ca = a.u / toA, sa = a.v / toA, cb = b.u / toB, sb = b.v / toB;
    const double r2 = radius_ * radius_, r3 = r2 * radius_ / 3, r4 = r2 * r2 / 8;
    sum_.area += r2 * angle / 2;
    sum_.u += r3 * (sb - sa);
    sum_.v += r3 * (ca - cb);
    sum_.uu += r4 * (angle + cb * sb - ca * sa);
    sum_.vv += r4 * (angle - cb * sb + ca * sa);
    sum_.uv += r4 * (sb * sb - sa * sa);
    sum_.solidAngle += angle * (1 - height_ / std::hypot(radius_, height_));
  }

  double radius_, height_;
  DiscMoments sum_;
};

}  // namespace

ConvexPolygon::ConvexPolygon(double half) : corners_{{-half, -half}, {half, -half}, {half, half}, {-half, half}} {}

void ConvexPolygon::cut(double a, double b, double c) {
  kept_.clear();
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    const Point2 &p = corners_[i], &q = corners_[(i + 1) % corners_.size()];
    const double outP = a * p.u + b * p.v - c, outQ = a * q.u + b * q.v - c;
    if (outP <= 0) kept_.push_back(p);
    if ((outP < 0 && outQ > 0) || (outP > 0 && outQ < 0)) kept_.push_back(between(p, q, outP / (outP - outQ)));
  }
  if (kept_.size() < 3) kept_.clear();
  std::swap(corners_, kept_);
}

DiscMoments ConvexPolygon::withinDisc(double radius, double height) const {
  DiscSum sum(radius, height);
  for (std::size_t i = 0; i < corners_.size(); ++i) sum.addEdge(corners_[i], corners_[(i + 1) % corners_.size()]);
  return sum.sum();
}

}  // namespace cairn::builder

// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/union_mass.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "surface/disc_polygon.h"

namespace cairn::builder {
namespace {

/// Planes whose normals and distances differ by no more (as a part of the radius) are one.
constexpr double kSameCellPlane = 1e-12;

/// Where a ball's cell of the power diagram ends towards another ball: normal . x <= height, from the ball's centre.
struct CellPlane {
  Vec3d normal;
  double height = 0;
};

/// The planes that cut a ball; nothing when no part of it lies in its cell.
std::optional<std::vector<CellPlane>> planesOf(std::span<const Ball> balls, std::size_t i) {
  std::vector<CellPlane> planes;
  const double r = balls[i].radius;
  for (std::size_t j = 0; j < balls.size(); ++j) {
    if (j == i) continue;
    const Vec3d to = balls[j].center - balls[i].center;
    const double apart = length(to), other = balls[j].radius;
    if (apart >= r + other) continue;
    if (apart + r <= other && (r < other || j < i)) return std::nullopt;  // of equal ones the first stays
    if (!(apart > 0)) continue;
    double height = (apart * apart + (r - other) * (r + other)) / (2 * apart);
    if (std::abs(height) <= kSameCellPlane * r) height = 0;  // through the centre: rounding is not to choose its side
    if (height <= -r) return std::nullopt;
    if (height < r) planes.push_back({to / apart, height});
  }
  return planes;
}

Mat3d outer(const Vec3d& a, const Vec3d& b) {
  return {{b * a.x, b * a.y, b * a.z}};
}

/// The part of a ball within its cell. About the ball's centre.
class CellPart {
 public:
  CellPart(double radius, const std::vector<CellPlane>& planes) : radius_(radius), planes_(planes) {}

  Moments run() {
    bool inside = true;
    for (std::size_t j = 0; j < planes_.size(); ++j) {
      inside = inside && planes_[j].height >= 0;
      addFace(j);
    }
    // Flux of x / |x|^3: 4 pi if the centre is inside, through the faces their solid angles, the rest through the
    // sphere.
    const double directions = (inside ? 4 * std::numbers::pi : 0) - angles_;
    Moments m;
    m.volume = (heightArea_ + radius_ * radius_ * radius_ * directions) / 3;
    m.first = (heightFirst_ - area_ * (radius_ * radius_)) / 4;
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b) {
        const double mixed = (normalFirst_(a, b) + normalFirst_(b, a)) / 2;
        m.second(a, b) = (heightSecond_(a, b) + radius_ * radius_ * ((a == b ? m.volume : 0) - mixed)) / 5;
      }
    return m;
  }

 private:
  /// Adds the face of plane `j`: the disc it cuts from the ball, within the other planes.
  void addFace(std::size_t j) {
    const auto& [normal, height] = planes_[j];
    const double disc = std::sqrt(std::max(0.0, (radius_ - height) * (radius_ + height)));
    const Vec3d e1 = normalized(cross(normal, std::abs(normal.x) < 0.6 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0}));
    const Vec3d e2 = cross(normal, e1), foot = normal * height;
    ConvexPolygon polygon(2 * disc);
    for (std::size_t k = 0; k < planes_.size() && !polygon.empty(); ++k) {
      if (k == j) continue;
      const double a = dot(planes_[k].normal, e1), b = dot(planes_[k].normal, e2);
      const double c = planes_[k].height - dot(planes_[k].normal, foot);
      if (std::abs(a) + std::abs(b) > kSameCellPlane) {
        polygon.cut(a, b, c);
      } else if (c < -kSameCellPlane * radius_ ||
                 (c <= kSameCellPlane * radius_ && k < j && dot(planes_[k].normal, normal) > 0)) {
        return;  // behind another plane, or the same as one that has been counted
      }
    }
    if (!polygon.empty()) add(normal, height, foot, e1, e2, polygon.withinDisc(disc, std::abs(height)));
  }

  void add(const Vec3d& normal, double height, const Vec3d& foot, const Vec3d& e1, const Vec3d& e2,
           const DiscMoments& d) {
    const Vec3d offset = e1 * d.u + e2 * d.v;
    const Vec3d first = foot * d.area + offset;
    area_ += normal * d.area;
    heightArea_ += height * d.area;
    heightFirst_ += first * height;
    angles_ += height < 0 ? -d.solidAngle : d.solidAngle;
    const Mat3d normalFirst = outer(normal, first), ff = outer(foot, foot), fo = outer(foot, offset),
                of = outer(offset, foot), uu = outer(e1, e1), uv = outer(e1, e2), vu = outer(e2, e1),
                vv = outer(e2, e2);
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b) {
        normalFirst_(a, b) += normalFirst(a, b);
        heightSecond_(a, b) += height * (ff(a, b) * d.area + fo(a, b) + of(a, b) + uu(a, b) * d.uu +
                                         (uv(a, b) + vu(a, b)) * d.uv + vv(a, b) * d.vv);
      }
  }

  double radius_;
  const std::vector<CellPlane>& planes_;
  // Sums over faces, of area A, first moment m and second moment S about the centre.
  double heightArea_ = 0, angles_ = 0;               // height A; solid angles, signed
  Vec3d area_, heightFirst_;                         // normal A; height m
  Mat3d normalFirst_{{Vec3d{}, Vec3d{}, Vec3d{}}};   // normal m^T
  Mat3d heightSecond_{{Vec3d{}, Vec3d{}, Vec3d{}}};  // height S
};

}  // namespace

Moments unionMoments(std::span<const Ball> balls, const Vec3d& reference) {
  Moments sum;
  for (std::size_t i = 0; i < balls.size(); ++i) {
    const auto planes = planesOf(balls, i);
    if (!planes) continue;
    const Moments part = CellPart(balls[i].radius, *planes).run();
    const Vec3d shift = balls[i].center - reference;
    sum.volume += part.volume;
    sum.first += part.first + shift * part.volume;
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b)
        sum.second(a, b) +=
            part.second(a, b) + shift[a] * part.first[b] + part.first[a] * shift[b] + part.volume * shift[a] * shift[b];
  }
  return sum;
}

}  // namespace cairn::builder

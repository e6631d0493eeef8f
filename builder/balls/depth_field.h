// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "surface/signed_distance.h"

namespace cairn::builder {

/// Relative margin for rounding: far above the rounding of a few distances, far below a cost that a search would
/// notice.
inline constexpr double kRoundingRoom = 1e-9;

/// Returns the unit vector from `from` to `to`; zero where the points are equal.
inline Vec3d directionFrom(const Vec3d& from, const Vec3d& to) {
  const Vec3d d = to - from;
  const double norm = length(d);
  return norm > 0 ? d / norm : Vec3d{};
}

/// The depth of points in a solid, for the fitting of spheres: a ball (c, R) has the stand-off R - depth(c). Mesh frame
/// and unit. Safe to query from many threads.
///
///     SolidDepth field(distance);
///     double standOff = radius - field.depth(center);
class DepthField {
 public:
  struct Sample {
    double depth = 0;  ///< positive inside
    Vec3d rise;        ///< unit direction of the steepest growth of the depth; zero on the surface itself
  };
  virtual ~DepthField() = default;
  virtual Sample at(const Vec3d& point) const = 0;
  /// Returns the same bits as `at(point)` in less time, for a point within `moved` of another point of depth `depth`.
  virtual Sample at(const Vec3d& point, double depth, double moved) const = 0;
  double depth(const Vec3d& point) const { return at(point).depth; }

  /// A part of the surface that the field is measured from, and its distance from some centre. The field names the
  /// part.
  using Part = NearPacket;
  /// Replaces `parts` by the parts that can decide the depth of points within `reach` of `center`. Returns the distance
  /// from the centre up to which parts were taken. A reach smaller by d needs only parts up to that distance less 2 d.
  /// Returns nothing when there are more than `most` parts. Precondition: `depth` is the depth of `center`.
  virtual std::optional<double> gather(const Vec3d& center, double depth, double reach, std::size_t most,
                                       std::vector<Part>& parts) const = 0;
  /// Returns the same bits as `at(point)` without a search, for a point within the reach of `parts`. `moved` is an
  /// upper bound of the distance from their centre to the point.
  virtual Sample atAmong(std::span<const Part> parts, const Vec3d& point, double moved) const = 0;
};

/// The signed distance s(c) itself: R - s(c) bounds the protrusion for every R (thesis Eq. 5.1).
class SolidDepth final : public DepthField {
 public:
  /// Keeps a reference to `solid`, which must outlive this object.
  explicit SolidDepth(const SignedDistance& solid) : solid_(solid) {}
  Sample at(const Vec3d& point) const override;
  Sample at(const Vec3d& point, double depth, double moved) const override;
  std::optional<double> gather(const Vec3d& center, double depth, double reach, std::size_t most,
                               std::vector<Part>& parts) const override;
  Sample atAmong(std::span<const Part> parts, const Vec3d& point, double moved) const override;

 private:
  const SignedDistance& solid_;
};

/// Depth in the *closing* of the solid at a scale e: the distance to the points that lie e from the solid, less e. A
/// ball protrudes by at most e exactly when it holds no such point, that is, when R - depth(c) <= e. The signed
/// distance would instead charge the ball for every narrow concavity it fills. Such balls are the maximal balls of the
/// offset solid, centres outside the solid included (survey C3.2). A value below e says less: such a ball may protrude
/// by any amount up to e.
class ClosedDepth final : public DepthField {
 public:
  /// Samples the offset surface about `spacing` apart where it meets the ball (`center`, `reach`). Depths come out too
  /// large by up to spacing^2 / (2 (e + depth)), and by more for balls that leave this ball. The field is for fitting,
  /// not for proof. Cost: about 10 distance queries for each sample. Preconditions: all lengths are positive.
  ClosedDepth(const SignedDistance& solid, double scale, double spacing, const Vec3d& center, double reach);
  /// False when no point near the ball is as far as `scale` from the solid. The field then has nothing to measure from.
  bool usable() const;
  ~ClosedDepth() override;
  Sample at(const Vec3d& point) const override;
  Sample at(const Vec3d& point, double depth, double moved) const override;
  std::optional<double> gather(const Vec3d& center, double depth, double reach, std::size_t most,
                               std::vector<Part>& parts) const override;
  Sample atAmong(std::span<const Part> parts, const Vec3d& point, double moved) const override;

 private:
  Sample nearestTo(const Vec3d& point, double withinSq) const;
  Sample sampleFrom(std::size_t nearest, double distanceSq, const Vec3d& point) const;

  struct OffsetSurface;
  double scale_;
  std::unique_ptr<OffsetSurface> offset_;
};

}  // namespace cairn::builder

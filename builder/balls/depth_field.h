// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "surface/signed_distance.h"

namespace cairn::builder {

/// A part far above the rounding of a few distances, far below what it would add to a search.
inline constexpr double kRoundingRoom = 1e-9;

/// Unit vector; zero where the points are the same.
inline Vec3d directionFrom(const Vec3d& from, const Vec3d& to) {
  const Vec3d d = to - from;
  const double norm = length(d);
  return norm > 0 ? d / norm : Vec3d{};
}

/// How deep a point lies in a solid, as the fitting of spheres sees it: a ball (c, R) stands off by R - depth(c). Mesh
/// frame and unit. Safe to query from many threads.
class DepthField {
 public:
  struct Sample {
    double depth = 0;  ///< positive inside
    Vec3d rise;        ///< unit direction in which the depth grows fastest; zero on the surface itself
  };
  virtual ~DepthField() = default;
  virtual Sample at(const Vec3d& point) const = 0;
  /// The same to the bit in less time, when the point is within `moved` of one of depth `depth`.
  virtual Sample at(const Vec3d& point, double depth, double moved) const = 0;
  double depth(const Vec3d& point) const { return at(point).depth; }

  /// A part of what the field is measured from, named by the field, and its distance from some centre.
  using Part = NearPacket;
  /// Replaces `parts` by those that can decide the depth of points within `reach` of `center`. Returns the distance up
  /// to which they were taken, for a smaller reach less by twice the difference; nothing when they are more than
  /// `most`. Precondition: `depth` is that of `center`.
  virtual std::optional<double> gather(const Vec3d& center, double depth, double reach, std::size_t most,
                                       std::vector<Part>& parts) const = 0;
  /// `at` of a point within the reach that `parts` were gathered for, to the bit, without a search. `moved` is how far
  /// it is from their centre, or more.
  virtual Sample atAmong(std::span<const Part> parts, const Vec3d& point, double moved) const = 0;
};

/// The signed distance s(c) itself: R - s(c) is a bound of the protrusion for every R (thesis Eq. 5.1).
class SolidDepth final : public DepthField {
 public:
  /// Keeps a reference to `solid`, which must outlive this.
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
/// ball protrudes by at most e iff it holds no such point, so R - depth(c) <= e says exactly that, where the signed
/// distance would charge the ball for every narrow concavity it fills (survey C3.2: maximal balls of the offset solid,
/// centres outside included). Below e it says less: such a ball may protrude by anything up to e.
class ClosedDepth final : public DepthField {
 public:
  /// Samples the offset surface about `spacing` apart where it meets the ball (`center`, `reach`); depths come out too
  /// large by up to spacing^2 / (2 (e + depth)), and more for balls that leave that one. The field is for fitting, not
  /// for proof. About 10 distance queries for each sample. Preconditions: all lengths > 0.
  ClosedDepth(const SignedDistance& solid, double scale, double spacing, const Vec3d& center, double reach);
  /// False when no point near the ball is as far as `scale` from the solid; then there is nothing to measure from.
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

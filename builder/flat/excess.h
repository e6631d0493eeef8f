// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "balls/depth_field.h"
#include "balls/sphere_set.h"

namespace cairn::builder {

/// A set of balls that covers points of a surface, and the volume of its union outside the solid, counted by samples of
/// the layer around it. Knows what each ball alone covers and wastes, so that one ball can be moved at the cost of what
/// lies near it. Keeps references.
class Excess {
 public:
  /// `balls` have radii with which they cover all of `surface`; none may protrude beyond `reach`, as `field` sees it.
  Excess(const PointSet& surface, const PointSet& outside, const DepthField& field, double reach, SphereSet balls);

  const SphereSet& balls() const { return balls_; }
  /// Samples in any ball.
  std::size_t total() const { return total_; }
  /// Samples in ball `i` alone.
  std::size_t own(std::uint32_t i) const;

  /// Points only ball `i` covers.
  std::vector<std::uint32_t> dutiesOf(std::uint32_t i) const;
  /// The ball around the place near `start` where the points cost fewest samples beyond those in balls other than
  /// `without`, found by steps that are halved from `coarsest` down to a tenth; and how many these are.
  struct Fit {
    Ball ball;
    double cost = 0;
  };
  Fit fit(const std::vector<std::uint32_t>& points, const Vec3d& start, double coarsest,
          std::optional<std::uint32_t> without) const;
  void replace(std::uint32_t i, const Ball& ball);

  const PointSet& surface() const { return *surface_; }

 private:
  void enter(std::uint32_t i);
  void leave(std::uint32_t i);
  std::vector<std::uint32_t> openSamples(const Ball& region, std::optional<std::uint32_t> but) const;

  // Pointers, so that a set can be tried and taken back.
  const PointSet* surface_;
  const PointSet* outside_;
  const DepthField* field_;
  double reach_;
  SphereSet balls_;
  std::vector<std::uint16_t> covers_, wastes_;             // balls by point, by sample
  std::vector<std::vector<std::uint32_t>> held_, wasted_;  // by ball: the points, the samples in it, ascending
  std::size_t total_ = 0;
};

}  // namespace cairn::builder

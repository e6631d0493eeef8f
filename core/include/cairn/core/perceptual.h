// SPDX-License-Identifier: Zlib
#pragma once

#include <optional>

#include "cairn/core/export.h"

#include "cairn/core/ranked_priority.h"

namespace cairn {

/// Ranks pairs by how noticeable their errors are (after O'Sullivan and Dingliana 2001, who name gaps, eccentricity and
/// the importance of the event): rank = projected gap x visibility x acuity x momentum x (1 + age), with
///
/// * projected gap = certified error of the pair's answer / distance from the eye, radians;
///
/// * visibility = 1 in view and `kOutOfView` outside it, because errors outside may come into view;
///
/// * acuity = 1 / (1 + eccentricity / 2.5 degrees), see `acuityAt`;
///
/// * momentum = 1/2 + p / (p + mean p), p = mass closingSpeed. It is 1/2 at rest, 1 at the mean of the step's
/// unfinished pairs and 3/2 at most; 1 where nothing moves.
///
/// Without a viewer the projected gap is the error alone, world length, and visibility and acuity are 1.
class CAIRN_CORE_EXPORT Perceptual final : public RankedPriority {
 public:
  /// Visibility of a pair that is out of view.
  static constexpr double kOutOfView = 1.0 / 16;

  void setViewer(const std::optional<Viewer>& viewer) override { viewer_ = viewer; }
  /// The rank without error and age, the error being a fraction of the pair's size. The mean momentum is that of the
  /// last step that began.
  double importance(const ScheduledPair& pair) const override { return double(pair.size) * weight(pair); }

 protected:
  void beginWeights(std::span<const ScheduledPair> pairs) override;
  double weight(const ScheduledPair& pair) const override;

 private:
  double momentumFactor(const ScheduledPair& pair) const;

  std::optional<Viewer> viewer_;
  double meanMomentum_ = 0;
};

}  // namespace cairn

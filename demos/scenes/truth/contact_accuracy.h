// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "scenes/figures/quantiles.h"
#include "scenes/figures/spread.h"
#include "scenes/truth/frame_truth.h"

namespace cairn::scenes {

/// How right the contacts of a shape were over the frames that were checked. Lengths are fractions of body size. A pair
/// is *reported* if it has a contact point at all, whatever its distance: the solver acts on each.
struct ContactAccuracy {
  std::uint32_t frames = 0;
  std::uint32_t truePairs = 0;      ///< whose meshes meet, summed over the frames
  std::uint32_t reportedPairs = 0;  ///< summed over the frames
  std::uint32_t missed = 0;         ///< meet and are not reported
  double meanMissed = 0;            ///< penetration of the meshes, over the missed pairs
  double deepestMissed = 0;
  /// Missed pairs deeper than the worst certified error the sphere-tree gave for that frame; 0 for other shapes.
  std::uint32_t missedBeyondCertificate = 0;
  Spread falseGap;  ///< distance between the meshes of pairs that are reported and do not meet
  /// Error of a contact point: how far the point it gives for each of its bodies is from that body's mesh, the farther
  /// of the two.
  double meanError = 0;
  Quantiles error;
  /// The same point's distance from the nearer of the two meshes.
  double meanStray = 0;
  Quantiles stray;
  /// Error of a pair, of all that meet or are reported, each once: a missed one errs by its penetration, a reported one
  /// by its worst point, and by its gap where that is more. So many points of a pair outweigh nothing; many reported
  /// pairs do make a missed one count for less.
  double meanPairError = 0;
  Quantiles pairError;
};

/// Judges frame after frame.
class AccuracyJudge {
 public:
  explicit AccuracyJudge(double bodySize) : size_(bodySize) {}

  void judge(FrameTruth& truth, std::span<const ReportedContact> contacts, const StepRecord& record);
  ContactAccuracy result() const;

 private:
  /// Reported pairs, and the error of the worst point of each.
  using WorstPoints = std::map<BodyPair, double>;

  void judgeMeeting(FrameTruth& truth, const WorstPoints& reported, const StepRecord& record);
  void judgeReported(FrameTruth& truth, const WorstPoints& reported);
  double judgePoint(const FrameTruth& truth, const ReportedContact& contact);

  double size_;
  ContactAccuracy found_;
  SpreadOfLengths falseGaps_;
  std::vector<double> errors_, strays_, silences_, pairErrors_;
};

}  // namespace cairn::scenes

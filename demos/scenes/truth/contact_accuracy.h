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

/// The accuracy of a shape's contacts over the checked frames. Lengths are fractions of body size. A pair is *reported*
/// if it has any contact point, at any distance, because the solver acts on each point.
struct ContactAccuracy {
  std::uint32_t frames = 0;
  std::uint32_t truePairs = 0;      ///< pairs whose meshes meet, summed over the frames
  std::uint32_t reportedPairs = 0;  ///< summed over the frames
  std::uint32_t missed = 0;         ///< pairs that meet and are not reported
  double meanMissed = 0;            ///< penetration of the meshes, over the missed pairs
  double deepestMissed = 0;
  /// Missed pairs deeper than the worst certified error of the sphere-tree in that frame; 0 for other shapes.
  std::uint32_t missedBeyondCertificate = 0;
  Spread falseGap;  ///< distance between the meshes of reported pairs that do not meet
  /// Error of a contact point: the larger distance between the contact's point on a body and that body's mesh.
  double meanError = 0;
  Quantiles error;
  /// The distance of the same point from the nearer of the two meshes.
  double meanStray = 0;
  Quantiles stray;
  /// Error of a pair, over all pairs that meet or are reported, each once. The error of a missed pair is its
  /// penetration. The error of a reported pair is the larger of its worst point's error and its gap. So pairs with many
  /// points have no more weight than others. Many reported pairs do reduce the weight of a missed one.
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
  /// The reported pairs, each with the error of its worst point.
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

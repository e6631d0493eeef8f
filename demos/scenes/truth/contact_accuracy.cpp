// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenes/truth/contact_accuracy.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace cairn::scenes {
namespace {

double meanOf(const std::vector<double>& values) {
  return values.empty() ? 0 : std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

}  // namespace

void AccuracyJudge::judge(FrameTruth& truth, std::span<const ReportedContact> contacts, const StepRecord& record) {
  ++found_.frames;
  WorstPoints reported;
  for (const ReportedContact& contact : contacts) {
    double& worst = reported[bodyPair(contact.first, contact.second)];
    worst = std::max(worst, judgePoint(truth, contact));
  }
  judgeMeeting(truth, reported, record);
  judgeReported(truth, reported);
}

void AccuracyJudge::judgeMeeting(FrameTruth& truth, const WorstPoints& reported, const StepRecord& record) {
  found_.truePairs += static_cast<std::uint32_t>(truth.meeting().size());
  for (const BodyPair& pair : truth.meeting()) {
    if (reported.contains(pair)) continue;
    const double depth = truth.depth(pair) / size_;
    ++found_.missed;
    silences_.push_back(depth);
    pairErrors_.push_back(depth);
    found_.deepestMissed = std::max(found_.deepestMissed, depth);
    if (record.tree && depth > record.tree->worstErrorFraction) ++found_.missedBeyondCertificate;
  }
}

void AccuracyJudge::judgeReported(FrameTruth& truth, const WorstPoints& reported) {
  found_.reportedPairs += static_cast<std::uint32_t>(reported.size());
  for (const auto& [pair, worstPoint] : reported) {
    const double gap = truth.meets(pair) ? 0 : truth.gap(pair);
    if (!truth.meets(pair)) falseGaps_.add(gap);
    pairErrors_.push_back(std::max(worstPoint, gap / size_));
  }
}

double AccuracyJudge::judgePoint(const FrameTruth& truth, const ReportedContact& contact) {
  const double first = truth.distanceFromMesh(contact.first, contact.onFirst);
  const double second = truth.distanceFromMesh(contact.second, contact.onSecond);
  errors_.push_back(std::max(first, second) / size_);
  strays_.push_back(std::min(first, second) / size_);
  return errors_.back();
}

ContactAccuracy AccuracyJudge::result() const {
  ContactAccuracy result = found_;
  result.falseGap = falseGaps_.over(size_);
  result.meanError = meanOf(errors_);
  result.error = quantilesOf(errors_);
  result.meanStray = meanOf(strays_);
  result.stray = quantilesOf(strays_);
  result.meanMissed = meanOf(silences_);
  result.meanPairError = meanOf(pairErrors_);
  result.pairError = quantilesOf(pairErrors_);
  return result;
}

}  // namespace cairn::scenes

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

std::vector<BodyPair> pairsOf(std::span<const ReportedContact> contacts) {
  std::vector<BodyPair> pairs;
  for (const ReportedContact& contact : contacts) pairs.push_back(bodyPair(contact.first, contact.second));
  std::ranges::sort(pairs);
  const auto repeated = std::ranges::unique(pairs);
  pairs.erase(repeated.begin(), repeated.end());
  return pairs;
}

}  // namespace

void AccuracyJudge::judge(FrameTruth& truth, std::span<const ReportedContact> contacts, const StepRecord& record) {
  ++found_.frames;
  judgePairs(truth, pairsOf(contacts), record);
  for (const ReportedContact& contact : contacts) judgePoint(truth, contact);
}

void AccuracyJudge::judgePairs(FrameTruth& truth, const std::vector<BodyPair>& reported, const StepRecord& record) {
  found_.truePairs += static_cast<std::uint32_t>(truth.meeting().size());
  found_.reportedPairs += static_cast<std::uint32_t>(reported.size());
  for (const BodyPair& pair : truth.meeting()) {
    if (std::ranges::binary_search(reported, pair)) continue;
    const double depth = truth.depth(pair) / size_;
    ++found_.missed;
    silences_.push_back(depth);
    found_.deepestMissed = std::max(found_.deepestMissed, depth);
    if (record.tree && depth > record.tree->worstErrorFraction) ++found_.missedBeyondCertificate;
  }
  for (const BodyPair& pair : reported)
    if (!truth.meets(pair)) falseGaps_.add(truth.gap(pair));
}

void AccuracyJudge::judgePoint(const FrameTruth& truth, const ReportedContact& contact) {
  const double first = truth.distanceFromMesh(contact.first, contact.onFirst);
  const double second = truth.distanceFromMesh(contact.second, contact.onSecond);
  errors_.push_back(std::max(first, second) / size_);
  strays_.push_back(std::min(first, second) / size_);
}

ContactAccuracy AccuracyJudge::result() const {
  ContactAccuracy result = found_;
  result.falseGap = falseGaps_.over(size_);
  result.meanError = meanOf(errors_);
  result.error = quantilesOf(errors_);
  result.meanStray = meanOf(strays_);
  result.stray = quantilesOf(strays_);
  std::vector<double> answers = errors_;
  answers.insert(answers.end(), silences_.begin(), silences_.end());
  result.meanAnswerError = meanOf(answers);
  result.answerError = quantilesOf(std::move(answers));
  return result;
}

}  // namespace cairn::scenes

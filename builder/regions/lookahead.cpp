// SPDX-License-Identifier: GPL-3.0-or-later
#include "lookahead.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <numeric>
#include <optional>
#include <tuple>
#include <utility>

namespace cairn::builder {

namespace {

constexpr int kSwapRounds = 1;
/// First and last step of a bias, as fractions of the stand-off at which seams are divided.
constexpr double kFirstStep = 0.2, kLastStep = 0.02;
/// When the mean of the children's worst errors exceeds this fraction of the largest, siblings cannot help each other.
constexpr double kBalanced = 0.85;
constexpr double kStepAfterFailure = 0.5, kStepAfterSuccess = 1.5;
/// An attempt counts only if it lowers the worst error by this factor.
constexpr double kWorthwhile = 0.998;

}  // namespace

Lookahead::Lookahead(Split split, const SignedDistance& solid, const SplitSettings& settings)
    : split_(std::move(split)),
      next_(split_.children.size()),
      searched_(split_.children.size(), false),
      step_(kFirstStep) {
  tbb::parallel_for(std::size_t{0}, next_.size(),
                    [&](std::size_t i) { next_[i] = splitRegion(split_.children[i], solid, settings, 0); });
}

double Lookahead::worstGrandchild() const {
  double worst = 0;
  for (const Split& split : next_) worst = std::max(worst, split.worst());
  return worst;
}

std::size_t Lookahead::worstIndex() const {
  const auto worst = std::max_element(next_.begin(), next_.end(),
                                      [](const Split& a, const Split& b) { return a.worst() < b.worst(); });
  return static_cast<std::size_t>(worst - next_.begin());
}

bool Lookahead::relieve(double limit, const SignedDistance& solid, const SplitSettings& settings) {
  if (next_.size() < 2 || step_ < kLastStep || worstGrandchild() * kWorthwhile <= settings.negligible) return false;
  const std::size_t child = worstIndex();
  limit = std::min(limit, split_.allowed);
  if (!searched_[child]) {
    searchHarder(child, solid, settings);
    return true;
  }
  if (isBalanced()) return false;
  moveSeams(child, limit, solid, settings);
  return true;
}

bool Lookahead::isBalanced() const {
  double sum = 0;
  for (const Split& split : next_) sum += split.worst();
  return sum > kBalanced * worstGrandchild() * static_cast<double>(next_.size());
}

void Lookahead::searchHarder(std::size_t child, const SignedDistance& solid, const SplitSettings& settings) {
  next_[child] = refineSplit(next_[child], split_.children[child], solid, settings, kSwapRounds);
  searched_[child] = true;
}

std::vector<double> Lookahead::strongerBias(std::size_t child) const {
  std::vector<double> bias = split_.bias;
  const double worst = next_[child].worst();
  for (std::size_t i = 0; i < bias.size(); ++i)
    bias[i] += step_ * split_.standOff * std::max(0.0, 2 * next_[i].worst() / worst - 1);
  return bias;
}

std::vector<std::size_t> Lookahead::likelyWorstFirst(std::size_t child) const {
  std::vector<std::size_t> order(next_.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto rank = [&](std::size_t i) { return std::tuple(i != child, i != failed_, -next_[i].worst()); };
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return rank(a) < rank(b); });
  return order;
}

void Lookahead::moveSeams(std::size_t child, double limit, const SignedDistance& solid, const SplitSettings& settings) {
  std::optional<Split> moved = redivide(split_, strongerBias(child), std::max(limit, split_.standOff),
                                        std::max(limit, split_.worst()), solid, settings);
  step_ *= kStepAfterFailure;
  if (!moved || moved->children.size() != split_.children.size()) return;
  const auto stayed = [&](std::size_t i) { return moved->children[i].pieces == split_.children[i].pieces; };
  if (stayed(child)) return;
  const double goal = worstGrandchild() * kWorthwhile;
  // Balance compares the errors after a drop with those of the part's own division, so it then starts without a former
  // division.
  const Split nothing;
  std::vector<std::optional<SplitBelow>> next(next_.size());
  for (const std::size_t i : likelyWorstFirst(child)) {
    if (stayed(i)) continue;
    const Split& like = settings.balance ? nothing : next_[i];
    next[i] = splitBelow(moved->children[i], like, solid, settings, kSwapRounds, goal);
    if (!next[i]) {
      failed_ = i;
      return;
    }
  }
  for (std::size_t i = 0; i < next.size(); ++i) {
    if (!next[i]) continue;
    next_[i] = std::move(next[i]->split);
    searched_[i] = next[i]->refined;
  }
  split_ = *std::move(moved);
  step_ *= kStepAfterSuccess / kStepAfterFailure;
}

}  // namespace cairn::builder

// SPDX-License-Identifier: GPL-3.0-or-later
#include "rockfall/outputs/sample.h"

#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace cairn::rockfall {
namespace {

constexpr double kTail = 0.025;            // on each side
constexpr double kDeviations = 1.9599640;  // of a normal distribution, with this tail

}  // namespace

Sample::Sample(std::vector<double> values) : values_(std::move(values)) {
  std::ranges::sort(values_);
}

double Sample::mean() const {
  double sum = 0;
  for (const double value : values_) sum += value;
  return values_.empty() ? 0 : sum / static_cast<double>(values_.size());
}

double Sample::greatest() const {
  return values_.empty() ? 0 : values_.back();
}

double Sample::quantile(std::uint32_t thousandths) const {
  if (values_.empty()) return 0;
  const std::size_t rank = std::max<std::size_t>(1, (values_.size() * thousandths + 999) / 1000);
  return values_[rank - 1];
}

// The k-th of n values lies below the quantile of a share p if at least k of them do, and their number is binomial.
Ranks confidenceRanks(std::uint64_t values, std::uint32_t thousandths) {
  const double share = thousandths / 1000.0;
  const auto count = static_cast<unsigned>(values);
  const auto upTo = [&](unsigned below) { return gsl_cdf_binomial_P(below, share, count); };
  // Both by bisection: of P(at most k), which rises with k.
  unsigned low = 0, end = count;  // the most k with P(at most k - 1) <= tail
  while (low < end) {
    const unsigned middle = low + (end - low + 1) / 2;
    upTo(middle - 1) <= kTail ? low = middle : end = middle - 1;
  }
  unsigned high = 1;  // the least k with P(at most k - 1) >= 1 - tail
  end = count + 1;
  while (high < end) {
    const unsigned middle = high + (end - high) / 2;
    upTo(middle - 1) >= 1 - kTail ? end = middle : high = middle + 1;
  }
  return {low, high};
}

Interval Sample::confidence(std::uint32_t thousandths) const {
  const Ranks ranks = confidenceRanks(values_.size(), thousandths);
  Interval interval{ranks.low > 0 ? values_[ranks.low - 1] : 0, {}};
  if (ranks.high <= values_.size()) interval.high = values_[ranks.high - 1];
  return interval;
}

Interval confidenceOfShare(std::uint64_t some, std::uint64_t all) {
  const auto n = static_cast<double>(all);
  const double share = static_cast<double>(some) / n, square = kDeviations * kDeviations;
  const double middle = (share + square / (2 * n)) / (1 + square / n);
  const double half = kDeviations / (1 + square / n) * std::sqrt(share * (1 - share) / n + square / (4 * n * n));
  // At the ends both are equal but for rounding.
  return {some == 0 ? 0 : std::max(0.0, middle - half), some == all ? 1 : std::min(1.0, middle + half)};
}

}  // namespace cairn::rockfall

// SPDX-License-Identifier: GPL-3.0-or-later
#include "rockfall/validation/distributions.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace cairn::rockfall {
namespace {

/// Walks over the values of both in rising order: `use(from, to, difference)` of each stretch between two, on which the
/// difference of the shares does not change.
template <class Use>
void forEachStretch(const Distribution& a, const Distribution& b, const Use& use) {
  const std::vector<double>&x = a.values(), &y = b.values();
  std::size_t i = 0, j = 0;
  while (i < x.size() || j < y.size()) {
    const double at = i == x.size() ? y[j] : j == y.size() ? x[i] : std::min(x[i], y[j]);
    while (i < x.size() && x[i] <= at) ++i;
    while (j < y.size() && y[j] <= at) ++j;
    double next = at;
    if (i < x.size() || j < y.size()) next = i == x.size() ? y[j] : j == y.size() ? x[i] : std::min(x[i], y[j]);
    const double share = static_cast<double>(i) / static_cast<double>(x.size()),
                 other = static_cast<double>(j) / static_cast<double>(y.size());
    use(at, next, share - other);
  }
}

}  // namespace

Distribution::Distribution(std::vector<double> values) : values_(std::move(values)) {
  std::ranges::sort(values_);
}

double Distribution::quantile(double share) const {
  assert(!values_.empty() && share >= 0 && share <= 1);
  const double at = share * static_cast<double>(values_.size() - 1);
  const auto below = static_cast<std::size_t>(at);
  if (below + 1 >= values_.size()) return values_.back();
  return values_[below] + (values_[below + 1] - values_[below]) * (at - static_cast<double>(below));
}

double Distribution::shareUpTo(double value) const {
  if (values_.empty()) return 0;
  const auto count = std::upper_bound(values_.begin(), values_.end(), value) - values_.begin();
  return static_cast<double>(count) / static_cast<double>(values_.size());
}

double kolmogorovSmirnov(const Distribution& a, const Distribution& b) {
  assert(!a.empty() && !b.empty());
  double greatest = 0;
  forEachStretch(a, b, [&](double, double, double difference) { greatest = std::max(greatest, std::abs(difference)); });
  return greatest;
}

double kolmogorovSmirnovBound(std::size_t n, std::size_t m) {
  constexpr double kOneInTwenty = 1.358;
  return kOneInTwenty * std::sqrt(1.0 / static_cast<double>(n) + 1.0 / static_cast<double>(m));
}

double wasserstein(const Distribution& a, const Distribution& b) {
  assert(!a.empty() && !b.empty());
  double area = 0;
  forEachStretch(a, b, [&](double from, double to, double difference) { area += (to - from) * std::abs(difference); });
  return area;
}

}  // namespace cairn::rockfall

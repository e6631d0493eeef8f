// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace cairn::rockfall {

/// Numbers in rising order: a distribution that gives each the same share.
class Distribution {
 public:
  Distribution() = default;
  explicit Distribution(std::vector<double> values);

  std::size_t size() const { return values_.size(); }
  bool empty() const { return values_.empty(); }
  const std::vector<double>& values() const { return values_; }

  /// Linear between the values, the least at 0, the greatest at 1 (Hyndman and Fan's seventh, as R and NumPy have it).
  /// Precondition: not empty.
  double quantile(double share) const;
  double median() const { return quantile(0.5); }
  /// From the first to the third quartile.
  double middleHalf() const { return quantile(0.75) - quantile(0.25); }
  /// The share of values of at most `value`.
  double shareUpTo(double value) const;

 private:
  std::vector<double> values_;
};

/// The greatest difference of their shares up to any value (Kolmogorov and Smirnov): 0 to 1. Neither is empty.
double kolmogorovSmirnov(const Distribution& a, const Distribution& b);
/// What two samples of these sizes of one distribution exceed one time in twenty: 1.358 sqrt(1/n + 1/m).
double kolmogorovSmirnovBound(std::size_t n, std::size_t m);
/// The mean distance by which one's values must be moved to give the other: the area between their shares, in the
/// values' unit. Neither is empty.
double wasserstein(const Distribution& a, const Distribution& b);

}  // namespace cairn::rockfall

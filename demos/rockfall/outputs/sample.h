// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace cairn::rockfall {

/// Bounds that hold the true value 19 times in 20, were the whole ensemble repeated with other numbers.
struct Interval {
  double low = 0;
  std::optional<double> high;  ///< nothing: there are too few values to tell
};

/// Ranks, from 1, of the two values between which a quantile lies, 19 times in 20. No such value: 0, or one more than
/// there are values.
struct Ranks {
  std::uint64_t low = 0, high = 1;
};

/// Returns the ranks that the binomial distribution gives (Conover 1999, 3.2), whatever the values are distributed
/// like. It takes the values as independent of each other. Precondition: `count` is positive and below 2^32.
Ranks confidenceRanks(std::uint64_t count, std::uint32_t thousandths);

/// Measured values of one quantity, in rising order.
class Sample {
 public:
  explicit Sample(std::vector<double> values);

  std::size_t size() const { return values_.size(); }
  double mean() const;      ///< 0 without values
  double greatest() const;  ///< 0 without values
  /// Returns the nearest-rank quantile; 0 without values. 0 < `thousandths` <= 1000.
  double quantile(std::uint32_t thousandths) const;
  /// Returns the confidence interval of the quantile: the values with `confidenceRanks`. Precondition: not empty.
  Interval confidence(std::uint32_t thousandths) const;

 private:
  std::vector<double> values_;
};

/// Returns the confidence interval of a share, `some` of `all` (Wilson 1927). Precondition: `all` > 0.
Interval confidenceOfShare(std::uint64_t some, std::uint64_t all);

}  // namespace cairn::rockfall

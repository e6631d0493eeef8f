// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "rockfall/outputs/sample.h"

namespace cairn::rockfall {

/// Counts of values in fixed bins, sixteen for each factor of two. Sums of counts are exact in any order, whereas
/// quantiles of quantiles would not be. Values of zero and below share a bin. Memory: 16 bytes for each bin that holds
/// a value, so at most 16 times the binary logarithm of the greatest over the least, however many values there are.
class LogHistogram {
 public:
  /// Bins are 2^(1/16) wide.
  static constexpr double kBinRatio = 1.0442737824274138;

  void add(double value);
  std::uint64_t count() const { return count_; }
  std::size_t bins() const { return bins_.size(); }
  double greatest() const { return greatest_; }
  /// The mean of the values themselves, added up in their order; 0 without values.
  double mean() const { return count_ > 0 ? sum_ / static_cast<double>(count_) : 0; }
  /// Returns the nearest-rank quantile, at most one bin too high and never too low; 0 without values. Precondition: 0 <
  /// `thousandths` <= 1000.
  double quantile(std::uint32_t thousandths) const;
  /// Returns bounds of the quantile: the bins of the values with these ranks, each bin's outer edge. So the bounds are
  /// at most one bin wider than those of the values themselves, and never tighter.
  Interval bounds(const Ranks& ranks) const;

 private:
  struct Bin {
    std::int32_t number;
    std::uint64_t count;
  };
  const Bin* binOfRank(std::uint64_t rank) const;

  std::vector<Bin> bins_;  // in rising order
  std::uint64_t count_ = 0;
  double greatest_ = 0, sum_ = 0;
};

}  // namespace cairn::rockfall

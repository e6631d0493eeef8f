// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <map>

namespace cairn::rockfall {

/// Counts of values in fixed bins, sixteen for each factor of two. Sums are exact in any order, whereas quantiles of
/// quantiles would not be. Values of zero and below share a bin.
class LogHistogram {
 public:
  /// Bins are 2^(1/16) wide.
  static constexpr double kBinRatio = 1.0442737824274138;

  void add(double value);
  std::uint64_t count() const { return count_; }
  double greatest() const { return greatest_; }
  /// Returns the nearest-rank quantile, at most one bin too high and never too low; 0 without values. Precondition: 0 <
  /// `thousandths` <= 1000.
  double quantile(std::uint32_t thousandths) const;

 private:
  std::map<std::int32_t, std::uint64_t> bins_;
  std::uint64_t count_ = 0;
  double greatest_ = 0;
};

}  // namespace cairn::rockfall

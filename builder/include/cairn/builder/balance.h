// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>

#include "cairn/core/result.h"

namespace cairn::builder {

/// The rule that drops children of a node: how much the worst error of the rest may grow (thesis 6.3, Eq. 6.2).
///
///     BuildOptions options{.balance = kBalanceByWork}; // or constantExcess(0.05), or parseBalance("work").value()
struct Balance {
  double workShare = 0;  ///< 1/A: growth allowed for the share of the work that is saved; at least 0
  double decay = 1;      ///< v: makes each further drop harder; 0 to 1
  double excess = 0;     ///< B: growth that is always allowed; 0 to 1

  friend bool operator==(const Balance&, const Balance&) = default;
};

/// The thesis's two sets of parameters (footnote of 6.3). `constantExcess` allows a constant growth (A infinite, v =
/// 1). `kBalanceByWork` allows a growth that saved work must earn (A = 5, v = 0.75, B = 0). It allows 2.5 % for the
/// first child dropped of eight, 3.75 % for two, then 4.2 %.
inline constexpr Balance constantExcess(double excess) {
  return {.excess = excess};
}
/// A growth that saved work must earn; see `constantExcess`.
inline constexpr Balance kBalanceByWork{.workShare = 0.2, .decay = 0.75};

/// Returns the factor (at least 1) by which the worst error may grow when `kept` of `full` children stay: Eq. 6.2.
/// Precondition: 1 <= kept < full.
double allowedGrowth(const Balance& balance, std::size_t full, std::size_t kept);

/// Reads a balance: a number from 0 to 1 is a constant excess, "work" is `kBalanceByWork`. Fails for any other text.
Result<Balance> parseBalance(const std::string& text);
/// Returns a text that `parseBalance` reads back as the same balance. Precondition: `balance` is one of the two
/// published kinds.
std::string balanceName(const Balance& balance);

}  // namespace cairn::builder

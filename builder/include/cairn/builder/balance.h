// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>

#include "cairn/core/result.h"

namespace cairn::builder {

/// How much the worst error of a node's children may grow when some of them are dropped (thesis 6.3, Eq. 6.2).
struct Balance {
  double workShare = 0;  ///< 1/A: growth allowed for the share of the work that is saved, at least 0
  double decay = 1;      ///< v: makes each further drop harder, 0 to 1
  double excess = 0;     ///< B: growth allowed whatever is saved, 0 to 1

  friend bool operator==(const Balance&, const Balance&) = default;
};

/// The thesis's two sets of parameters (footnote of 6.3): a constant excess (A infinite, v = 1), and a growth that has
/// to be earned by work saved (A = 5, v = 0.75, B = 0): 2.5 % for the first of eight, 3.75 % for two, then 4.2 %.
inline constexpr Balance constantExcess(double excess) {
  return {.excess = excess};
}
/// Growth that has to be earned by work saved.
inline constexpr Balance kBalanceByWork{.workShare = 0.2, .decay = 0.75};

/// Factor on the worst error of `full` children that `kept` of them may reach: Eq. 6.2. Precondition: 1 <= kept < full.
double allowedGrowth(const Balance& balance, std::size_t full, std::size_t kept);

/// A number from 0 to 1 is a constant excess, "work" is `kBalanceByWork`. Fails for anything else.
Result<Balance> parseBalance(const std::string& text);
/// What `parseBalance` reads as the same, for the two published kinds.
std::string balanceName(const Balance& balance);

}  // namespace cairn::builder

// SPDX-License-Identifier: GPL-3.0-or-later
#include "cairn/builder/balance.h"

#include <fmt/format.h>

#include <cassert>
#include <charconv>
#include <cmath>

namespace cairn::builder {

namespace {

constexpr const char* kByWork = "work";

}  // namespace

double allowedGrowth(const Balance& balance, std::size_t full, std::size_t kept) {
  assert(kept >= 1 && kept < full);
  const auto dropped = static_cast<double>(full - kept);
  return 1 + dropped * balance.workShare / static_cast<double>(full) * std::pow(balance.decay, dropped - 1) +
         balance.excess;
}

Result<Balance> parseBalance(const std::string& text) {
  if (text == kByWork) return kBalanceByWork;
  double excess = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, failure] = std::from_chars(text.data(), end, excess);
  if (failure != std::errc{} || stop != end || !(excess >= 0 && excess <= 1))
    return Error{"the option balance is '" + text + "'; choose a number from 0 to 1, as 0.05 for 5 %, or " + kByWork};
  return constantExcess(excess);
}

std::string balanceName(const Balance& balance) {
  return balance == kBalanceByWork ? kByWork : fmt::format("{}", balance.excess);
}

}  // namespace cairn::builder

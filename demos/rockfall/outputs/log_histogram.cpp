// SPDX-License-Identifier: GPL-3.0-or-later
#include "rockfall/outputs/log_histogram.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace cairn::rockfall {
namespace {

/// 2^(i/16) as literals, so that no mathematical library decides where a bin ends.
constexpr std::array kEdges{1.0,
                            1.0442737824274138,
                            1.0905077326652577,
                            1.1387886347566916,
                            1.189207115002721,
                            1.241857812073484,
                            1.2968395546510096,
                            1.3542555469368927,
                            1.4142135623730951,
                            1.4768261459394993,
                            1.5422108254079407,
                            1.6104903319492543,
                            1.681792830507429,
                            1.7562521603732995,
                            1.8340080864093424,
                            1.9152065613971474,
                            2.0};
constexpr std::int32_t kBinsAnOctave = kEdges.size() - 1;
constexpr std::int32_t kZeroBin = std::numeric_limits<std::int32_t>::min();

std::int32_t binOf(double value) {
  if (!(value > 0)) return kZeroBin;
  int exponent = 0;
  const double mantissa = 2 * std::frexp(value, &exponent);  // in [1, 2)
  const auto above = std::ranges::upper_bound(kEdges, mantissa);
  return exponent * kBinsAnOctave + static_cast<std::int32_t>(above - kEdges.begin()) - 1;
}

double upperEdge(std::int32_t bin) {
  if (bin == kZeroBin) return 0;
  const std::int32_t step = ((bin % kBinsAnOctave) + kBinsAnOctave) % kBinsAnOctave;
  return std::ldexp(kEdges[static_cast<std::size_t>(step) + 1], (bin - step) / kBinsAnOctave - 1);
}

}  // namespace

void LogHistogram::add(double value) {
  ++bins_[binOf(value)];
  greatest_ = count_ == 0 ? value : std::max(greatest_, value);
  ++count_;
}

double LogHistogram::quantile(std::uint32_t thousandths) const {
  const std::uint64_t rank = std::max<std::uint64_t>(1, (count_ * thousandths + 999) / 1000);
  std::uint64_t below = 0;
  for (const auto& [bin, count] : bins_)
    if ((below += count) >= rank) return std::min(upperEdge(bin), greatest_);
  return 0;
}

}  // namespace cairn::rockfall

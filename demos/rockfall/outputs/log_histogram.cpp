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

double lowerEdge(std::int32_t bin) {
  return bin == kZeroBin ? 0 : upperEdge(bin - 1);
}

}  // namespace

void LogHistogram::add(double value) {
  const std::int32_t number = binOf(value);
  const auto place = std::ranges::lower_bound(bins_, number, {}, &Bin::number);
  if (place != bins_.end() && place->number == number)
    ++place->count;
  else
    bins_.insert(place, {number, 1});
  greatest_ = count_ == 0 ? value : std::max(greatest_, value);
  sum_ += value;
  ++count_;
}

const LogHistogram::Bin* LogHistogram::binOfRank(std::uint64_t rank) const {
  std::uint64_t below = 0;
  for (const Bin& bin : bins_)
    if ((below += bin.count) >= rank) return &bin;
  return nullptr;
}

double LogHistogram::quantile(std::uint32_t thousandths) const {
  const Bin* bin = binOfRank(std::max<std::uint64_t>(1, (count_ * thousandths + 999) / 1000));
  return bin != nullptr ? std::min(upperEdge(bin->number), greatest_) : 0;
}

Interval LogHistogram::bounds(const Ranks& ranks) const {
  Interval interval;
  if (const Bin* bin = ranks.low > 0 ? binOfRank(ranks.low) : nullptr) interval.low = lowerEdge(bin->number);
  if (const Bin* bin = binOfRank(ranks.high)) interval.high = std::min(upperEdge(bin->number), greatest_);
  return interval;
}

}  // namespace cairn::rockfall

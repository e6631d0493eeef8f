// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstdint>

namespace cairn::scenes {

/// Mean, maximum and count of a quantity.
struct Spread {
  double mean = 0;
  double max = 0;
  std::uint32_t pairs = 0;
};

/// Collects lengths and reports them as fractions of body size.
class SpreadOfLengths {
 public:
  void add(double length) {
    sum_ += length;
    max_ = std::max(max_, length);
    ++count_;
  }
  Spread over(double size) const { return {count_ ? sum_ / count_ / size : 0, max_ / size, count_}; }

 private:
  double sum_ = 0, max_ = 0;
  std::uint32_t count_ = 0;
};

}  // namespace cairn::scenes

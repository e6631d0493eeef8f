// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenes/figures/quantiles.h"

#include <algorithm>
#include <cstddef>

namespace cairn::scenes {

Quantiles quantilesOf(std::vector<double> sample) {
  if (sample.empty()) return {};
  std::ranges::sort(sample);
  // In thousandths, so that the rank is an integer computation.
  const auto at = [&](std::size_t thousandths) {
    const std::size_t rank = (sample.size() * thousandths + 999) / 1000;
    return sample[std::max<std::size_t>(rank, 1) - 1];
  };
  return {at(500), at(990), at(999), sample.back()};
}

}  // namespace cairn::scenes

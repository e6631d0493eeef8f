// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenes/figures/quantiles.h"

#include <algorithm>
#include <cstddef>

namespace cairn::scenes {

Quantiles quantilesOf(std::vector<double> sample) {
  if (sample.empty()) return {};
  std::ranges::sort(sample);
  // The share in ten-thousandths, so that the rank is an integer computation.
  const auto at = [&](std::size_t tenThousandths) {
    const std::size_t rank = (sample.size() * tenThousandths + 9999) / 10000;
    return sample[std::max<std::size_t>(rank, 1) - 1];
  };
  return {at(5000), at(9900), at(9990), at(9999), sample.back()};
}

}  // namespace cairn::scenes

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>

namespace cairn::builder {

template <std::size_t N>
struct SimplexOptimum {
  std::array<double, N> at{};
  double value = 0;
};

/// Lowers `value(x)` from `start` by the downhill simplex method (Nelder and Mead 1965, with their coefficients 1, 2,
/// 1/2, 1/2). It is for functions too rough for gradients. `steps` are the edges of the first simplex. Stops after
/// about `maxEvaluations`; never worse than `start`. Ties keep the older corner, so the result is a function of the
/// input.
template <std::size_t N, class Function>
SimplexOptimum<N> downhillSimplex(const std::array<double, N>& start, const std::array<double, N>& steps,
                                  std::size_t maxEvaluations, const Function& value) {
  using Corner = SimplexOptimum<N>;
  std::array<Corner, N + 1> corners;
  corners.fill({start, 0});
  for (std::size_t i = 0; i <= N; ++i) {
    if (i > 0) corners[i].at[i - 1] += steps[i - 1];
    corners[i].value = value(corners[i].at);
  }
  std::size_t evaluations = N + 1;
  const auto lower = [](const Corner& a, const Corner& b) { return a.value < b.value; };
  /// The point at `t` on the line from the middle of all corners but the last (t = 0) through the last one (t = 1).
  const auto along = [&](double t) {
    Corner c;
    for (std::size_t k = 0; k < N; ++k) {
      double middle = 0;
      for (std::size_t i = 0; i < N; ++i) middle += corners[i].at[k] / static_cast<double>(N);
      c.at[k] = middle + t * (corners[N].at[k] - middle);
    }
    c.value = value(c.at);
    ++evaluations;
    return c;
  };
  while (evaluations < maxEvaluations) {
    std::stable_sort(corners.begin(), corners.end(), lower);
    Corner moved = along(-1);
    if (moved.value < corners[0].value) {
      const Corner farther = along(-2);
      if (farther.value < moved.value) moved = farther;
    } else if (!(moved.value < corners[N - 1].value)) {
      moved = along(moved.value < corners[N].value ? -0.5 : 0.5);
    }
    if (moved.value < corners[N].value) {
      corners[N] = moved;
      continue;
    }
    for (std::size_t i = 1; i <= N; ++i) {
      for (std::size_t k = 0; k < N; ++k) corners[i].at[k] = 0.5 * (corners[i].at[k] + corners[0].at[k]);
      corners[i].value = value(corners[i].at);
    }
    evaluations += N;
  }
  return *std::min_element(corners.begin(), corners.end(), lower);
}

}  // namespace cairn::builder

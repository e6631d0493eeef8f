// SPDX-License-Identifier: GPL-3.0-or-later
#include "accuracy_cost/experiments/statistics.h"

#include <fmt/format.h>
#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>

namespace cairn::accuracy_cost {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// Sum of squares between the means of the groups, and of the values around their group's mean.
struct Squares {
  double between = 0, within = 0;
};

Squares squaresOf(const std::vector<std::vector<double>>& groups, double overall) {
  Squares squares;
  for (const auto& group : groups) {
    const double own = mean(group);
    squares.between += static_cast<double>(group.size()) * (own - overall) * (own - overall);
    for (const double value : group) squares.within += (value - own) * (value - own);
  }
  return squares;
}

}  // namespace

Anova anovaOf(const std::vector<std::vector<double>>& groups) {
  std::size_t count = 0;
  double sum = 0;
  for (const auto& group : groups) {
    assert(!group.empty());
    count += group.size();
    sum = std::accumulate(group.begin(), group.end(), sum);
  }
  assert(groups.size() >= 2 && count > groups.size());
  Anova anova{.between = groups.size() - 1, .within = count - groups.size()};
  const auto between = static_cast<double>(anova.between), within = static_cast<double>(anova.within);
  const Squares squares = squaresOf(groups, sum / static_cast<double>(count));
  anova.fCritical = gsl_cdf_fdist_Qinv(kSignificance, between, within);
  if (squares.between == 0) return anova;
  if (squares.within == 0) {
    anova.f = std::numeric_limits<double>::infinity();
    anova.p = 0;
    return anova;
  }
  anova.f = (squares.between / between) / (squares.within / within);
  anova.p = gsl_cdf_fdist_Q(anova.f, between, within);
  return anova;
}

MedianInterval medianOf(std::vector<double> values) {
  assert(!values.empty());
  std::ranges::sort(values);
  const std::size_t count = values.size(), half = count / 2;
  // Returns the probability that the median lies below the k-th least value: at most k of the values do.
  std::size_t outside = 0;
  double chance = std::pow(0.5, static_cast<double>(count)), binomial = chance;
  while (outside < half) {
    binomial *= static_cast<double>(count - outside) / static_cast<double>(outside + 1);
    if (2 * (chance + binomial) > 1 - kConfidence) break;
    chance += binomial;
    ++outside;
  }
  const double median = count % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
  return {median, values[outside], values[count - 1 - outside]};
}

double geometricMean(std::span<const double> values) {
  double sum = 0;
  for (const double value : values) sum += std::log(value);
  return values.empty() ? kNaN : std::exp(sum / static_cast<double>(values.size()));
}

double mean(std::span<const double> values) {
  if (values.empty()) return kNaN;
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

SignTest signTestOf(std::span<const double> first, std::span<const double> second) {
  assert(first.size() == second.size());
  SignTest test;
  for (std::size_t i = 0; i < first.size(); ++i)
    ++(first[i] < second[i] ? test.lower : first[i] > second[i] ? test.higher : test.same);
  const auto count = static_cast<unsigned>(test.lower + test.higher);
  const auto fewer = static_cast<unsigned>(std::min(test.lower, test.higher));
  if (count > 0) test.p = std::min(1.0, 2 * gsl_cdf_binomial_P(fewer, 0.5, count));
  return test;
}

double powerOf(std::span<const double> x, std::span<const double> y) {
  assert(x.size() == y.size());
  if (x.size() < 3) return kNaN;
  const double meanX = std::log(geometricMean(x)), meanY = std::log(geometricMean(y));
  double xx = 0, xy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    xx += (std::log(x[i]) - meanX) * (std::log(x[i]) - meanX);
    xy += (std::log(x[i]) - meanX) * (std::log(y[i]) - meanY);
  }
  return xx > 0 ? xy / xx : kNaN;
}

std::string ratioText(double value, double limit) {
  int digits = 2;
  const auto text = [&] { return fmt::format("{:.{}f}", value, digits); };
  while (digits < 9 && std::isfinite(value) && value != limit && std::stod(text()) == limit) ++digits;
  return text();
}

double linearity(std::span<const double> x, std::span<const double> y) {
  assert(x.size() == y.size());
  if (x.size() < 3) return kNaN;
  const double meanX = mean(x), meanY = mean(y);
  double xx = 0, yy = 0, xy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    xx += (x[i] - meanX) * (x[i] - meanX);
    yy += (y[i] - meanY) * (y[i] - meanY);
    xy += (x[i] - meanX) * (y[i] - meanY);
  }
  return xx > 0 && yy > 0 ? xy * xy / (xx * yy) : kNaN;
}

}  // namespace cairn::accuracy_cost

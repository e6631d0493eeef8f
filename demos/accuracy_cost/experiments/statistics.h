// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string>
#include <vector>

namespace cairn::accuracy_cost {

/// One-way analysis of variance: tests whether all groups have the same mean.
struct Anova {
  double f = 0;                         ///< variance between the groups divided by the variance within them
  double p = 1;                         ///< probability of an F at least as large when all means are equal
  double fCritical = 0;                 ///< the F with the probability `kSignificance`
  std::size_t between = 0, within = 0;  ///< degrees of freedom
};
inline constexpr double kSignificance = 0.05;

/// Analyses the groups. Different groups without any variation inside them have an infinite F and p = 0. Without any
/// variation at all, F = 0 and p = 1. The F distribution is that of the GNU Scientific Library. Precondition: at least
/// two groups, none empty, more values than groups.
Anova anovaOf(const std::vector<std::vector<double>>& groups);

/// A median and its confidence interval.
struct MedianInterval {
  double median = 0, low = 0, high = 0;
};
inline constexpr double kConfidence = 0.95;
/// The least number of values that gives an interval of `kConfidence`.
inline constexpr std::size_t kMinRepetitions = 6;

/// Returns the median of the values and its interval: the narrowest symmetric pair of order statistics that holds the
/// true median with at least `kConfidence`. The bound is binomial and valid for any distribution. With too few values
/// the interval ends at the least and greatest. Precondition: `values` is not empty.
MedianInterval medianOf(std::vector<double> values);

/// Formats a number with two digits after the point. More digits are used where `value` would otherwise look equal to a
/// different `limit`.
std::string ratioText(double value, double limit);

/// The sign test: whether pairs of values differ. Without ties, the first value should be lower as often as higher.
struct SignTest {
  std::size_t lower = 0, same = 0, higher = 0;  ///< counts of pairs by their first value
  double p = 1;  ///< probability of counts at least as far apart, in either direction, if both were equally likely
};
/// Precondition: equal sizes.
SignTest signTestOf(std::span<const double> first, std::span<const double> second);

/// Returns the slope of the straight line through the logarithms: y grows as x to this power. NaN for fewer than three
/// points and where x does not vary. Precondition: equal sizes, all values above 0.
double powerOf(std::span<const double> x, std::span<const double> y);

/// Returns exp of the mean logarithm; NaN without values. Precondition: all values are above 0.
double geometricMean(std::span<const double> values);
/// NaN without values.
double mean(std::span<const double> values);
/// Returns the share of the variance of y that a straight line over x explains, 0 to 1 (Pearson's r squared). NaN for
/// fewer than three points and when x or y does not vary. Precondition: equal sizes.
double linearity(std::span<const double> x, std::span<const double> y);

}  // namespace cairn::accuracy_cost

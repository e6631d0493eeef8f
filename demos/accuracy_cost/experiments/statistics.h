// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string>
#include <vector>

namespace cairn::accuracy_cost {

/// One-way analysis of variance: is the mean of all groups the same?
struct Anova {
  double f = 0;                         ///< variance between the groups over that within them
  double p = 1;                         ///< chance of an F as large when all means are the same
  double fCritical = 0;                 ///< the F whose chance is `kSignificance`
  std::size_t between = 0, within = 0;  ///< degrees of freedom
};
inline constexpr double kSignificance = 0.05;

/// Groups that differ while nothing varies inside them have an infinite F and p = 0; when nothing varies at all F = 0
/// and p = 1. The F distribution is that of the GNU Scientific Library. Precondition: at least two groups, none empty,
/// more values than groups.
Anova anovaOf(const std::vector<std::vector<double>>& groups);

/// A median and what it is certain to lie between.
struct MedianInterval {
  double median = 0, low = 0, high = 0;
};
inline constexpr double kConfidence = 0.95;
/// As few values as give an interval of `kConfidence`.
inline constexpr std::size_t kMinRepetitions = 6;

/// The median of the values, and the narrowest pair of order statistics, equally far from both ends, that holds the
/// median they are drawn from with at least `kConfidence` (binomial, whatever the distribution; least and greatest
/// where there are too few). Precondition: not empty.
MedianInterval medianOf(std::vector<double> values);

/// A number with two digits after the point, or as many more as it takes to be told from `limit` where it is another.
std::string ratioText(double value, double limit);

/// Do pairs of values differ? By the sign test: ties apart, are the first as often lower as higher?
struct SignTest {
  std::size_t lower = 0, same = 0, higher = 0;  ///< pairs whose first is
  double p = 1;                                 ///< chance of counts as far apart, either way, if neither were likelier
};
/// Precondition: equal sizes.
SignTest signTestOf(std::span<const double> first, std::span<const double> second);

/// Slope of the straight line through the logarithms (y as x to this power). NaN for fewer than three points and where
/// x does not vary. Precondition: equal sizes, all above 0.
double powerOf(std::span<const double> x, std::span<const double> y);

/// exp of the mean logarithm; NaN without values. Precondition: all above 0.
double geometricMean(std::span<const double> values);
/// NaN without values.
double mean(std::span<const double> values);
/// Share of the variance of y that a straight line over x explains, 0 to 1 (Pearson's r squared). NaN for fewer than
/// three points or when x or y do not vary. Precondition: equal sizes.
double linearity(std::span<const double> x, std::span<const double> y);

}  // namespace cairn::accuracy_cost

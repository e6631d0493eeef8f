// SPDX-License-Identifier: GPL-3.0-or-later
#include "known_misses.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "verdict.h"

namespace cairn::hard {
namespace {

constexpr double kHolds = std::numeric_limits<double>::quiet_NaN();

/// A measure that misses its limit, and how bad it may become before that is news: about a third beyond the measured
/// value, as every rounding changes a world's course. `kHolds` where it does not miss. For at-least measures this is
/// the least value, for others the most.
struct KnownMiss {
  const char* id;
  const char* measure;
  double quick, whole;
};

constexpr KnownMiss kKnown[] = {
    // A rock's creeping is chance: single ones differ twentyfold. Quick runs are of three, L1's of five, and go both
    // ways.
    {"D1", "place, RMS about its mean", 0.033, 0.48},
    {"D1", "drift", 0.112, 1.67},
    {"D1", "drift, upper tenth", 0.17, 6.5},
    {"D1", "place, RMS about its mean, friction along a fixed direction", 0.0092, kHolds},
    {"D1", "drift, friction along a fixed direction", 0.032, kHolds},
    {"D1", "drift, upper tenth, friction along a fixed direction", kHolds, 0.82},
    {"D1", "place, RMS about its mean, friction in two directions", 0.0058, 0.062},
    {"D1", "drift, friction in two directions", 0.02, 0.214},
    {"D1", "drift, upper tenth, friction in two directions", 0.067, 0.83},
    {"D3", "a card house of 7 cards stands, mean", kHolds, 5.4},
    {"D4", "1 : 1000, greatest speed", 3, 3},
    {"D10", "roll, aside of the way on the plane", 6.8, 11.3},
    {"D11", "deepest penetration", 19.9, 34.6},
    {"D13", "a centimetre at rest, RMS", kHolds, 1.64},
    {"D16", "rocks: steps in which the deepest pair had no contact", kHolds, 6.7},
    {"D16", "rocks: deepest it was without one", kHolds, 9.1},
    {"D16", "rocks: deepest once they lie", 6, 9.8},
    {"D16", "three slabs: energy gained after any loss", kHolds, 6.5},
    {"D16", "three slabs: deepest once they lie", kHolds, 5.4},
    {"D16", "mean error, rise with the budget, first step", 0.74, 0.091},
    {"D16", "worst error, rise with the budget, first step", 3.8, 0.3},
    {"D16", "worst error, rise with the budget, tenth step", kHolds, 0.07},
    {"L1", "drift, median", 1.23, kHolds},
    {"L1", "drift, median, friction in two directions", 0.22, kHolds},
    {"L1", "energy gained after any loss, most, friction in two directions", kHolds, 2.1},
};

double worstKnown(const KnownMiss& miss, Effort effort) {
  return effort == Effort::quick ? miss.quick : miss.whole;
}

}  // namespace

std::vector<std::string> knownMisses(const std::string& id, Effort effort) {
  std::vector<std::string> measures;
  for (const KnownMiss& each : kKnown)
    if (each.id == id && !std::isnan(worstKnown(each, effort))) measures.emplace_back(each.measure);
  return measures;
}

bool isNews(const std::string& id, const Measure& measure, Effort effort) {
  if (verdictOn(measure) != Verdict::misses) return false;
  const auto known = std::ranges::find_if(
      kKnown, [&](const KnownMiss& each) { return each.id == id && each.measure == measure.name; });
  if (known == std::end(kKnown)) return true;
  const double worst = worstKnown(*known, effort);  // not a number where it held so far: any miss is news
  return !(measure.bound == Bound::atMost ? measure.value <= worst : measure.value >= worst);
}

}  // namespace cairn::hard

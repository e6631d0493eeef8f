// SPDX-License-Identifier: GPL-3.0-or-later
#include "verdict.h"

#include <algorithm>
#include <cmath>

namespace cairn::hard {
namespace {

bool within(double value, double limit, Bound bound) {
  // Not a number fails both.
  return bound == Bound::atMost ? value <= limit : value >= limit;
}

}  // namespace

Verdict verdictOn(const Measure& measure) {
  if (within(measure.value, measure.limit, measure.bound)) return Verdict::holds;
  const bool stockAsked = !measure.stock.empty() && std::isfinite(measure.value);
  return stockAsked && within(measure.value, measure.stockValue, measure.bound) ? Verdict::asGoodAsStock
                                                                                : Verdict::misses;
}

bool holdsBehindStock(const Measure& measure) {
  return verdictOn(measure) == Verdict::holds && !measure.stock.empty() &&
         !within(measure.value, measure.stockValue, measure.bound);
}

Verdict verdictOn(const Outcome& outcome) {
  if (outcome.measures.empty()) return Verdict::misses;
  Verdict worst = Verdict::holds;
  for (const Measure& measure : outcome.measures) worst = std::max(worst, verdictOn(measure));
  return worst;
}

std::string nameOf(Verdict verdict) {
  switch (verdict) {
    case Verdict::holds:
      return "holds";
    case Verdict::asGoodAsStock:
      return "as good as stock";
    case Verdict::misses:
      return "misses";
  }
  return "misses";
}

}  // namespace cairn::hard

// SPDX-License-Identifier: GPL-3.0-or-later
#include "compare.h"

#include <algorithm>
#include <cmath>

namespace cairn::hard {
namespace {

bool isBetter(double x, double y, Bound bound) {
  return bound == Bound::atMost ? x < y : x > y;
}

}  // namespace

std::vector<Measure> besideTheBest(const std::vector<Asked>& asked, const Figures& ours,
                                   const std::vector<StockRun>& stock) {
  std::vector<Measure> measures;
  for (std::size_t i = 0; i < asked.size(); ++i) {
    Measure measure{asked[i].name, ours[i], asked[i].limit, asked[i].bound, asked[i].unit, "", 0};
    for (const StockRun& run : stock) {
      const double value = run.figures[i];
      if (!std::isfinite(value)) continue;
      if (!measure.stock.empty() && !isBetter(value, measure.stockValue, measure.bound)) continue;
      measure.stock = run.name;
      measure.stockValue = value;
    }
    measures.push_back(measure);
  }
  return measures;
}

std::vector<Measure> compare(const std::vector<Asked>& asked, const CaseBodies& bodies,
                             const std::function<Figures(const CaseBody&)>& run) {
  const Figures ours = run(bodies.front());
  std::vector<StockRun> stock;
  for (std::size_t i = 1; i < bodies.size(); ++i) stock.push_back({bodies[i].name, run(bodies[i])});
  return besideTheBest(asked, ours, stock);
}

std::vector<Measure> compareSeeds(const std::vector<Asked>& asked, int count,
                                  const std::function<const CaseBodies&(std::uint64_t seed)>& bodies,
                                  const std::function<Figures(const CaseBody&, std::uint64_t seed)>& run) {
  std::vector<StockRun> kinds;
  for (std::size_t i = 0; i < bodies(1).size(); ++i) {
    std::vector<Figures> runs;
    for (std::uint64_t seed = 1; seed <= std::uint64_t(count); ++seed) runs.push_back(run(bodies(seed)[i], seed));
    kinds.push_back({bodies(1)[i].name, joined(asked, runs)});
  }
  const Figures ours = kinds.front().figures;
  kinds.erase(kinds.begin());
  return besideTheBest(asked, ours, kinds);
}

Figures joined(const std::vector<Asked>& asked, const std::vector<Figures>& runs) {
  Figures figures;
  for (std::size_t i = 0; i < asked.size(); ++i) {
    std::vector<double> values;
    for (const Figures& run : runs) values.push_back(run.at(i));
    figures.push_back(quantileOf(values, asked[i].quantile, asked[i].bound));
  }
  return figures;
}

Figures worstOf(const std::vector<Asked>& asked, const std::vector<Figures>& runs) {
  Figures worst = runs.front();
  for (const Figures& run : runs)
    for (std::size_t i = 0; i < asked.size(); ++i)
      if (!std::isfinite(run[i]) || (std::isfinite(worst[i]) && isBetter(worst[i], run[i], asked[i].bound)))
        worst[i] = run[i];
  return worst;
}

double quantileOf(std::vector<double> values, double quantile, Bound bound) {
  if (values.empty() || !std::ranges::all_of(values, [](double value) { return std::isfinite(value); })) return NAN;
  std::ranges::sort(values, [&](double x, double y) { return isBetter(x, y, bound); });
  const auto rank = static_cast<std::size_t>(quantile * double(values.size()));
  return values[std::min(rank, values.size() - 1)];
}

}  // namespace cairn::hard

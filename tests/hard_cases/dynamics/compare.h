// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "../table/hard_case.h"
#include "bodies.h"

namespace cairn::hard {

/// The demand of a case on one figure.
struct Asked {
  std::string name;
  double limit = 0;
  Bound bound = Bound::atMost;
  std::string unit;
  double quantile = 0.5;  ///< of several seeds, towards the worse: 0.5 the median, 0.9 the upper tenth, 1 the worst
};

/// The figures of one body's run, in the order they were asked for.
using Figures = std::vector<double>;

/// Something of Bullet's, and its figures on the same case.
struct StockRun {
  std::string name;
  Figures figures;
};

/// Our figures beside, for each, the best of Bullet's shapes; NaN is nobody's best.
std::vector<Measure> besideTheBest(const std::vector<Asked>& asked, const Figures& ours,
                                   const std::vector<StockRun>& stock);

/// Every body through the same run.
std::vector<Measure> compare(const std::vector<Asked>& asked, const CaseBodies& bodies,
                             const std::function<Figures(const CaseBody&)>& run);

/// The same over the seeds from 1 to `count`, which may make other bodies of the same kinds: of each figure the
/// quantile that is asked for.
std::vector<Measure> compareSeeds(const std::vector<Asked>& asked, int count,
                                  const std::function<const CaseBodies&(std::uint64_t seed)>& bodies,
                                  const std::function<Figures(const CaseBody&, std::uint64_t seed)>& run);

/// Of several runs, figure by figure, the quantile that is asked for.
Figures joined(const std::vector<Asked>& asked, const std::vector<Figures>& runs);

/// The worst of several runs, figure by figure; NaN is worst.
Figures worstOf(const std::vector<Asked>& asked, const std::vector<Figures>& runs);

/// The value that this part of them is no worse than (of an even number the median is the worse of the middle two);
/// NaN if any is NaN or infinite.
double quantileOf(std::vector<double> values, double quantile, Bound bound);

}  // namespace cairn::hard

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "../table/hard_case.h"
#include "bodies.h"

namespace cairn::hard {

/// What a case asks of one figure.
struct Asked {
  std::string name;
  double limit = 0;
  Bound bound = Bound::atMost;
  std::string unit;
};

/// The figures of one body's run, in the order they were asked for.
using Figures = std::vector<double>;

/// Something of Bullet's, and its figures on the same case.
struct StockRun {
  std::string name;
  Figures figures;
};

/// Our figures beside, for each, the best of Bullet's shapes; what is no number is nobody's best.
std::vector<Measure> besideTheBest(const std::vector<Asked>& asked, const Figures& ours,
                                   const std::vector<StockRun>& stock);

/// Every body through the same run.
std::vector<Measure> compare(const std::vector<Asked>& asked, const CaseBodies& bodies,
                             const std::function<Figures(const CaseBody&)>& run);

/// The same over the seeds from 1 to `count`, which may make other bodies of the same kinds: medians of each figure.
std::vector<Measure> compareSeeds(const std::vector<Asked>& asked, int count,
                                  const std::function<const CaseBodies&(std::uint64_t seed)>& bodies,
                                  const std::function<Figures(const CaseBody&, std::uint64_t seed)>& run);

/// The worst of several runs, figure by figure; what is no number is worst.
Figures worstOf(const std::vector<Asked>& asked, const std::vector<Figures>& runs);

/// The median of several runs, figure by figure (of an even number, the upper); no number if any is none.
Figures medianOf(const std::vector<Figures>& runs);

}  // namespace cairn::hard

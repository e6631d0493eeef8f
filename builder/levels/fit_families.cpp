// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit_families.h"

#include <tbb/parallel_for.h>

#include "balls/ball_fit.h"
#include "cover/optimise.h"

namespace cairn::builder {

namespace {

SphereSet fitFamily(const std::vector<std::uint32_t>& owned, const PointSet& points, const DepthField& field,
                    const FamilySettings& settings) {
  std::vector<Vec3d> list;
  for (const std::uint32_t p : owned) list.push_back(points[p]);
  const PointSet few(farthestPointSample(list, settings.points, settings.seed % list.size()));
  const CoverProblem problem{few, field, settings.branching};
  const SphereSet one{fitBall(few[0], few, field)};
  if (one[0].standOff() <= settings.negligible) return one;
  return optimiseBySwaps(problem, one, settings.swapRounds);
}

}  // namespace

std::vector<ChildBall> fitFamilies(const Reach& owned, const PointSet& points, const DepthField& field,
                                   const FamilySettings& settings) {
  std::vector<SphereSet> families(owned.size());
  tbb::parallel_for(std::size_t{0}, owned.size(), [&](std::size_t i) {
    const bool goesOn = settings.keepGoing == nullptr || (*settings.keepGoing)();
    if (!owned[i].empty() && goesOn) families[i] = fitFamily(owned[i], points, field, settings);
  });
  std::vector<ChildBall> level;
  for (std::uint32_t parent = 0; parent < families.size(); ++parent)
    for (const Ball& ball : families[parent]) level.push_back({ball, parent});
  return level;
}

}  // namespace cairn::builder

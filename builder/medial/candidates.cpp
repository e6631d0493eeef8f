// SPDX-License-Identifier: GPL-3.0-or-later
#include "candidates.h"

#include "balls/ball_fit.h"

namespace cairn::builder {

Candidates candidatesFrom(const MedialSpheres& medial, const CoverProblem& problem) {
  Candidates c{medial.inside, medial.inside};
  c.covering.insert(c.covering.end(), medial.coverage.begin(), medial.coverage.end());
  c.all.insert(c.all.end(), medial.outside.begin(), medial.outside.end());
  if (c.covering.empty()) c.covering.push_back(fitBall(problem.points[0], problem.points, problem.solid));
  if (c.all.empty()) c.all = c.covering;
  return c;
}

}  // namespace cairn::builder

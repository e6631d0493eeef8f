// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include "compare.h"
#include "dynamics_cases.h"
#include "rolling.h"

// Ten kilometres out a float is a millimetre wide: a ball rolls down all the same.
//
//    0 . . . . . . . . . . 10 km . . .  (o
//                                     -.__ '-.
namespace cairn::hard {
namespace {

Outcome runFarFromOrigin(Effort) {
  const std::vector<Asked> asked{{"rolling, off that at the origin", 1, Bound::atMost, "%"}};
  constexpr double kFar = 1e4;
  return {compare(asked, balls(0.5),
                  [&](const CaseBody& body) -> Figures {
                    const double here = rollDown(body.body, {});
                    const double there =
                        rollDown(body.body, {.at = btVector3(btScalar(kFar), btScalar(-kFar), btScalar(kFar / 10))});
                    return {100 * std::abs(there / here - 1)};
                  }),
          ""};
}

}  // namespace

HardCase farFromOrigin() {
  return {
      "D14", "ten kilometres from the origin",
      "a ball rolls down a slope 10 km out: within 1 % of what it does at the origin, in single precision (proposed "
      "list)",
      runFarFromOrigin};
}

}  // namespace cairn::hard

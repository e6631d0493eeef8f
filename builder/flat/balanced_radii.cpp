// SPDX-License-Identifier: GPL-3.0-or-later
#include <tbb/parallel_for.h>

#include <algorithm>

#include "certify/left_out.h"
#include "certify/protrusion.h"
#include "flat/settle_radii.h"

namespace cairn::builder {
namespace {

/// Steps of the search for the error, and of one radius for a given error.
constexpr int kHalvings = 9, kRadiusSteps = 6;
/// A radius is found when its ball protrudes by the error, up to this part of it.
constexpr double kClose = 0.003;
/// A ball that would vanish keeps this part of its radius.
constexpr double kMinPart = 1e-3;

class RadiusBalance {
 public:
  RadiusBalance(const SphereSet& covering, const SignedDistance& solid, const KeepGoing& keepGoing)
      : covering_(covering), solid_(solid), keepGoing_(keepGoing), protrusions_(covering.size()) {
    tolerance_ = defaultProtrusionTolerance(solid);
    tolerance_.relative = kClose;
    tolerance_.absolute *= 0.1;
    tbb::parallel_for(std::size_t{0}, covering.size(),
                      [&](std::size_t i) { protrusions_[i] = protrusion(covering[i].center, covering[i].radius); });
  }

  SphereSet run() const {
    double most = *std::max_element(protrusions_.begin(), protrusions_.end()), least = 0.25 * most;
    SphereSet best = at(most);
    for (int i = 0; i < kHalvings && keepGoing_(); ++i) {
      const double error = (least + most) / 2;
      SphereSet set = at(error);
      if (leavesMore(set, error)) {
        least = error;
      } else {
        most = error;
        best = std::move(set);
      }
    }
    return best;
  }

 private:
  double protrusion(const Vec3d& center, double radius) const {
    return certifiedProtrusion(solid_, center, radius, tolerance_).upper;
  }

  /// The balls as large as they may be to protrude by no more than `error`, about.
  SphereSet at(double error) const {
    SphereSet set = covering_;
    tbb::parallel_for(std::size_t{0}, set.size(), [&](std::size_t i) {
      Ball& ball = set[i];
      const double least = kMinPart * ball.radius;
      // A protrusion grows no faster than the radius: a larger ball is safe at once, a smaller one falls short of what
      // it is to lose, if at all, so it is made smaller until it does not.
      double excess = protrusions_[i] - error;
      ball.radius = std::max(least, ball.radius - excess);
      if (excess <= 0) return;
      for (int step = 0; step < kRadiusSteps && ball.radius > least; ++step) {
        excess = protrusion(ball.center, ball.radius) - error;
        if (excess <= kClose * error) break;
        ball.radius = std::max(least, ball.radius - excess);
      }
    });
    return set;
  }

  /// Whether the balls leave out more of the surface than they may stick out.
  bool leavesMore(const SphereSet& set, double error) const {
    const LeftOutTolerance tolerance{kClose, 0.1 * kClose * error, 0};
    return surfaceLeftOut(set, solid_.mesh(), tolerance, keepGoing_).upper > error;
  }

  const SphereSet& covering_;
  const SignedDistance& solid_;
  const KeepGoing& keepGoing_;
  ProtrusionTolerance tolerance_;
  std::vector<double> protrusions_;  // of the covering balls
};

}  // namespace

SphereSet balancedRadii(SphereSet covering, const SignedDistance& solid, const KeepGoing& keepGoing) {
  return RadiusBalance(covering, solid, keepGoing).run();
}

}  // namespace cairn::builder

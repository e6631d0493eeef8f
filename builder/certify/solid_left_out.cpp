// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "certify/ball_distances.h"
#include "certify/left_out.h"

namespace cairn::builder {
namespace {

struct Cube {
  Vec3d middle;
  double half = 0;                  ///< of its edge
  double upper = 0;                 ///< no point of it is farther from the nearest ball
  std::uint32_t triangle = 0;       ///< one that may be near
  BallDistances::Names candidates;  ///< what can be nearest to a point of it

  /// Orders a heap: the largest bound on top.
  friend bool operator<(const Cube& a, const Cube& b) { return a.upper < b.upper; }
};

class CubeSearch {
 public:
  CubeSearch(std::span<const Ball> balls, const SignedDistance& solid, const EnclosedDistance& surface,
             const LeftOutTolerance& tolerance)
      : solid_(solid), balls_(balls, solid.bounds()), tolerance_(tolerance), best_(surface.lower), result_(surface) {}

  EnclosedDistance run(const KeepGoing& keepGoing) {
    const Bounds& bounds = solid_.bounds();
    const Vec3d size = bounds.upper - bounds.lower;
    // Slightly more than half, so that no rounding leaves a face of the box out.
    const double half = (0.5 + 0x1p-30) * std::max({size.x, size.y, size.z});
    const Vec3d middle = bounds.center();
    push({middle, half, std::numeric_limits<double>::infinity(), solid_.closest(middle).triangle, balls_.all()});
    while (!cubes_.empty() && !closeEnough(cubes_.front().upper) && looked_ < tolerance_.maxCubes && keepGoing())
      split();
    const double guard = 2 * balls_.guard();
    // What lies on the surface is bounded already, and more closely; a cube that is left is not known to be covered.
    const double inside = std::max(best_, cubes_.empty() ? 0.0 : cubes_.front().upper);
    if (best_ > 0 || !cubes_.empty()) result_.upper = std::max(result_.upper, std::max(inside, 0.0) + guard);
    result_.lower = std::max(result_.lower, best_ - guard);
    return result_;
  }

 private:
  bool closeEnough(double upper) const { return upper <= best_ * (1 + tolerance_.relative) + tolerance_.absolute; }

  void split() {
    std::pop_heap(cubes_.begin(), cubes_.end());
    const Cube cube = std::move(cubes_.back());
    cubes_.pop_back();
    const double half = 0.5 * cube.half;
    for (int i = 0; i < 8; ++i) {
      const Vec3d step((i & 1) != 0 ? half : -half, (i & 2) != 0 ? half : -half, (i & 4) != 0 ? half : -half);
      push({cube.middle + step, half, cube.upper, cube.triangle, cube.candidates});
    }
  }

  /// Keeps a cube unless it lies outside the solid, in one ball, or cannot hold a point farther than the witness.
  void push(Cube cube) {
    ++looked_;
    const double reach = std::numbers::sqrt3 * cube.half;
    const SignedDistance::Answer answer =
        solid_.query(cube.middle, solid_.distanceToTriangle(cube.triangle, cube.middle));
    const double rounding = solid_.roundingBound(cube.middle);
    if (answer.depth < -reach - rounding - balls_.guard()) return;
    cube.triangle = answer.nearest.triangle;
    BallDistances::Names near;
    const double outside = balls_.gather(cube.middle, reach, cube.candidates, near);
    if (answer.depth > rounding && outside > best_) {
      best_ = outside;
      result_.witness = cube.middle;
    }
    cube.upper = std::min(cube.upper, balls_.most(cornersOf(cube), near));
    if (cube.upper <= (best_ > 0 ? best_ : -balls_.guard())) return;
    cube.candidates = std::move(near);
    cubes_.push_back(std::move(cube));
    std::push_heap(cubes_.begin(), cubes_.end());
  }

  static std::array<Vec3d, 8> cornersOf(const Cube& cube) {
    std::array<Vec3d, 8> corners;
    for (int i = 0; i < 8; ++i)
      corners[i] = cube.middle + Vec3d((i & 1) != 0 ? cube.half : -cube.half, (i & 2) != 0 ? cube.half : -cube.half,
                                       (i & 4) != 0 ? cube.half : -cube.half);
    return corners;
  }

  const SignedDistance& solid_;
  BallDistances balls_;
  const LeftOutTolerance& tolerance_;
  double best_;
  std::size_t looked_ = 0;
  std::vector<Cube> cubes_;
  EnclosedDistance result_;
};

}  // namespace

EnclosedDistance solidLeftOut(std::span<const Ball> balls, const SignedDistance& solid, const EnclosedDistance& surface,
                              const LeftOutTolerance& tolerance, const KeepGoing& keepGoing) {
  return CubeSearch(balls, solid, surface, tolerance).run(keepGoing);
}

}  // namespace cairn::builder

// SPDX-License-Identifier: GPL-3.0-or-later
#include "rockfall/simulation/release.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "rockfall/simulation/run_seed.h"
#include "scenes/bodies/model.h"
#include "scenes/figures/random.h"

namespace cairn::rockfall {
namespace {

constexpr int kDrawsPerLevel = 20;
constexpr double kSeparateS = 2;    // apart in time by this much, two rocks may begin at one place
constexpr double kMinUpward = 0.2;  // of a normal: on a slope no rock starts more than five radii up
// In a rock's reach: how many heights of the ground are looked at on each side, as the ground's grid wants.
constexpr double kLeastLooks = 4, kMostLooks = 8;

/// The least height of a ball's middle over a point at which no ground is in it: over the slope there, and beside
/// walls.
double clearHeight(const Ground& ground, const MapPoint& point, double reachM) {
  double height = ground.heightAt(point) + reachM / std::max(kMinUpward, ground.normalAt(point).z);
  const double step = std::clamp(ground.cellM(), reachM / kMostLooks, reachM / kLeastLooks);
  const int looks = static_cast<int>(reachM / step);
  for (int i = -looks; i <= looks; ++i)
    for (int j = -looks; j <= looks; ++j) {
      const double x = i * step, y = j * step, belowMiddle = reachM * reachM - x * x - y * y;
      const MapPoint beside{point[0] + x, point[1] + y};
      if (belowMiddle >= 0 && ground.covers(beside))
        height = std::max(height, ground.heightAt(beside) + std::sqrt(belowMiddle));
    }
  return height;
}

class Releaser {
 public:
  Releaser(const Scene& scene, std::uint64_t run) : scene_(scene), run_(run) {}

  void release(std::uint32_t group, std::uint32_t number) {
    const RockGroup& rocks = scene_.description.rocks[group];
    const auto& shapes = scene_.stock.groups[group];
    ReleasedRock rock;
    rock.group = group;
    rock.variant = static_cast<std::uint32_t>(random(Variable::variant).bits() % shapes.size());
    const RockShape& shape = shapes[rock.variant];
    rock.sieveM = rocks.sieve.sizeAt(random(Variable::size).uniform());
    rock.massKg = rocks.densityKgPerM3 * shape.volume * rock.sieveM * rock.sieveM * rock.sieveM;
    rock.reachM = shape.reach * rock.sieveM;
    rock.timeS = number * rocks.release.intervalS;
    rock.velocity = scenes::toBullet(velocity(rocks.release));
    rock.pose = btTransform(orientation(rocks.release), scenes::toBullet(placeOf(rocks, number, rock)));
    rocks_.push_back(rock);
  }

  std::vector<ReleasedRock> take() { return std::move(rocks_); }

 private:
  scenes::Random random(Variable variable) const {
    return scenes::Random(seedOf(scene_.description.seed, scene_.description.name, run_, variable), rocks_.size());
  }

  Vec3d velocity(const Release& release) const {
    scenes::Random draws = random(Variable::velocity);
    Vec3d velocity = release.velocityMPerS;
    for (int axis = 0; axis < 3; ++axis)
      velocity[axis] += draws.uniform(-release.velocitySpreadMPerS[axis], release.velocitySpreadMPerS[axis]);
    return velocity;
  }

  btQuaternion orientation(const Release& release) const {
    if (!release.orientationDeg) return random(Variable::orientation).rotation();
    btQuaternion turn = btQuaternion::getIdentity();
    for (int axis = 0; axis < 3; ++axis) {
      const double half = (*release.orientationDeg)[axis] * std::numbers::pi / 360;
      btVector3 along(0, 0, 0);
      along[axis] = static_cast<btScalar>(std::sin(half));
      turn = btQuaternion(along.x(), along.y(), along.z(), static_cast<btScalar>(std::cos(half))) * turn;
    }
    return turn.normalize();
  }

  Vec3d placeOf(const RockGroup& rocks, std::uint32_t number, const ReleasedRock& rock) {
    if (rocks.perPlace == 0) return freePlace(rocks.release, rock);
    scenes::Random draws = random(Variable::place);
    const std::size_t piece = number / rocks.perPlace;
    for (int draw = 0; draw < kDrawsPerLevel; ++draw) {
      const double along = draws.uniform();
      const MapPoint point = rocks.release.places.in(piece, along, draws.uniform());
      if (scene_.ground->covers(point)) return over(point, rocks.release, rock);
    }
    return over(middleOf(rocks.release.places, piece), rocks.release, rock);
  }

  Vec3d over(const MapPoint& point, const Release& release, const ReleasedRock& rock) const {
    return {point[0], point[1], clearHeight(*scene_.ground, point, rock.reachM) + release.aboveGroundM};
  }

  // A full level is not looked at again by the rocks of its group that follow, nor are those below it.
  Vec3d freePlace(const Release& release, const ReleasedRock& rock) {
    scenes::Random places = random(Variable::place);
    if (rock.group != fullGroup_) fullLevels_ = 0;
    fullGroup_ = rock.group;
    for (int draw = fullLevels_ * kDrawsPerLevel;; ++draw) {
      fullLevels_ = std::max(fullLevels_, draw / kDrawsPerLevel - 1);
      Vec3d place = over(placeOver(release, places), release, rock);
      place.z += 2 * rock.reachM * (draw / kDrawsPerLevel);
      if (isFree(place, rock)) return place;
    }
  }

  /// Places over holes of the ground are drawn again: `prepareScene` has looked that there are others.
  MapPoint placeOver(const Release& release, scenes::Random& places) const {
    for (;;)
      if (const MapPoint point = drawPlace(release, places); scene_.ground->covers(point)) return point;
  }

  bool isFree(const Vec3d& place, const ReleasedRock& rock) const {
    const auto meets = [&](const ReleasedRock& r) { return scene_.description.rocks[r.group].meetsRocks; };
    return !meets(rock) || std::ranges::all_of(rocks_, [&](const ReleasedRock& other) {
      return !meets(other) || std::abs(other.timeS - rock.timeS) > kSeparateS ||
             distance(scenes::fromBullet(other.pose.getOrigin()), place) > other.reachM + rock.reachM;
    });
  }

  const Scene& scene_;
  std::uint64_t run_;
  std::vector<ReleasedRock> rocks_;
  std::uint32_t fullGroup_ = 0;
  int fullLevels_ = 0;
};

}  // namespace

MapPoint middleOf(const PlaceSet& places, std::size_t piece) {
  return places.in(piece, 0.5, 0.5);
}

MapPoint drawPlace(const Release& release, scenes::Random& random) {
  if (release.places.empty()) {
    const auto& [a, b] = release.boxM;
    const double x = random.uniform(a[0], b[0]);
    return {x, random.uniform(a[1], b[1])};
  }
  const double which = random.uniform(), along = random.uniform();
  return release.places.at(which, along, random.uniform());
}

std::vector<ReleasedRock> releaseRocks(const Scene& scene, std::uint64_t run) {
  Releaser releaser(scene, run);
  for (std::uint32_t group = 0; group < scene.description.rocks.size(); ++group)
    for (std::uint32_t number = 0; number < scene.description.rocks[group].count; ++number)
      releaser.release(group, number);
  return releaser.take();
}

}  // namespace cairn::rockfall

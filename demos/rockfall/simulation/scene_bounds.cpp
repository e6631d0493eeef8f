// SPDX-License-Identifier: GPL-3.0-or-later
#include "rockfall/simulation/scene_bounds.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "rockfall/simulation/release.h"

namespace cairn::rockfall {
namespace {

constexpr int kLattice = 256;
constexpr double kReleaseRadii = 5;  // a rock begins at most so far above the ground, see releaseRocks

/// Box of a region on the ground's part of the map.
struct MapBox {
  MapPoint lower, upper;
  MapBox(const Polygon& polygon, const Ground& ground)
      : lower{ground.lower().x, ground.lower().y}, upper{ground.upper().x, ground.upper().y} {
    if (polygon.empty()) return;
    for (std::size_t axis = 0; axis < 2; ++axis) {
      const auto byAxis = [&](const MapPoint& p) { return p[axis]; };
      lower[axis] = std::max(lower[axis], std::ranges::min(polygon, {}, byAxis)[axis]);
      upper[axis] = std::min(upper[axis], std::ranges::max(polygon, {}, byAxis)[axis]);
    }
  }
};

template <class Use>
void forEachPoint(const Polygon& polygon, const Ground& ground, const Use& use) {
  const auto look = [&](const MapPoint& point) {
    if (ground.covers(point)) use(point);
  };
  for (const MapPoint& corner : polygon) look(corner);
  const MapBox box(polygon, ground);
  for (int i = 0; i <= kLattice; ++i)
    for (int j = 0; j <= kLattice; ++j) {
      const MapPoint point{box.lower[0] + (box.upper[0] - box.lower[0]) * i / kLattice,
                           box.lower[1] + (box.upper[1] - box.lower[1]) * j / kLattice};
      if (contains(polygon, point)) look(point);
    }
}

std::vector<MaterialId> materialsOf(const Ground& ground) {
  std::vector<MaterialId> materials;
  forEachPoint({}, ground, [&](const MapPoint& point) { materials.push_back(ground.materialAt(point)); });
  std::ranges::sort(materials);
  materials.erase(std::unique(materials.begin(), materials.end()), materials.end());
  return materials;
}

double highestGround(const Release& release, const Ground& ground) {
  double highest = ground.lower().z;
  if (!release.places.empty()) {
    scenes::Random random(0);
    for (int draw = 0; draw < kLattice * kLattice; ++draw)
      if (const MapPoint point = drawPlace(release, random); ground.covers(point))
        highest = std::max(highest, ground.heightAt(point));
    return highest;
  }
  const auto& [a, b] = release.boxM;
  forEachPoint({a, {a[0], b[1]}, b, {b[0], a[1]}}, ground,
               [&](const MapPoint& point) { highest = std::max(highest, ground.heightAt(point)); });
  return highest;
}

/// Mass over density and cube of the sieve size, of all shapes of a group.
double leastVolume(const std::vector<RockShape>& shapes) {
  return std::ranges::min(shapes, {}, &RockShape::volume).volume;
}

/// A rock that is struck has at most the energy of all rocks that meet.
void boundStruck(const Scene& scene, std::vector<GroupBounds>& groups) {
  double energyJ = 0;
  for (std::size_t g = 0; g < groups.size(); ++g)
    if (const RockGroup& group = scene.description.rocks[g]; group.meetsRocks)
      energyJ += group.count * groups[g].greatestMassKg * std::pow(groups[g].greatestSpeedMPerS, 2) / 2;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const RockGroup& group = scene.description.rocks[g];
    const double leastMassKg =
        group.densityKgPerM3 * leastVolume(scene.stock.groups[g]) * std::pow(groups[g].smallestSieveM, 3);
    groups[g].struckSpeedMPerS = groups[g].greatestSpeedMPerS;
    if (group.meetsRocks)
      groups[g].struckSpeedMPerS = std::max(groups[g].greatestSpeedMPerS, std::sqrt(2 * energyJ / leastMassKg));
  }
}

GroupBounds boundsOf(const Scene& scene, const std::vector<ReleasedRock>& released, std::size_t index) {
  const RockGroup& group = scene.description.rocks[index];
  GroupBounds bounds;
  bounds.smallestSieveM = group.sieve.smallest();
  bounds.largestSieveM = group.sieve.largest();
  bounds.smallestRadiusM = bounds.smallestSieveM / 2;
  for (const RockShape& shape : scene.stock.groups[index]) {
    bounds.largestRadiusM = std::max(bounds.largestRadiusM, shape.reach * bounds.largestSieveM);
    bounds.greatestInertiaRatio = std::max(bounds.greatestInertiaRatio, shape.inertiaRatio);
    bounds.greatestMassKg =
        std::max(bounds.greatestMassKg, group.densityKgPerM3 * shape.volume * std::pow(bounds.largestSieveM, 3));
  }
  double highest =
      highestGround(group.release, *scene.ground) + group.release.aboveGroundM + bounds.largestRadiusM * kReleaseRadii;
  for (const ReleasedRock& rock : released)
    if (rock.group == index)
      highest = std::max(highest, static_cast<double>(rock.pose.getOrigin().z()) + 2 * bounds.largestRadiusM);
  bounds.greatestFallM = highest - scene.ground->lower().z;
  Vec3d fastest;
  for (int axis = 0; axis < 3; ++axis)
    fastest[axis] = std::abs(group.release.velocityMPerS[axis]) + group.release.velocitySpreadMPerS[axis];
  bounds.greatestSpeedMPerS = std::sqrt(lengthSq(fastest) + 2 * scene.description.gravityMPerS2 * bounds.greatestFallM);
  return bounds;
}

}  // namespace

SceneBounds boundsOf(const Scene& scene) {
  SceneBounds bounds;
  const std::vector<ReleasedRock> released = releaseRocks(scene, 0);
  for (std::size_t group = 0; group < scene.description.rocks.size(); ++group)
    bounds.groups.push_back(boundsOf(scene, released, group));
  boundStruck(scene, bounds.groups);
  bounds.groundCellM = scene.ground->cellM();
  bounds.groundMaterials = materialsOf(*scene.ground);
  bounds.lowestGround = [ground = scene.ground.get()](const Polygon& polygon) {
    std::optional<double> lowest;
    forEachPoint(polygon, *ground, [&](const MapPoint& point) {
      const double height = ground->heightAt(point);
      lowest = lowest ? std::min(*lowest, height) : height;
    });
    return lowest;
  };
  return bounds;
}

}  // namespace cairn::rockfall

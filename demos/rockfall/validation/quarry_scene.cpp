// SPDX-License-Identifier: GPL-3.0-or-later
#include "rockfall/validation/quarry_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "rockfall/validation/closed_scans.h"
#include "rockfall/validation/quarry_ground.h"
#include "scenes/bodies/model.h"

namespace cairn::rockfall {
namespace {

// A scan's size comes from its tree; of the groups' sieve curves nothing is drawn.
constexpr double kScanSieveM = 1;
constexpr std::size_t kPublishedRuns = 1024;  // of each profile

// A box around all places from which blocks fall.
std::array<MapPoint, 2> boxOf(const QuarryData& data) {
  MapPoint lower{1e300, 1e300}, upper{-1e300, -1e300};
  for (const QuarryProfile& profile : data.profiles)
    for (const Vec3d& drop : profile.drops)
      for (int axis = 0; axis < 2; ++axis) {
        const auto i = static_cast<std::size_t>(axis);
        lower[i] = std::min(lower[i], drop[axis]);
        upper[i] = std::max(upper[i], drop[axis]);
      }
  return {lower, upper};
}

RockGroup groupOf(const std::filesystem::path& scan, const QuarryData& data, const ValidationSettings& settings) {
  RockGroup group;
  group.source = MeshRocks{scan.string()};
  group.sieve.points = {{kScanSieveM, 0}, {kScanSieveM, 1}};
  group.treeDepth = settings.treeDepth;
  group.densityKgPerM3 = settings.densityKgPerM3;
  group.release.boxM = boxOf(data);
  return group;
}

Case caseOf(const QuarryData& data, const ClosedScans& scans, const ValidationSettings& settings) {
  Case description;
  description.name = "authume";
  description.seed = settings.seed;
  description.stepS = settings.stepS;
  description.durationS = settings.durationS;
  description.materials = settings.materials;
  description.effects = settings.effects;
  description.folder = data.folder;
  for (std::size_t scan = 0; scan < kScanNames.size(); ++scan)
    description.rocks.push_back(groupOf(scans.file(scan), data, settings));
  return description;
}

// What is wrong with a place, in the data's frame, whose y points up.
std::optional<std::string> whyNoDrop(const Vec3d& drop, const Ground& ground) {
  const MapPoint point{drop.x, drop.y};
  if (!ground.covers(point))
    return fmt::format("has no ground below it; the ground lies between x {:g} and {:g}, z {:g} and {:g}",
                       ground.lower().x, ground.upper().x, -ground.upper().y, -ground.lower().y);
  const double below = ground.heightAt(point) - drop.z;
  if (below > 0) return fmt::format("is {:.3g} m below the ground, whose y there is {:g}", below, drop.z + below);
  return {};
}

Status checkDrops(const QuarryData& data, const Ground& ground) {
  for (const QuarryProfile& profile : data.profiles)
    for (std::size_t i = 0; i < profile.drops.size(); ++i)
      if (const auto why = whyNoDrop(profile.drops[i], ground)) {
        const Vec3d& drop = profile.drops[i];
        return Error{fmt::format("{}, line {}: the place ({:g}, {:g}, {:g}) {}; give a place above it",
                                 dropsFile(data.folder, profile.name).string(), profile.dropLines[i], drop.x, drop.z,
                                 -drop.y, *why)};
      }
  return {};
}

btMatrix3x3 matrixOf(const Mat3d& m) {
  btMatrix3x3 result;
  for (int column = 0; column < 3; ++column) {
    Vec3d axis;
    axis[column] = 1;
    const Vec3d image = m * axis;
    for (int row = 0; row < 3; ++row) result[row][column] = static_cast<btScalar>(image[row]);
  }
  return result;
}

const btMatrix3x3& mapFromData() {
  static const btMatrix3x3 turn(1, 0, 0, 0, 0, -1, 0, 1, 0);
  return turn;
}

}  // namespace

Result<QuarryScene> prepareQuarry(const std::filesystem::path& folder, const ValidationSettings& settings,
                                  TreeCache& cache, const builder::ProgressCallback& progress) {
  auto data = readQuarry(folder);
  if (!data) return data.error();
  auto ground = readQuarryGround(folder, settings.cellM, settings.materials);
  if (!ground) return ground.error();
  const auto mapGround = makeGround(ground.value().terrain, ground.value().section);
  if (!mapGround) return mapGround.error();
  if (const Status checked = checkDrops(data.value(), *mapGround.value()); !checked) return checked.error();
  const auto scans = ClosedScans::create(folder);
  if (!scans) return scans.error();
  Case description = caseOf(data.value(), *scans.value(), settings);
  description.terrain = std::move(ground.value().section);
  auto scene = prepareScene(std::move(description), std::move(ground.value().terrain), cache, progress);
  if (!scene) return scene.error();
  auto blocks = chooseBlocks(data.value(), scene.value().stock, settings);
  if (!blocks) return blocks.error();
  return QuarryScene{std::move(data).value(), std::move(scene).value(), std::move(blocks).value(),
                     settings.dropSpeedMPerS, scans.value()->repairs()};
}

void useSettings(QuarryScene& quarry, const ValidationSettings& settings) {
  quarry.scene.description.effects = settings.effects;
  quarry.dropSpeedMPerS = settings.dropSpeedMPerS;
}

std::vector<BlockRun> runsOf(const QuarryScene& quarry, std::size_t profile) {
  const std::size_t drops = quarry.data.profiles[profile].drops.size(), orientations = quarry.data.orientations.size();
  const std::size_t all = quarry.blocks.size() * drops * orientations;
  const std::size_t stride = (all + kPublishedRuns - 1) / kPublishedRuns;
  std::vector<BlockRun> runs;
  for (std::size_t block = 0; block < quarry.blocks.size(); ++block)
    for (std::size_t drop = 0; drop < drops; ++drop)
      for (std::size_t i = (block + drop) % stride; i < orientations; i += stride)
        runs.push_back({profile, block, drop, i});
  return runs;
}

ReleasedRock releaseOf(const QuarryScene& quarry, const BlockRun& run) {
  const Block& block = quarry.blocks[run.block];
  const RockShape& shape = quarry.scene.stock.groups[block.scan].front();
  const auto& [q0, q1, q2, q3] = quarry.data.orientations[run.orientation];
  const btQuaternion turn(static_cast<btScalar>(q1), static_cast<btScalar>(q2), static_cast<btScalar>(q3),
                          static_cast<btScalar>(q0));
  const MapPoint& origin = quarry.scene.worldOrigin;
  const Vec3d place = quarry.data.profiles[run.profile].drops[run.drop] - Vec3d(origin[0], origin[1], 0);
  ReleasedRock rock;
  rock.group = static_cast<std::uint32_t>(block.scan);
  rock.sieveM = block.sieveM;
  rock.massKg = block.massKg;
  rock.reachM = shape.reach * rock.sieveM;
  // The body's axes are the mesh's principal ones.
  rock.pose.setBasis(mapFromData() * btMatrix3x3(turn) * matrixOf(shape.tree->mass().principalAxes));
  rock.pose.setOrigin(scenes::toBullet(place));
  rock.velocity = btVector3(static_cast<btScalar>(quarry.dropSpeedMPerS), 0, 0);
  return rock;
}

}  // namespace cairn::rockfall

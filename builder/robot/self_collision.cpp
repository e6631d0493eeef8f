// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <atomic>
#include <deque>
#include <set>
#include <utility>

#include "cairn/builder/robot.h"
#include "robot/link_spheres.h"
#include "robot/mirror_match.h"
#include "robot/parallel_jobs.h"
#include "robot/primitive_meshes.h"
#include "surface/random_stream.h"

namespace cairn::builder {
namespace {

using LinkPair = std::pair<std::uint32_t, std::uint32_t>;

/// What the check follows the fit in; fractions of the whole work.
constexpr double kFitted = 0.95;

/// The URDF's shapes of a link, in its frame.
std::vector<TriangleMesh> namedSurfaces(const RobotLink& link, const std::vector<RobotPart>& parts,
                                        const std::vector<RobotSolid>& solids) {
  std::vector<TriangleMesh> surfaces;
  for (const RobotPart& part : parts) {
    const CollisionShape& shape = link.collisions[part.collision];
    surfaces.push_back(part.solid ? mirrored(solids[*part.solid].surface, part.signs) : keptSurface(shape));
    for (Vec3d& v : surfaces.back().vertices) v = shape.origin(v);
  }
  return surfaces;
}

/// Counts of one pair, from all threads: sums, so their order does not show.
struct Tally {
  LinkPair links;
  std::atomic<std::uint32_t> spheres{0}, meshes{0}, falsely{0}, missed{0};

  explicit Tally(const LinkPair& pair) : links(pair) {}
  void add(bool bySpheres, bool byMeshes) {
    spheres += bySpheres ? 1 : 0;
    meshes += byMeshes ? 1 : 0;
    falsely += bySpheres && !byMeshes ? 1 : 0;
    missed += byMeshes && !bySpheres ? 1 : 0;
  }
};

class SelfCollisionCheck {
 public:
  SelfCollisionCheck(const RobotModel& model, const FittedRobot& fitted, const SelfCollisionOptions& options)
      : model_(model), options_(options) {
    for (std::uint32_t l = 0; l < model.links.size(); ++l) {
      spheres_.emplace_back(model.links[l], fitted.links[l]);
      surfaces_.emplace_back(namedSurfaces(model.links[l], fitted.links[l], fitted.solids));
    }
  }

  Result<SelfCollisions> run(const ProgressCallback& progress) {
    SelfCollisions result;
    result.poses = options_.poses;
    findPairs(result);
    // Some poses a job: a job has to be worth its start, and Ctrl-C is asked for between jobs.
    constexpr std::uint32_t kBlock = 4;
    const std::uint32_t blocks = (options_.poses + kBlock - 1) / kBlock;
    const Status done = runJobs(blocks, {"checking self-collisions", kFitted, 1}, progress,
                                [&](std::size_t block, const ProgressCallback&) -> Status {
                                  const auto begin = static_cast<std::uint32_t>(block) * kBlock;
                                  for (std::uint32_t p = begin; p < std::min(begin + kBlock, options_.poses); ++p)
                                    tryPose(p);
                                  return {};
                                });
    if (!done) return done.error();
    for (const Tally& tally : tallies_)
      if (tally.spheres > 0 || tally.meshes > 0)
        result.touching.push_back(
            {tally.links.first, tally.links.second, tally.spheres, tally.meshes, tally.falsely, tally.missed});
    return result;
  }

 private:
  void findPairs(SelfCollisions& result) {
    std::set<LinkPair> adjacent;
    for (const RobotJoint& joint : model_.joints) adjacent.insert(std::minmax(joint.parent, joint.child));
    std::vector<std::uint32_t> solid;
    for (std::uint32_t l = 0; l < spheres_.size(); ++l)
      if (!spheres_[l].empty()) solid.push_back(l);
    for (std::size_t i = 0; i < solid.size(); ++i)
      for (std::size_t k = i + 1; k < solid.size(); ++k) {
        const LinkPair pair(solid[i], solid[k]);
        if (adjacent.contains(pair))
          result.adjacent.push_back(pair);
        else
          tallies_.emplace_back(pair);
      }
    result.pairsTried = static_cast<std::uint32_t>(tallies_.size());
  }

  std::vector<double> positions(std::uint32_t pose) const {
    RandomStream random(options_.seed, pose);
    std::vector<double> positions(model_.joints.size(), 0);
    for (std::uint32_t j = 0; j < positions.size(); ++j) {
      const RobotJoint& joint = model_.joints[j];
      if (!joint.isActive()) continue;
      positions[j] =
          pose == 0 ? model_.defaultPosition(j) : joint.lower + random.uniform() * (joint.upper - joint.lower);
    }
    return positions;
  }

  void tryPose(std::uint32_t pose) {
    const std::vector<RigidPose> poses = model_.poses(positions(pose));
    for (Tally& tally : tallies_) {
      const auto& [a, b] = tally.links;
      const RigidPose between = poses[a].inverse() * poses[b];
      tally.add(spheres_[a].touches(spheres_[b], between), surfaces_[a].meets(surfaces_[b], between));
    }
  }

  const RobotModel& model_;
  const SelfCollisionOptions& options_;
  std::vector<LinkSpheres> spheres_;
  std::vector<LinkSurface> surfaces_;
  std::deque<Tally> tallies_;  // atomics do not move
};

}  // namespace

std::vector<std::pair<std::uint32_t, std::uint32_t>> SelfCollisions::always() const {
  std::vector<LinkPair> pairs;
  for (const LinkPairCount& pair : touching)
    if (pair.meshes == poses) pairs.emplace_back(pair.first, pair.second);
  return pairs;
}

Result<SelfCollisions> checkSelfCollision(const RobotModel& model, const FittedRobot& fitted,
                                          const SelfCollisionOptions& options, const ProgressCallback& progress) {
  return SelfCollisionCheck(model, fitted, options).run(progress);
}

}  // namespace cairn::builder

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <btBulletDynamicsCommon.h>

#include <map>
#include <utility>
#include <vector>

#include "rockfall/simulation/run_result.h"
#include "rockfall/simulation/scene.h"

namespace cairn::rockfall {

/// A rock at the end of a step.
struct RockMoment {
  double timeS = 0;
  Vec3d place;
  double heightM = 0, speed = 0, energyJ = 0;
  double translationJ = 0;  ///< of that energy; the rest is rotation
};

/// Precondition: the rock is over the ground.
RockMoment momentOf(const btRigidBody& rock, const Ground& ground, double timeS);

/// Records the paths of the rocks of one run: greatest values, cells, distances, collectors and trajectories.
class RockWatch {
 public:
  /// Both arguments must outlive this object. The result already has all released rocks.
  RockWatch(const Scene& scene, RunResult& result);

  /// Adds a rock that the result already has.
  void addRock();
  /// Adds the first moment of a rock, then one moment after each step.
  void follow(std::uint32_t rock, const RockMoment& moment);
  const RockMoment& last(std::uint32_t rock) const { return tracks_[rock].last; }
  /// Writes the records to the result, in the rocks' order.
  void finish();

 private:
  using Peaks = std::map<std::pair<std::int32_t, std::int32_t>, VisitRecord>;
  struct Track {
    bool begun = false;
    RockMoment last;
    std::uint64_t samples = 0;
    Peaks cells, distances;
    VisitRecord *cell = nullptr, *distance = nullptr;  // the last of them
  };

  void visit(std::uint32_t rock, const RockMoment& before, const RockMoment& now);
  void sample(std::uint32_t rock, const RockMoment& moment);
  void passCollectors(std::uint32_t rock, const RockMoment& before, const RockMoment& now);

  const Scene& scene_;
  RunResult& result_;
  std::vector<Track> tracks_;
};

}  // namespace cairn::rockfall

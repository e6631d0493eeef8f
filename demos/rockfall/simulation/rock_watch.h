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
};

/// Precondition: the rock is over the ground.
RockMoment momentOf(const btRigidBody& rock, const Ground& ground, double timeS);

/// Writes down where the rocks of one run go: greatest values, cells, distances, collectors, trajectories.
class RockWatch {
 public:
  /// Both must outlive the watch. The result's rocks are all there, as released.
  RockWatch(const Scene& scene, RunResult& result);

  /// One more rock, which the result has already.
  void addRock();
  /// The first moment of a rock, and each after a step.
  void follow(std::uint32_t rock, const RockMoment& moment);
  const RockMoment& last(std::uint32_t rock) const { return tracks_[rock].last; }
  /// Hands what was gathered by rock to the result, in the rocks' order.
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

  void visit(std::uint32_t rock, const RockMoment& moment);
  void sample(std::uint32_t rock, const RockMoment& moment);
  void passCollectors(std::uint32_t rock, const RockMoment& before, const RockMoment& now);

  const Scene& scene_;
  RunResult& result_;
  std::vector<Track> tracks_;
};

}  // namespace cairn::rockfall

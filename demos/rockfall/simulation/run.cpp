// SPDX-License-Identifier: GPL-3.0-or-later
#include "rockfall/simulation/run.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "cairn/builder/progress.h"
#include "cairn/core/state_hash.h"
#include "rockfall/simulation/energy_watch.h"
#include "rockfall/simulation/impact_watch.h"
#include "rockfall/simulation/run_world.h"
#include "rockfall/simulation/world_origin.h"
#include "scenes/bodies/model.h"
#include "scenes/figures/cpu_clock.h"
#include "scenes/figures/quantiles.h"

namespace cairn::rockfall {
namespace {

// Of many rocks a hundred steps take a tenth of a second; the question takes less than a microsecond.
constexpr std::uint32_t kStepsBetweenQuestions = 100;

// As Bullet asks before a body falls asleep.
bool isSlow(const btRigidBody& body) {
  return body.getLinearVelocity().length() < body.getLinearSleepingThreshold() &&
         body.getAngularVelocity().length() < body.getAngularSleepingThreshold();
}

/// One run while it goes on.
class Running {
 public:
  Running(const Scene& scene, std::uint64_t run, std::vector<ReleasedRock> releases, RunWorld& world)
      : scene_(scene),
        world_(world),
        releases_(std::move(releases)),
        bodies_(releases_.size()),
        gone_(releases_.size()),
        energies_(scene.description.gravityMPerS2, scene.ground->lower().z) {
    result_.run = run;
    for (const ReleasedRock& rock : releases_) {
      RockRecord record;
      record.group = rock.group;
      record.variant = rock.variant;
      record.sieveM = rock.sieveM;
      record.massKg = rock.massKg;
      record.releaseS = record.endS = rock.timeS;
      record.start = record.end = scenes::fromBullet(rock.pose.getOrigin());
      result_.rocks.push_back(record);
    }
    world_.expectRocks(releases_.size());
    watch_.emplace(scene_, result_);
    impacts_.emplace(scene_, result_);
  }

  Status releaseDue() {
    // Half a step early rather than late, so that rounding does not decide.
    const double due = time_ + scene_.description.stepS / 2;
    for (std::uint32_t rock = 0; rock < releases_.size(); ++rock) {
      if (bodies_[rock] || gone_[rock] || releases_[rock].timeS > due) continue;
      auto body = world_.addRock(releases_[rock], static_cast<int>(rock));
      if (!body) return body.error();
      bodies_[rock] = body.value();
      ++released_;
      energies_.enter(rock, *bodies_[rock]);
      watch_->follow(rock, momentOf(*bodies_[rock], *scene_.ground, time_));
    }
    return {};
  }

  // Pieces are rocks from the step in which they came to be.
  Status breakRocks() {
    auto broken = world_.breakRocks();
    if (!broken) return broken.error();
    for (const RunWorld::Broken& rock : broken.value()) {
      const auto number = static_cast<std::uint32_t>(rock.number);
      for (btRigidBody* piece : rock.pieces) addPiece(number, *piece);
      bodies_[number] = nullptr;
      gone_[number] = true;
      result_.rocks[number].ending = RockEnd::broken;
      result_.rocks[number].endS = time_;
    }
    return {};
  }

  void step() {
    world_.step();
    ++result_.steps;
    time_ = static_cast<double>(result_.steps) * scene_.description.stepS;
    const bullet::StepStatistics& step = world_.lastStep();
    narrowPhaseUs_.push_back(step.microseconds);
    result_.operations += step.operations;
    result_.maxOperations = std::max(result_.maxOperations, step.operations);
    impacts_->lookAt(world_.dispatcher(), bodies_, *watch_, time_);
    energies_.lookAt(world_.dispatcher());
    for (std::uint32_t rock = 0; rock < bodies_.size(); ++rock)
      if (bodies_[rock]) follow(rock);
    energies_.endStep();
  }

  bool isOver() const {
    return released_ == releases_.size() &&
           std::ranges::none_of(bodies_, [](const btRigidBody* body) { return body && body->isActive(); });
  }

  void addState(StateHash& hash) const {
    for (const btRigidBody* body : bodies_) {
      if (!body) continue;
      const btTransform& pose = body->getWorldTransform();
      for (int axis = 0; axis < 3; ++axis) {
        hash.add(pose.getOrigin()[axis]);
        for (int column = 0; column < 3; ++column) hash.add(pose.getBasis()[axis][column]);
        hash.add(body->getLinearVelocity()[axis]);
        hash.add(body->getAngularVelocity()[axis]);
      }
    }
  }

  FinishedRun finish(const StateHash& hash, double cpuUs) {
    for (std::uint32_t rock = 0; rock < bodies_.size(); ++rock) {
      if (gone_[rock]) continue;
      const bool rests = bodies_[rock] && !bodies_[rock]->isActive();
      result_.rocks[rock].ending = rests ? RockEnd::resting : RockEnd::moving;
      if (!rests) result_.rocks[rock].endS = time_;
    }
    watch_->finish();
    moveToMap(result_, scene_.worldOrigin);
    result_.stateHash = hash.hex();
    result_.releasedEnergyJ = energies_.broughtJ();
    result_.energyRiseJ = energies_.greatestRiseJ();
    result_.effects = world_.effects().records();
    const scenes::Quantiles times = scenes::quantilesOf(std::move(narrowPhaseUs_));
    return {std::move(result_), {cpuUs / 1e6, times.p999, times.max, world_.effects().report()}};
  }

 private:
  void follow(std::uint32_t rock) {
    const Vec3d center = scenes::fromBullet(bodies_[rock]->getWorldTransform().getOrigin());
    const MapPoint point{center.x, center.y};
    if (!isFinite(center)) return remove(rock, RockEnd::lost);
    energies_.follow(rock, *bodies_[rock]);
    if (!scene_.ground->covers(point))
      return remove(rock, scene_.ground->isWithin(point) ? RockEnd::hole : RockEnd::left);
    // The ground lifts again what has dived into it; from all of a rock below it nothing can be told.
    const auto reach = static_cast<double>(bodies_[rock]->getCollisionShape()->getAngularMotionDisc());
    if (center.z + reach < scene_.ground->heightAt(point)) return remove(rock, RockEnd::lost);
    if (!bodies_[rock]->isActive()) return;
    watch_->follow(rock, momentOf(*bodies_[rock], *scene_.ground, time_));
    if (!isSlow(*bodies_[rock])) result_.rocks[rock].endS = time_;
  }

  void addPiece(std::uint32_t from, btRigidBody& piece) {
    const auto number = static_cast<std::uint32_t>(bodies_.size());
    const RockRecord whole = result_.rocks[from];
    RockRecord record;
    record.brokenFrom = static_cast<std::int32_t>(from);
    record.group = whole.group;
    record.variant = whole.variant;
    record.massKg = 1 / static_cast<double>(piece.getInvMass());
    record.sieveM = whole.sieveM * std::cbrt(record.massKg / whole.massKg);
    record.releaseS = record.endS = time_;
    record.start = whole.start;
    record.end = scenes::fromBullet(piece.getWorldTransform().getOrigin());
    result_.rocks.push_back(record);
    bodies_.push_back(&piece);
    gone_.push_back(false);
    piece.setUserIndex(static_cast<int>(number));
    watch_->addRock();
    impacts_->addRock(from);
    energies_.handOn(from, number);
    follow(number);
  }

  /// Its last place is where it was over the ground.
  void remove(std::uint32_t rock, RockEnd ending) {
    world_.retire(*bodies_[rock]);
    bodies_[rock] = nullptr;
    gone_[rock] = true;
    result_.rocks[rock].ending = ending;
    result_.rocks[rock].endS = time_;
  }

  const Scene& scene_;
  RunWorld& world_;
  std::vector<ReleasedRock> releases_;
  std::vector<btRigidBody*> bodies_;  // by rock; null before release and once gone
  std::vector<bool> gone_;
  std::size_t released_ = 0;
  RunResult result_;
  std::optional<RockWatch> watch_;
  std::optional<ImpactWatch> impacts_;
  EnergyWatch energies_;
  std::vector<double> narrowPhaseUs_;
  double time_ = 0;
};

}  // namespace

Result<FinishedRun> simulate(const Scene& scene, std::uint64_t run, const std::function<bool()>& keepGoing) {
  return simulate(scene, run, releaseRocks(scene, run), keepGoing);
}

Result<FinishedRun> simulate(const Scene& scene, std::uint64_t run, std::vector<ReleasedRock> releases,
                             const std::function<bool()>& keepGoing) {
  const double start = scenes::threadCpuMicroseconds();
  auto world = RunWorld::create(scene, run);
  if (!world) return world.error();
  Running running(scene, run, std::move(releases), *world.value());
  StateHash hash;
  const auto stepsASecond = static_cast<std::uint32_t>(std::max(1.0, std::round(1 / scene.description.stepS)));
  for (std::uint32_t step = 1; step <= scene.description.stepCount(); ++step) {
    if (const Status released = running.releaseDue(); !released) return released.error();
    running.step();
    if (const Status broken = running.breakRocks(); !broken) return broken.error();
    if (step % stepsASecond == 0) running.addState(hash);
    if (step % kStepsBetweenQuestions == 0 && keepGoing && !keepGoing()) return Error{std::string(builder::kCancelled)};
    if (running.isOver()) break;
  }
  running.addState(hash);
  return running.finish(hash, scenes::threadCpuMicroseconds() - start);
}

}  // namespace cairn::rockfall

// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenes/heap/heap_run.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "cairn/builder/progress.h"

namespace cairn::scenes {
namespace {

/// One second, which shows the bodies' cost before the budget applied.
constexpr std::size_t kBefore = 60;

BudgetCut::Part partOf(std::span<const StepRecord> records) {
  BudgetCut::Part part;
  std::vector<double> operations;
  for (const StepRecord& record : records) {
    if (!record.tree) continue;
    operations.push_back(static_cast<double>(record.tree->operations));
    part.worstErrorFraction = std::max(part.worstErrorFraction, record.tree->worstErrorFraction);
  }
  part.operations = quantilesOf(std::move(operations)).median;
  return part;
}

std::optional<BudgetCut> budgetCut(std::span<const StepRecord> records, std::size_t without) {
  if (without == 0 || without >= records.size() || !records[0].tree) return {};
  const std::size_t before = std::min(without, kBefore);
  return BudgetCut{partOf(records.subspan(without - before, before)), partOf(records.subspan(without))};
}

/// Adds up how much velocities change from step to step.
class Trembling {
 public:
  void look(const World& world, bool counts) {
    std::vector<Vec3d> now;
    for (const btRigidBody* body : world.bodies()) now.push_back(fromBullet(body->getLinearVelocity()));
    for (std::size_t i = 0; counts && i < last_.size(); ++i) {
      squares_ += lengthSq(now[i] - last_[i]);
      ++count_;
    }
    last_ = std::move(now);
  }
  double rms() const { return count_ > 0 ? std::sqrt(squares_ / static_cast<double>(count_)) : 0; }

 private:
  std::vector<Vec3d> last_;
  double squares_ = 0;
  std::size_t count_ = 0;
};

std::vector<Vec3d> placesOf(const World& world) {
  std::vector<Vec3d> places;
  for (const btRigidBody* body : world.bodies()) places.push_back(fromBullet(body->getWorldTransform().getOrigin()));
  return places;
}

}  // namespace

Result<HeapReport> runHeap(BodyScene& scene, std::uint32_t steps, const StepCallback& afterStep) {
  HeapReport report;
  report.steps = steps;
  const auto second = static_cast<std::uint32_t>(std::lround(1 / scene.world().timeStep()));
  Trembling trembling;
  std::vector<StepRecord> records;
  StateHash hash;
  for (std::uint32_t done = 1; done <= steps; ++done) {
    if (done == scene.stepsWithoutBudget() + 1 && done > 1)
      if (const Status status = scene.beginBudget(); !status) return status.error();
    records.push_back(scene.step());
    report.peakSpeed = std::max(report.peakSpeed, fastestSpeed(scene.world().bodies()));
    trembling.look(scene.world(), done + second > steps);
    if (done == std::min(second, steps)) report.placesAfterASecond = placesOf(scene.world());
    if (done % kHashInterval == 0 || done == steps) scene.world().addState(hash);
    if (afterStep && !afterStep(done)) return Error{std::string(builder::kCancelled)};
  }
  const auto interpenetration = measureInterpenetration(scene);
  if (!interpenetration) return interpenetration.error();

  report.cost = runCost(records);
  report.cut = budgetCut(records, scene.stepsWithoutBudget());
  report.end = interpenetration.value();
  report.kineticEnergyEnd = meanKineticEnergy(scene.world().bodies());
  report.jitter = trembling.rms();
  report.placesAtTheEnd = placesOf(scene.world());
  report.lost = scene.countLost();
  report.asleep = countAsleep(scene.world().bodies());
  report.stateHash = hash.hex();
  report.records = std::move(records);
  return report;
}

}  // namespace cairn::scenes

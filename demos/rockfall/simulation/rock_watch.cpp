// SPDX-License-Identifier: GPL-3.0-or-later
#include "rockfall/simulation/rock_watch.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "rockfall/simulation/cells_on_way.h"
#include "scenes/bodies/model.h"
#include "scenes/world/world.h"

namespace cairn::rockfall {
namespace {

double between(double a, double b, double t) {
  return a + t * (b - a);
}

/// The crossing of the segment from a to b with a line, as fractions of both lengths.
struct Crossing {
  double onWay, onLine;
  bool toTheRight;
};

std::optional<Crossing> crossing(const Vec3d& a, const Vec3d& b, const MapPoint& first, const MapPoint& second) {
  const double lx = second[0] - first[0], ly = second[1] - first[1];
  const auto side = [&](const Vec3d& p) { return lx * (p.y - first[1]) - ly * (p.x - first[0]); };
  const double from = side(a), to = side(b);
  if ((from > 0) == (to > 0)) return {};
  const double onWay = from / (from - to);
  const double x = between(a.x, b.x, onWay) - first[0], y = between(a.y, b.y, onWay) - first[1];
  const double onLine = (x * lx + y * ly) / (lx * lx + ly * ly);
  if (onLine < 0 || onLine > 1) return {};
  return Crossing{onWay, onLine, from > 0};
}

}  // namespace

double RockRecord::runoutM() const {
  return std::hypot(end.x - start.x, end.y - start.y);
}

double RockRecord::energyLineDeg() const {
  return std::atan2(start.z - end.z, runoutM()) * 180 / std::numbers::pi;
}

std::uint32_t RunResult::wholeRock(std::uint32_t rock) const {
  while (rocks[rock].brokenFrom >= 0) rock = static_cast<std::uint32_t>(rocks[rock].brokenFrom);
  return rock;
}

RockMoment momentOf(const btRigidBody& rock, const Ground& ground, double timeS) {
  RockMoment moment;
  moment.timeS = timeS;
  moment.place = scenes::fromBullet(rock.getWorldTransform().getOrigin());
  moment.heightM = moment.place.z - ground.heightAt({moment.place.x, moment.place.y});
  moment.speed = static_cast<double>(rock.getLinearVelocity().length());
  moment.energyJ = scenes::kineticEnergy(rock);
  // The same expression as in there, so that the rest is never below zero.
  moment.translationJ =
      static_cast<double>(rock.getLinearVelocity().length2()) / static_cast<double>(rock.getInvMass()) / 2;
  return moment;
}

RockWatch::RockWatch(const Scene& scene, RunResult& result)
    : scene_(scene), result_(result), tracks_(result.rocks.size()) {
  if (scene.description.outputs.trajectoriesEveryS) result.trajectories.resize(result.rocks.size());
}

void RockWatch::addRock() {
  tracks_.emplace_back();
  if (scene_.description.outputs.trajectoriesEveryS) result_.trajectories.emplace_back();
}

void RockWatch::follow(std::uint32_t rock, const RockMoment& moment) {
  Track& track = tracks_[rock];
  RockRecord& record = result_.rocks[rock];
  record.maxSpeed = std::max(record.maxSpeed, moment.speed);
  record.maxEnergyJ = std::max(record.maxEnergyJ, moment.energyJ);
  record.maxHeightM = std::max(record.maxHeightM, moment.heightM);
  record.end = moment.place;
  if (track.begun) passCollectors(rock, track.last, moment);
  visit(rock, track.begun ? track.last : moment, moment);
  track.begun = true;
  track.last = moment;
  sample(rock, moment);
}

void RockWatch::visit(std::uint32_t rock, const RockMoment& before, const RockMoment& now) {
  if (!scene_.description.outputs.rasterCellM) return;
  const double cell = *scene_.description.outputs.rasterCellM;
  // A rock stays in a cell for many steps.
  const auto note = [&](Peaks& peaks, VisitRecord*& last, std::int32_t column, std::int32_t row,
                        const RockMoment& moment) {
    if (last == nullptr || last->column != column || last->row != row)
      last = &peaks.try_emplace({row, column}, VisitRecord{rock, column, row}).first->second;
    last->maxEnergyJ = std::max(last->maxEnergyJ, moment.energyJ);
    last->maxTranslationJ = std::max(last->maxTranslationJ, moment.translationJ);
    last->maxRotationJ = std::max(last->maxRotationJ, moment.energyJ - moment.translationJ);
    last->maxSpeed = std::max(last->maxSpeed, moment.speed);
    last->maxHeightM = std::max(last->maxHeightM, moment.heightM);
  };
  Track& track = tracks_[rock];
  const Vec3d& start = result_.rocks[rock].start;
  const auto onMap = [&](const RockMoment& moment) {
    return MapPoint{scene_.worldOrigin[0] + moment.place.x, scene_.worldOrigin[1] + moment.place.y};
  };
  const auto runout = [&](const RockMoment& moment) {
    return MapPoint{std::hypot(moment.place.x - start.x, moment.place.y - start.y), 0};
  };
  // Cells that are passed between two steps have the greater of both steps' values.
  const auto noteWay = [&](Peaks& peaks, VisitRecord*& last, const MapPoint& from, const MapPoint& to) {
    const std::int32_t endColumn = cellOf(to[0], cell), endRow = cellOf(to[1], cell);
    forEachCellEntered(from, to, cell, [&](std::int32_t column, std::int32_t row) {
      if (column == endColumn && row == endRow) return;
      note(peaks, last, column, row, before);
      note(peaks, last, column, row, now);
    });
    note(peaks, last, endColumn, endRow, now);
  };
  noteWay(track.cells, track.cell, onMap(before), onMap(now));
  noteWay(track.distances, track.distance, runout(before), runout(now));
}

void RockWatch::sample(std::uint32_t rock, const RockMoment& moment) {
  const auto& every = scene_.description.outputs.trajectoriesEveryS;
  if (!every) return;
  // Samples half a step early, so that rounding does not decide.
  const double due = result_.rocks[rock].releaseS + static_cast<double>(tracks_[rock].samples) * *every;
  if (moment.timeS < due - scene_.description.stepS / 2) return;
  ++tracks_[rock].samples;
  result_.trajectories[rock].push_back({moment.timeS, moment.place, moment.speed, moment.energyJ, moment.heightM});
}

void RockWatch::passCollectors(std::uint32_t rock, const RockMoment& before, const RockMoment& now) {
  const auto& collectors = scene_.description.collectors;
  for (std::uint32_t i = 0; i < collectors.size(); ++i) {
    double startM = 0;  // of the line's part, along the parts before it
    for (const Polyline& line : collectors[i].lines)
      for (std::size_t end = 1; end < line.size(); ++end) {
        const MapPoint &first = line[end - 1], &second = line[end];
        const double lengthM = std::hypot(second[0] - first[0], second[1] - first[1]);
        if (const auto passed = crossing(before.place, now.place, first, second)) {
          const double t = passed->onWay;
          result_.crossings.push_back({i, rock, passed->toTheRight ? 1 : -1, between(before.timeS, now.timeS, t),
                                       startM + passed->onLine * lengthM, between(before.heightM, now.heightM, t),
                                       between(before.speed, now.speed, t), between(before.energyJ, now.energyJ, t)});
        }
        startM += lengthM;
      }
  }
}

void RockWatch::finish() {
  for (const Track& track : tracks_) {
    for (const auto& [cell, visit] : track.cells) result_.cells.push_back(visit);
    for (const auto& [cell, visit] : track.distances) result_.distances.push_back(visit);
  }
}

}  // namespace cairn::rockfall

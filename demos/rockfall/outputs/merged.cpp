// SPDX-License-Identifier: GPL-3.0-or-later
#include "rockfall/outputs/merged.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace cairn::rockfall {
namespace {

void addVisit(CellSummary& cell, const VisitRecord& visit) {
  const std::array<double, kQuantities> values{visit.maxEnergyJ, visit.maxTranslationJ, visit.maxRotationJ,
                                               visit.maxSpeed, visit.maxHeightM};
  for (std::size_t i = 0; i < kQuantities; ++i) cell.values[i].add(values[i]);
}

}  // namespace

void MergedRuns::addEffects(const std::vector<EffectRecord>& ofRun) {
  effects.resize(std::max(effects.size(), ofRun.size()));
  for (std::size_t i = 0; i < ofRun.size(); ++i) {
    effects[i].name = ofRun[i].name;
    effects[i].acts += ofRun[i].acts;
    effects[i].energyTakenJ += ofRun[i].energyTakenJ;
    effects[i].impulseNS += ofRun[i].impulseNS;
    effects[i].torqueImpulseNMS += ofRun[i].torqueImpulseNMS;
  }
}

void MergedRuns::addCells(const RunResult& result) {
  std::set<std::pair<Cell, std::uint32_t>> arrived;
  for (const VisitRecord& visit : result.cells) {
    CellSummary& cell = cells[{visit.row, visit.column}];
    addVisit(cell, visit);
    cell.arrived += arrived.insert({{visit.row, visit.column}, result.wholeRock(visit.rock)}).second;
  }
}

void MergedRuns::add(const RunResult& result, std::optional<double> cellM) {
  ++runs;
  releasedEnergyJ += result.releasedEnergyJ;
  energyRiseJ = std::max(energyRiseJ, result.energyRiseJ);
  addEffects(result.effects);
  for (const RockRecord& rock : result.rocks) {
    ++rocks;
    released += rock.brokenFrom < 0;
    ++endings[static_cast<std::size_t>(rock.ending)];
    impacts += rock.impacts;
    if (rock.ending != RockEnd::broken) {
      runoutSumM += rock.runoutM();
      runoutM.add(rock.runoutM());
      runoutsCutOff += !rock.hasWholeWay();
    }
    energyJ.add(rock.maxEnergyJ);
    heightM.add(rock.maxHeightM);
    const bool stopped = rock.ending == RockEnd::resting || rock.ending == RockEnd::moving;
    if (cellM && stopped)
      ++cells[{static_cast<std::int32_t>(std::floor(rock.end.y / *cellM)),
               static_cast<std::int32_t>(std::floor(rock.end.x / *cellM))}]
            .stops;
  }
  addCells(result);
  for (const VisitRecord& visit : result.distances) addVisit(distances[visit.column], visit);
  std::set<std::pair<std::uint32_t, std::uint32_t>> crossed;
  for (const CrossingRecord& crossing : result.crossings) {
    CollectorSummary& collector = collectors[crossing.collector];
    ++collector.crossings;
    collector.rocks += crossed.insert({crossing.collector, crossing.rock}).second;
    collector.energyJ.add(crossing.energyJ);
    collector.heightM.add(crossing.heightM);
    collector.speed.add(crossing.speed);
  }
}

}  // namespace cairn::rockfall

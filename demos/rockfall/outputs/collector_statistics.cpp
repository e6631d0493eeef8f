// SPDX-License-Identifier: GPL-3.0-or-later
#include "rockfall/outputs/collector_statistics.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <map>
#include <set>

namespace cairn::rockfall {
namespace {

void addColumns(std::string& text, const Sample& sample) {
  fmt::format_to(std::back_inserter(text), ",{:.6g},{:.6g},{:.6g},{:.6g},{:.6g}", sample.mean(), sample.quantile(500),
                 sample.quantile(950), sample.quantile(990), sample.greatest());
  const Interval bounds = sample.size() > 0 ? sample.confidence(950) : Interval{};
  fmt::format_to(std::back_inserter(text), ",{:.6g},{}", bounds.low,
                 bounds.high ? fmt::format("{:.6g}", *bounds.high) : "");
}

}  // namespace

CollectorStatistics::CollectorStatistics(const Case& description) {
  for (const Collector& collector : description.collectors) collectors_.push_back({collector.name, 0, {}, {}, {}});
}

void CollectorStatistics::add(const RunResult& result) {
  for (const RockRecord& rock : result.rocks) released_ += rock.brokenFrom < 0;
  struct Greatest {
    double energyJ = 0, speed = 0, heightM = 0;
  };
  std::map<std::pair<std::uint32_t, std::uint32_t>, Greatest> crossed;  // by collector and rock
  std::set<std::pair<std::uint32_t, std::uint32_t>> arrived;
  for (const CrossingRecord& crossing : result.crossings) {
    Greatest& rock = crossed[{crossing.collector, crossing.rock}];
    rock.energyJ = std::max(rock.energyJ, crossing.energyJ);
    rock.speed = std::max(rock.speed, crossing.speed);
    rock.heightM = std::max(rock.heightM, crossing.heightM);
    if (arrived.insert({crossing.collector, result.wholeRock(crossing.rock)}).second)
      ++collectors_[crossing.collector].arrived;
  }
  for (const auto& [place, rock] : crossed) {
    Values& values = collectors_[place.first];
    values.energyJ.push_back(rock.energyJ);
    values.speed.push_back(rock.speed);
    values.heightM.push_back(rock.heightM);
  }
}

std::vector<CollectorFigures> CollectorStatistics::figures() const {
  std::vector<CollectorFigures> figures;
  for (const Values& values : collectors_)
    figures.push_back(
        {values.name, released_, values.arrived, Sample(values.energyJ), Sample(values.speed), Sample(values.heightM)});
  return figures;
}

std::string collectorsSummary(const std::vector<CollectorFigures>& figures) {
  std::string text = "collector,released,arrived,probability,probability_low,probability_high,n";
  for (const auto& [quantity, unit] :
       {std::pair{"energy", "j"}, std::pair{"speed", "m_per_s"}, std::pair{"height", "m"}})
    for (const char* figure : {"mean", "p50", "p95", "p99", "max", "p95_low", "p95_high"})
      text += fmt::format(",{}_{}_{}", quantity, figure, unit);
  text += '\n';
  for (const CollectorFigures& collector : figures) {
    const Interval share =
        collector.released > 0 ? confidenceOfShare(collector.arrived, collector.released) : Interval{0, 1};
    text += fmt::format("{},{},{},{:.6g},{:.6g},{:.6g},{}", collector.name, collector.released, collector.arrived,
                        collector.probability(), share.low, *share.high, collector.energyJ.size());
    for (const Sample* sample : {&collector.energyJ, &collector.speed, &collector.heightM}) addColumns(text, *sample);
    text += '\n';
  }
  return text;
}

}  // namespace cairn::rockfall

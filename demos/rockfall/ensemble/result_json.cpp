// SPDX-License-Identifier: GPL-3.0-or-later
// Records are arrays in the order of their members, because ensembles have millions of them.
#include "rockfall/ensemble/result_json.h"

namespace cairn::rockfall {
namespace {

/// Reads the elements of an array one by one.
class Elements {
 public:
  explicit Elements(const Json& array) : array_(array) {}
  template <class T>
  void into(T& value) {
    array_.at(next_++).get_to(value);
  }
  void into(Vec3d& value) {
    for (int axis = 0; axis < 3; ++axis) into(value[axis]);
  }
  void into(RockEnd& value) {
    std::uint32_t number = 0;
    into(number);
    value = static_cast<RockEnd>(number);
  }

 private:
  const Json& array_;
  std::size_t next_ = 0;
};

/// Puts members into an array.
class Collected {
 public:
  template <class T>
  void into(const T& value) {
    array.push_back(value);
  }
  void into(const Vec3d& value) {
    for (int axis = 0; axis < 3; ++axis) into(value[axis]);
  }
  void into(const RockEnd& value) { into(static_cast<std::uint32_t>(value)); }
  Json array = Json::array();
};

template <class Io, class... Members>
void each(Io& io, Members&... values) {
  (io.into(values), ...);
}

// One list of members serves both directions. A member that only one record has identifies the record.
template <class Io>
void transfer(Io& io, auto& r) requires requires {
  r.sieveM;
}
{
  each(io, r.brokenFrom, r.group, r.variant, r.sieveM, r.massKg, r.releaseS, r.endS, r.start, r.end, r.ending,
       r.maxSpeed, r.maxEnergyJ, r.maxHeightM, r.impacts);
}
template <class Io>
void transfer(Io& io, auto& r) requires requires {
  r.other;
}
{ each(io, r.rock, r.other, r.material, r.timeS, r.place, r.energyBeforeJ, r.energyAfterJ, r.impulseNS); }
template <class Io>
void transfer(Io& io, auto& r) requires requires {
  r.collector;
}
{ each(io, r.collector, r.rock, r.direction, r.timeS, r.alongM, r.heightM, r.speed, r.energyJ); }
template <class Io>
void transfer(Io& io, auto& r) requires requires {
  r.column;
}
{ each(io, r.rock, r.column, r.row, r.maxEnergyJ, r.maxTranslationJ, r.maxRotationJ, r.maxSpeed, r.maxHeightM); }
template <class Io>
void transfer(Io& io, auto& r) requires requires {
  r.place, r.heightM;
}
{ each(io, r.timeS, r.place, r.speed, r.energyJ, r.heightM); }

template <class Io>
void transfer(Io& io, auto& r) requires requires {
  r.energyTakenJ;
}
{ each(io, r.name, r.acts, r.energyTakenJ, r.impulseNS, r.torqueImpulseNMS); }

template <class Record>
Json toJson(const std::vector<Record>& records) {
  Json list = Json::array();
  for (const Record& record : records) {
    Collected collected;
    transfer(collected, record);
    list.push_back(std::move(collected.array));
  }
  return list;
}

template <class Record>
void fromJson(const Json& list, std::vector<Record>& records) {
  for (const Json& item : list) {
    Elements elements(item);
    transfer(elements, records.emplace_back());
  }
}

}  // namespace

Json resultToJson(const RunResult& result) {
  Json trajectories = Json::array();
  for (const auto& samples : result.trajectories) trajectories.push_back(toJson(samples));
  return {{"run", result.run},
          {"rocks", toJson(result.rocks)},
          {"impacts", toJson(result.impacts)},
          {"crossings", toJson(result.crossings)},
          {"cells", toJson(result.cells)},
          {"distances", toJson(result.distances)},
          {"trajectories", std::move(trajectories)},
          {"effects", toJson(result.effects)},
          {"steps", result.steps},
          {"operations", result.operations},
          {"max_operations", result.maxOperations},
          {"released_energy_j", result.releasedEnergyJ},
          {"energy_rise_j", result.energyRiseJ},
          {"state_hash", result.stateHash}};
}

RunResult resultFromJson(const Json& json) {
  RunResult result;
  json.at("run").get_to(result.run);
  fromJson(json.at("rocks"), result.rocks);
  fromJson(json.at("impacts"), result.impacts);
  fromJson(json.at("crossings"), result.crossings);
  fromJson(json.at("cells"), result.cells);
  fromJson(json.at("distances"), result.distances);
  for (const Json& samples : json.at("trajectories")) fromJson(samples, result.trajectories.emplace_back());
  fromJson(json.at("effects"), result.effects);
  json.at("steps").get_to(result.steps);
  json.at("operations").get_to(result.operations);
  json.at("max_operations").get_to(result.maxOperations);
  json.at("released_energy_j").get_to(result.releasedEnergyJ);
  json.at("energy_rise_j").get_to(result.energyRiseJ);
  json.at("state_hash").get_to(result.stateHash);
  return result;
}

Json costToJson(const RunCost& cost) {
  Json effects = Json::array();
  for (const EffectReport& effect : cost.effects)
    effects.push_back({{"effect", effect.name}, {"acted", effect.acted}, {"elapsed_us", effect.elapsedUs}});
  return {{"cpu_s", cost.cpuS},
          {"narrow_phase_p999_us", cost.narrowPhaseP999Us},
          {"narrow_phase_max_us", cost.narrowPhaseMaxUs},
          {"effects", std::move(effects)}};
}

RunCost costFromJson(const Json& json) {
  RunCost cost;
  json.at("cpu_s").get_to(cost.cpuS);
  json.at("narrow_phase_p999_us").get_to(cost.narrowPhaseP999Us);
  json.at("narrow_phase_max_us").get_to(cost.narrowPhaseMaxUs);
  for (const Json& effect : json.at("effects"))
    cost.effects.push_back({effect.at("effect").get<std::string>(), effect.at("acted").get<std::uint64_t>(),
                            effect.at("elapsed_us").get<double>()});
  return cost;
}

}  // namespace cairn::rockfall

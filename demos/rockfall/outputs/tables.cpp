// SPDX-License-Identifier: GPL-3.0-or-later
#include "rockfall/outputs/tables.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <iterator>

namespace cairn::rockfall {

const char* nameOf(RockEnd ending) {
  static constexpr std::array kNames{"resting", "moving", "left", "lost", "broken", "hole"};
  static_assert(kNames.size() == kRockEnds);
  return kNames[static_cast<std::size_t>(ending)];
}

Tables::Tables(const Case& description)
    : description_(description),
      runs_(
          "run,rocks,resting,moving,left,lost,broken,hole,impacts,crossings,max_energy_j,max_height_m,max_runout_m,"
          "steps,"
          "operations,max_operations,released_energy_j,energy_rise_j,state_hash\n"),
      rocks_(
          "run,rock,broken_from,group,variant,sieve_m,mass_kg,release_s,end_s,ending,start_x_m,start_y_m,start_z_m,end_"
          "x_m,"
          "end_y_m,end_z_m,runout_m,max_speed_m_per_s,max_energy_j,max_height_m,impacts,energy_line_deg\n"),
      impacts_("run,rock,with,material,time_s,x_m,y_m,z_m,energy_before_j,energy_after_j,impulse_n_s\n"),
      crossings_("run,collector,rock,direction,time_s,along_m,height_m,speed_m_per_s,energy_j\n"),
      effects_("run,index,effect,acts,energy_taken_j,impulse_n_s,torque_impulse_n_m_s\n") {}

void Tables::add(const RunResult& result) {
  std::array<std::uint32_t, kRockEnds> endings{};
  std::uint64_t impacts = 0;
  double energy = 0, height = 0, runout = 0;
  for (std::size_t i = 0; i < result.rocks.size(); ++i) {
    const RockRecord& r = result.rocks[i];
    ++endings[static_cast<std::size_t>(r.ending)];
    impacts += r.impacts;
    energy = std::max(energy, r.maxEnergyJ);
    height = std::max(height, r.maxHeightM);
    runout = std::max(runout, r.runoutM());
    fmt::format_to(
        std::back_inserter(rocks_),
        "{},{},{},{},{},{:.4f},{:.3f},{:.4f},{:.4f},{},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},"
        "{:.6g},{:.4f},{},{:.3f}\n",
        result.run, i, r.brokenFrom < 0 ? "" : fmt::format("{}", r.brokenFrom), r.group, r.variant, r.sieveM, r.massKg,
        r.releaseS, r.endS, nameOf(r.ending), r.start.x, r.start.y, r.start.z, r.end.x, r.end.y, r.end.z, r.runoutM(),
        r.maxSpeed, r.maxEnergyJ, r.maxHeightM, r.impacts, r.energyLineDeg());
  }
  for (const ImpactRecord& i : result.impacts)
    fmt::format_to(std::back_inserter(impacts_), "{},{},{},{},{:.4f},{:.4f},{:.4f},{:.4f},{:.6g},{:.6g},{:.6g}\n",
                   result.run, i.rock, i.other < 0 ? "ground" : fmt::format("{}", i.other),
                   description_.materials[i.material], i.timeS, i.place.x, i.place.y, i.place.z, i.energyBeforeJ,
                   i.energyAfterJ, i.impulseNS);
  for (const CrossingRecord& c : result.crossings)
    fmt::format_to(std::back_inserter(crossings_), "{},{},{},{},{:.4f},{:.4f},{:.4f},{:.4f},{:.6g}\n", result.run,
                   description_.collectors[c.collector].name, c.rock, c.direction, c.timeS, c.alongM, c.heightM,
                   c.speed, c.energyJ);
  for (std::size_t i = 0; i < result.effects.size(); ++i) {
    const EffectRecord& effect = result.effects[i];
    fmt::format_to(std::back_inserter(effects_), "{},{},{},{},{:.6g},{:.6g},{:.6g}\n", result.run, i, effect.name,
                   effect.acts, effect.energyTakenJ, effect.impulseNS, effect.torqueImpulseNMS);
  }
  fmt::format_to(std::back_inserter(runs_), "{},{},{},{},{},{:.6g},{:.4f},{:.4f},{},{},{},{:.6g},{:.6g},{}\n",
                 result.run, result.rocks.size(), fmt::join(endings, ","), impacts, result.crossings.size(), energy,
                 height, runout, result.steps, result.operations, result.maxOperations, result.releasedEnergyJ,
                 result.energyRiseJ, result.stateHash);
}

}  // namespace cairn::rockfall

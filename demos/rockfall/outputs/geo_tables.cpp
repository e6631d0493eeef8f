// SPDX-License-Identifier: GPL-3.0-or-later
#include "rockfall/outputs/geo_tables.h"

#include "rockfall/outputs/tables.h"

namespace cairn::rockfall {
namespace {

constexpr double kKilo = 1e3;

using Kind = GeoField::Kind;

std::vector<GeoField> rockFields() {
  return {{"run", Kind::whole},          {"rock", Kind::whole},
          {"group", Kind::whole},        {"ending", Kind::text},
          {"sieve_m", Kind::real},       {"mass_kg", Kind::real},
          {"time_s", Kind::real},        {"runout_m", Kind::real},
          {"fall_m", Kind::real},        {"energy_line_deg", Kind::real},
          {"energy_max_kJ", Kind::real}, {"speed_max_m_per_s", Kind::real},
          {"height_max_m", Kind::real}};
}

std::vector<GeoRow::Value> rockValues(std::uint64_t run, std::size_t number, const RockRecord& rock) {
  return {static_cast<std::int64_t>(run),
          static_cast<std::int64_t>(number),
          static_cast<std::int64_t>(rock.group),
          std::string(nameOf(rock.ending)),
          rock.sieveM,
          rock.massKg,
          rock.endS - rock.releaseS,
          rock.runoutM(),
          rock.start.z - rock.end.z,
          rock.energyLineDeg(),
          rock.maxEnergyJ / kKilo,
          rock.maxSpeed,
          rock.maxHeightM};
}

void addFigures(const Sample& sample, double unit, std::vector<GeoRow::Value>& values) {
  for (const double figure :
       {sample.mean(), sample.quantile(500), sample.quantile(950), sample.quantile(990), sample.greatest()})
    values.emplace_back(figure / unit);
}

}  // namespace

GeoTables::GeoTables()
    : trajectories_{"trajectories", false, rockFields(), {}}, stops_{"stops", true, rockFields(), {}} {}

void GeoTables::add(const RunResult& result) {
  for (std::size_t i = 0; i < result.rocks.size(); ++i) {
    const RockRecord& rock = result.rocks[i];
    stops_.rows.push_back({{{rock.end}}, rockValues(result.run, i, rock)});
    if (i >= result.trajectories.size() || result.trajectories[i].size() < 2) continue;  // one place is no line
    std::vector<Vec3d> way;
    for (const TrajectorySample& sample : result.trajectories[i]) way.push_back(sample.place);
    trajectories_.rows.push_back({{std::move(way)}, rockValues(result.run, i, rock)});
  }
}

GeoTable collectorsTable(const Case& description, const std::vector<CollectorFigures>& figures) {
  GeoTable table{
      "collectors",
      false,
      {{"name", Kind::text}, {"released", Kind::whole}, {"arrived", Kind::whole}, {"probability", Kind::real}},
      {}};
  for (const auto& [quantity, unit] :
       {std::pair{"energy", "kJ"}, std::pair{"speed", "m_per_s"}, std::pair{"height", "m"}})
    for (const char* figure : {"mean", "p50", "p95", "p99", "max"})
      table.fields.push_back({std::string(quantity) + "_" + figure + "_" + unit, Kind::real});
  for (std::size_t i = 0; i < figures.size(); ++i) {
    const CollectorFigures& collector = figures[i];
    GeoRow row{{},
               {collector.name, static_cast<std::int64_t>(collector.released),
                static_cast<std::int64_t>(collector.arrived), collector.probability()}};
    addFigures(collector.energyJ, kKilo, row.values);
    addFigures(collector.speed, 1, row.values);
    addFigures(collector.heightM, 1, row.values);
    for (const Polyline& line : description.collectors[i].lines) {
      std::vector<Vec3d>& part = row.parts.emplace_back();
      for (const MapPoint& corner : line) part.emplace_back(corner[0], corner[1], 0);
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

}  // namespace cairn::rockfall

// SPDX-License-Identifier: GPL-3.0-or-later
// Effects of what a body is in: air, water, forest, the layer over the ground.
#include <fmt/format.h>

#include "rockfall/case/effect_readers.h"

namespace cairn::rockfall {
namespace {

constexpr Range kDensity = between(0, 20000), kCoefficient = between(0, 100), kDiameter{0, 1000, true};
constexpr std::size_t kMaxStems = 1000000;

double readDiameter(const Value& value) {
  constexpr double kThickest = 5;  // m; of the rarest trees, with few exceptions
  const double diameter = value.number(kDiameter);
  if (diameter > kThickest)
    value.refuse(
        fmt::format("no stem is {:g} m thick: give its diameter at breast height in metres, not its height, nor "
                    "centimetres",
                    diameter));
  return diameter;
}

double readHeight(const Value& value) {
  constexpr Range kHeight{0, 130, true};  // m; the highest tree has 116
  return value.number(kHeight);
}

std::array<double, 2> readEnds(const Value& value, double (*read)(const Value&)) {
  const auto ends = value.items(2, 2);
  if (ends.size() != 2) return {};
  const std::array<double, 2> result{read(ends[0]), read(ends[1])};
  if (result[1] < result[0]) value.refuse("the smaller number comes first");
  return result;
}

StandOfTrees readStandDensity(Object& object) {
  StandOfTrees stand;
  stand.densityPerHa = object.at("density_per_ha").number(between(0, 100000));
  stand.diameterM = readEnds(object.at("diameter_m"), readDiameter);
  if (const auto heights = object.find("height_m")) stand.heightM = readEnds(*heights, readHeight);
  return stand;
}

MappedTrees readMappedTrees(Object& object) {
  MappedTrees trees{readMapSource(object), {}, {}};
  if (!trees.map.isRaster)
    if (const auto field = object.find("diameter_field")) {
      trees.diameterField = field->text();
      return trees;
    }
  trees.stands = readClasses<StandOfTrees>(object, trees.map, "stands", [](const Value& value) {
    Object stand(value);
    return readStandDensity(stand);
  });
  return trees;
}

std::variant<std::vector<Stem>, StandOfTrees, MappedTrees> readStand(const Value& value) {
  Object object(value);
  if (namesMap(object)) return readMappedTrees(object);
  StandOfTrees stand = readStandDensity(object);
  stand.polygon = readRegion(object);
  return stand;
}

std::vector<Stem> readStems(const Value& value) {
  std::vector<Stem> stems;
  for (const Value& item : value.items(0, kMaxStems)) {
    const auto parts = item.items(3, 4);
    if (parts.size() < 3) return stems;
    const MapPoint place{parts[0].number(between(-1e7, 1e7)), parts[1].number(between(-1e7, 1e7))};
    stems.push_back({place, readDiameter(parts[2]), parts.size() > 3 ? readHeight(parts[3]) : 0});
  }
  return stems;
}

}  // namespace

EffectOptions readAirDrag(Object& object, const Materials& /*materials*/) {
  const double density = object.numberOr("density_kg_per_m3", kDensity, 1.2);
  return AirDragOptions{density, object.numberOr("coefficient", kCoefficient, 0.5)};
}

EffectOptions readWater(Object& object, const Materials& /*materials*/) {
  WaterOptions options;
  options.levelM = object.at("level_m").number(between(-1e5, 1e5));
  options.densityKgPerM3 = object.numberOr("density_kg_per_m3", kDensity, options.densityKgPerM3);
  options.coefficient = object.numberOr("coefficient", kCoefficient, options.coefficient);
  options.polygon = readRegion(object);
  return options;
}

EffectOptions readForestDrag(Object& object, const Materials& /*materials*/) {
  ForestDragOptions options;
  options.heightM = object.at("height_m").number(between(0, 200));
  options.coefficientKgPerS = object.at("coefficient_kg_per_s").number(between(0, 1e9));
  options.polygon = readRegion(object);
  return options;
}

EffectOptions readTrees(Object& object, const Materials& /*materials*/) {
  TreesOptions options;
  options.energyRatio = object.numberOr("energy_ratio", between(0, 100), options.energyRatio);
  const Value stems = object.at("stems");
  if (stems.isArray())
    options.stems = readStems(stems);
  else if (stems.isObject())
    options.stems = readStand(stems);
  else
    stems.refuse("this must be a list of stems, or an object with the density of a stand");
  return options;
}

EffectOptions readBarrier(Object& object, const Materials& /*materials*/) {
  BarrierOptions options;
  const PlacedLines placed = readLines(object);
  options.lines = placed.lines;
  options.map = placed.map;
  options.heightM = object.at("height_m").number(between(0, 100));
  options.capacityJ = object.at("capacity_j").number(between(0, 1e9));
  return options;
}

EffectOptions readGroundDrag(Object& object, const Materials& /*materials*/) {
  GroundDragOptions options;
  options.belowMPerS = object.numberOr("below_m_per_s", between(0, 300), options.belowMPerS);
  options.withinM = object.numberOr("within_m", between(0, 1000), options.withinM);
  options.decelerationMPerS2 = object.at("deceleration_m_per_s2").number(between(0, 1e4));
  return options;
}

}  // namespace cairn::rockfall

// SPDX-License-Identifier: GPL-3.0-or-later
#include "rockfall/case/rocks_section.h"

#include <fmt/format.h>

namespace cairn::rockfall {
namespace {

constexpr std::size_t kMaxGroups = 100, kMaxSieveSizes = 100;
constexpr std::uint64_t kMaxVariants = 100;

std::variant<MadeRocks, MeshRocks> readRockSource(Object& group) {
  const auto make = group.find("make"), mesh = group.find("mesh");
  if (make.has_value() == mesh.has_value()) {
    group.refuse("exactly one of \"make\" and \"mesh\" must be given");
    return {};
  }
  if (mesh) return MeshRocks{mesh->text()};
  Object object(*make);
  static constexpr std::array<std::string_view, 3> kKinds{"angular", "slabby", "rounded"};
  MadeRocks rocks;
  rocks.kind = static_cast<RockKind>(object.at("kind").choice(kKinds, "kind of rock"));
  if (const auto concave = object.find("concave")) rocks.concave = concave->flag();
  if (const auto variants = object.find("variants"))
    rocks.variants = static_cast<std::uint32_t>(variants->whole(1, kMaxVariants));
  return rocks;
}

SieveCurve readSieve(const Value& value) {
  Object object(value);
  SieveCurve curve;
  const Value sizes = object.at("sizes");
  for (const Value& item : sizes.items(2, kMaxSieveSizes)) {
    const auto pair = item.items(2, 2);
    if (pair.size() != 2) return curve;
    const SieveCurve::Point point{pair[0].number({0.01, 100}), pair[1].number(between(0, 1))};
    if (!curve.points.empty() && (point.sizeM < curve.points.back().sizeM || point.share <= curve.points.back().share))
      item.refuse("sieve sizes must not fall, and shares must rise, from point to point");
    curve.points.push_back(point);
  }
  if (!curve.points.empty() && (curve.points.front().share != 0 || curve.points.back().share != 1))
    sizes.refuse("the first share must be 0 and the last 1");
  return curve;
}

/// Leaves `vector` where the key is missing.
void readVector(Object& object, std::string_view key, const Range& range, Vec3d& vector) {
  const auto value = object.find(key);
  if (!value) return;
  if (const auto parts = value->items(3, 3); parts.size() == 3)
    for (int axis = 0; axis < 3; ++axis) vector[axis] = parts[static_cast<std::size_t>(axis)].number(range);
}

Release readRelease(const Value& value) {
  Object object(value);
  Release release;
  const auto box = object.find("box_m");
  if (box.has_value() == namesMap(object))
    object.refuse("exactly one of \"box_m\", \"vector\" and \"raster\" must be given");
  else if (!box)
    release.map = readMapSource(object);
  else if (const auto corners = box->items(2, 2); corners.size() == 2)
    release.boxM = {readPoint(corners[0]), readPoint(corners[1])};
  release.aboveGroundM = object.at("above_ground_m").number(between(0, 10000));
  readVector(object, "velocity_m_per_s", between(-300, 300), release.velocityMPerS);
  readVector(object, "velocity_spread_m_per_s", between(0, 300), release.velocitySpreadMPerS);
  if (object.find("orientation_deg"))
    readVector(object, "orientation_deg", between(-360, 360), release.orientationDeg.emplace());
  release.intervalS = object.numberOr("interval_s", between(0, 3600), 0);
  return release;
}

double readDensity(const Value& value) {
  constexpr double kLightest = 50;     // kg/m^3: lighter than any wood or pumice
  constexpr double kHeaviest = 20000;  // heavier than gold
  const double density = value.number({1, kHeaviest});
  if (density < kLightest && 1000 * density <= kHeaviest)
    value.refuse(
        fmt::format("{:g} kg/m3 is lighter than any rock: if these are t/m3, give {:g}", density, 1000 * density));
  else if (density < kLightest)
    value.refuse(fmt::format("{:g} kg/m3 is lighter than any rock: give {:g} to {:g}", density, kLightest, kHeaviest));
  return density;
}

void readCount(Object& object, RockGroup& group) {
  const auto count = object.find("count"), perPlace = object.find("count_per_place");
  if (count.has_value() == perPlace.has_value())
    object.refuse("exactly one of \"count\" and \"count_per_place\" must be given");
  else if (count)
    group.count = static_cast<std::uint32_t>(count->whole(1, kMaxRocks));
  else
    group.perPlace = static_cast<std::uint32_t>(perPlace->whole(1, kMaxRocks));
  // Rocks of many places stand for as many events.
  group.meetsRocks = !perPlace;
  if (const auto meets = object.find("meets_rocks")) group.meetsRocks = meets->flag();
}

RockGroup readGroup(const Value& value, const Materials& materials) {
  Object object(value);
  RockGroup group;
  readCount(object, group);
  group.source = readRockSource(object);
  group.sieve = readSieve(object.at("sieve_m"));
  if (const auto depth = object.find("tree_depth")) group.treeDepth = static_cast<std::uint32_t>(depth->whole(1, 5));
  group.densityKgPerM3 = readDensity(object.at("density_kg_per_m3"));
  group.material = readMaterial(object.at("material"), materials);
  const Value release = object.at("release");
  group.release = readRelease(release);
  if (group.perPlace > 0 && !group.release.map)
    release.refuse("\"count_per_place\" needs the places of a map: give \"vector\" or \"raster\"");
  return group;
}

}  // namespace

double SieveCurve::sizeAt(double u) const {
  std::size_t i = 1;
  while (i + 1 < points.size() && points[i].share < u) ++i;
  const Point &a = points[i - 1], &b = points[i];
  return a.sizeM + (b.sizeM - a.sizeM) * (u - a.share) / (b.share - a.share);
}

std::vector<RockGroup> readRocks(const Value& value, const Materials& materials) {
  std::vector<RockGroup> groups;
  for (const Value& item : value.items(1, kMaxGroups)) groups.push_back(readGroup(item, materials));
  return groups;
}

}  // namespace cairn::rockfall

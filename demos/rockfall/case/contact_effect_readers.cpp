// SPDX-License-Identifier: GPL-3.0-or-later
// Effects at contacts, most of them by material.
#include <algorithm>
#include <array>

#include "rockfall/case/effect_readers.h"
#include "rockfall/case/soil_classes.h"

namespace cairn::rockfall {
namespace {

constexpr std::size_t kMaxEntries = 256;
constexpr Range kFriction = between(0, 10), kLever = between(0, 10), kShare = between(0, 1);
constexpr Range kSpeed{0, 1000, true};

/// The list "materials" of an effect that is told for each material by itself, none twice; `readEntry` gets the
/// element.
template <class Entry, class ReadEntry>
std::vector<Entry> readByMaterial(Object& object, const Materials& materials, const ReadEntry& readEntry) {
  std::vector<Entry> entries;
  for (const Value& item : object.at("materials").items(1, kMaxEntries)) {
    Object element(item);
    const MaterialId material = readMaterial(element.at("material"), materials);
    if (std::ranges::find(entries, material, &Entry::material) != entries.end())
      item.refuse("this material is listed twice");
    entries.push_back(readEntry(element, material));
  }
  return entries;
}

void readValueOrSoil(Object& pair, PairTable::Entry& entry) {
  const auto value = pair.find("value"), soil = pair.find("soil");
  if (value.has_value() == soil.has_value()) {
    pair.refuse("exactly one of \"value\" and \"soil\" must be given");
  } else if (value) {
    entry.value = readSpan(*value, kShare);
  } else {
    const SoilClass& known = readSoil(*soil);
    entry.value = known.restitution;
    entry.soil = known.name;
  }
}

}  // namespace

EffectOptions readFriction(Object& object, const Materials& materials) {
  return FrictionOptions{readPairTable(object, materials, "default", "value", kFriction)};
}

EffectOptions readRollingResistance(Object& object, const Materials& materials) {
  const PairTable levers = readPairTable(object, materials, "default_m", "value_m", kLever);
  return RollingResistanceOptions{levers, object.numberOr("spinning_default_m", kLever, 0)};
}

EffectOptions readRestitution(Object& object, const Materials& materials) {
  static constexpr std::array<std::string_view, 3> kLaws{"constant", "pfeiffer", "bourrier"};
  RestitutionOptions options;
  options.law = static_cast<RestitutionLaw>(object.at("law").choice(kLaws, "law of restitution"));
  if (options.law == RestitutionLaw::bourrier) {
    options.value =
        readPairTable(object, materials, "default_half_speed_m_per_s", "half_speed_m_per_s", between(0, 1000));
    return options;
  }
  if (options.law == RestitutionLaw::constant) {
    options.value = readPairTable(object, materials, "default", "value", kShare);
    return options;
  }
  options.value = readPairTable(object, materials, "default", kShare, readValueOrSoil);
  options.halfSpeedMPerS = object.numberOr("half_speed_m_per_s", kSpeed, options.halfSpeedMPerS);
  return options;
}

EffectOptions readTangentialRestitution(Object& object, const Materials& materials) {
  return TangentialRestitutionOptions{readPairTable(object, materials, "default", "value", kShare)};
}

EffectOptions readSlipFriction(Object& object, const Materials& materials) {
  SlipFrictionOptions options;
  options.min = object.at("min").number(kFriction);
  const Value max = object.at("max");
  options.max = max.number(kFriction);
  if (options.max < options.min) max.refuse("\"max\" must not be below \"min\"");
  options.kappaPerM = object.at("kappa_per_m").number(between(0, 1e6));
  options.recoveryPerS = object.at("recovery_per_s").number(between(0, 1e6));
  if (const auto pairs = object.find("pairs"))
    for (const Value& item : pairs->items(1, kMaxEntries)) options.pairs.push_back(readPair(item, materials));
  return options;
}

EffectOptions readSurfaceRoughness(Object& object, const Materials& materials) {
  using Entry = SurfaceRoughnessOptions::Entry;
  return SurfaceRoughnessOptions{readByMaterial<Entry>(object, materials, [](Object& entry, MaterialId material) {
    return Entry{material, entry.at("roughness_m").number(between(0, 10))};
  })};
}

EffectOptions readSoilScarring(Object& object, const Materials& materials) {
  using Entry = SoilScarringOptions::Entry;
  return SoilScarringOptions{readByMaterial<Entry>(object, materials, [](Object& entry, MaterialId material) {
    const double strength = entry.at("strength_kpa").number({0, 1e6, true});
    const double density = entry.at("density_kg_per_m3").number(between(0, 20000));
    return Entry{material, strength, density, entry.at("drag_coefficient").number(between(0, 100))};
  })};
}

}  // namespace cairn::rockfall

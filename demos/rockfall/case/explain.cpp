// SPDX-License-Identifier: GPL-3.0-or-later
#include "rockfall/case/explain.h"

#include <fmt/format.h>

#include <algorithm>

#include "rockfall/case/soil_classes.h"

namespace cairn::rockfall {
namespace {

/// Determines the outlook of one effect after the other.
class Outlooks {
 public:
  Outlooks(const Case& scene, const SceneBounds& bounds) : scene_(scene), bounds_(bounds) {}

  EffectOutlook of(std::size_t index) {
    outlook_ = {index, std::string(nameOf(scene_.effects[index])), {}, {}, {}};
    std::visit([&](const auto& options) { judge(options); }, scene_.effects[index]);
    return outlook_;
  }

 private:
  std::uint32_t groupCount() const { return static_cast<std::uint32_t>(bounds_.groups.size()); }

  /// Returns the groups for which `meets` holds. `reason` states the bound in either case.
  template <class Meets>
  void groupsThat(const Meets& meets, std::string reason) {
    for (std::uint32_t group = 0; group < groupCount(); ++group)
      if (meets(group)) outlook_.groups.push_back(group);
    outlook_.reason = std::move(reason);
  }
  /// Decides by what a rock of a group reaches at a speed: that of its own fall or, with advice, after being struck.
  template <class Reaches>
  void speedsThat(const Reaches& reaches, std::string reason) {
    const auto meets = [&](double GroupBounds::*speed) {
      return [&, speed](std::uint32_t g) { return reaches(bounds_.groups[g], bounds_.groups[g].*speed); };
    };
    groupsThat(meets(&GroupBounds::struckSpeedMPerS), std::move(reason));
    if (std::ranges::none_of(outlook_.groups, meets(&GroupBounds::greatestSpeedMPerS)) && !outlook_.groups.empty())
      outlook_.advice = "only a rock that others strike may be fast enough: without such rocks it can never act";
  }
  void all(bool possible, std::string reason) {
    groupsThat([&](std::uint32_t) { return possible; }, std::move(reason));
  }

  /// The materials that a rock of the group can touch: the ground's and those of all rocks but the rock itself.
  std::vector<MaterialId> partnersOf(std::uint32_t group) const {
    std::vector<MaterialId> partners = bounds_.groundMaterials;
    if (!scene_.rocks[group].meetsRocks) return partners;
    for (std::uint32_t other = 0; other < groupCount(); ++other)
      if (scene_.rocks[other].meetsRocks && (other != group || scene_.rocks[group].count > 1))
        partners.push_back(scene_.rocks[other].material);
    return partners;
  }
  template <class Suits>
  bool anyPair(std::uint32_t group, const Suits& suits) const {
    const MaterialId own = scene_.rocks[group].material;
    return std::ranges::any_of(partnersOf(group), [&](MaterialId other) { return suits(own, other); });
  }
  /// Decides by the values of the pairs that can meet.
  template <class Suits>
  void pairsThat(const PairTable& table, const Suits& suits, std::string reason) {
    groupsThat(
        [&](std::uint32_t group) {
          return anyPair(group, [&](MaterialId a, MaterialId b) { return suits(table.at(a, b)); });
        },
        std::move(reason));
  }
  bool isOnGround(MaterialId material) const {
    return std::ranges::find(bounds_.groundMaterials, material) != bounds_.groundMaterials.end();
  }
  template <class Entries, class Suits>
  void groundMaterialsThat(const Entries& entries, const Suits& suits, const char* what) {
    const bool some =
        std::ranges::any_of(entries, [&](const auto& entry) { return isOnGround(entry.material) && suits(entry); });
    all(some, fmt::format("a listed material that the ground has, with {}", what));
  }

  static constexpr auto kAboveZero = [](const Span& value) { return value.high > 0; };

  void judge(const FrictionOptions& o) {
    pairsThat(o.coefficient, kAboveZero, "coefficients above 0 of materials that can meet");
  }
  void judge(const RollingResistanceOptions& o) {
    if (o.spinningLeverM > 0) return all(true, "the lever against spinning is above 0");
    pairsThat(o.leverM, kAboveZero, "levers above 0 of materials that can meet");
    if (!outlook_.groups.empty())
      outlook_.advice =
          "rocks that it holds up on one corner may spin there for ever: give \"spinning_default_m\" too, say a fifth "
          "of the lever";
  }
  void judge(const RestitutionOptions& o) {
    pairsThat(o.value, kAboveZero, "values above 0 of materials that can meet");
  }
  void judge(const TangentialRestitutionOptions& o) {
    pairsThat(
        o.coefficient, [](const Span& value) { return value.low < 1; }, "values below 1 of materials that can meet");
  }
  void judge(const SlipFrictionOptions& o) {
    groupsThat(
        [&](std::uint32_t group) {
          return o.max > 0 && anyPair(group, [&](MaterialId a, MaterialId b) {
                   return o.pairs.empty() || std::ranges::find(o.pairs, pairOf(a, b)) != o.pairs.end();
                 });
        },
        "listed pairs of materials that can meet, and a friction above 0");
  }
  void judge(const SurfaceRoughnessOptions& o) {
    groundMaterialsThat(
        o.entries, [](const auto& entry) { return entry.roughnessM > 0; }, "roughness above 0");
  }
  void judge(const SoilScarringOptions& o) {
    groundMaterialsThat(
        o.entries, [](const auto& entry) { return entry.densityKgPerM3 > 0 && entry.dragCoefficient > 0; },
        "density and drag above 0");
  }
  void judge(const GyroscopicOptions& o) {
    groupsThat([&](std::uint32_t g) { return bounds_.groups[g].greatestInertiaRatio >= o.minInertiaRatio; },
               fmt::format("an inertia ratio of at least {:g}", o.minInertiaRatio));
  }
  void judge(const CcdOptions& o) {
    speedsThat([&](const GroupBounds& group,
                   double speed) { return speed * scene_.stepS > o.radiiPerStep * group.smallestRadiusM; },
               fmt::format("more than {:g} radii in a step of {:g} s", o.radiiPerStep, scene_.stepS));
  }
  void judge(const SleepingOptions& o) {
    all(o.linearMPerS > 0 && o.angularRadPerS > 0, "speeds below both thresholds");
  }
  void judge(const AirDragOptions& o) {
    all(o.densityKgPerM3 > 0 && o.coefficient > 0, "density and coefficient above 0");
  }
  void judge(const WaterOptions& o) {
    const auto lowest = bounds_.lowestGround(o.polygon);
    if (!lowest) return all(false, "a region over the ground");
    all(*lowest < o.levelM && o.densityKgPerM3 > 0,
        fmt::format("ground below the level of {:g} m: the lowest there is at {:.4g} m", o.levelM, *lowest));
  }
  void judge(const ForestDragOptions& o) {
    all(bounds_.lowestGround(o.polygon) && o.heightM > 0 && o.coefficientKgPerS > 0,
        "a region over the ground, height and coefficient above 0");
  }
  void judge(const TreesOptions& o) {
    bool some = false;
    if (const auto* stand = std::get_if<StandOfTrees>(&o.stems))
      some = stand->densityPerHa > 0 && bounds_.lowestGround(stand->polygon);
    else if (const auto* stems = std::get_if<std::vector<Stem>>(&o.stems))
      for (const Stem& stem : *stems) {
        if (some) break;
        const auto [x, y] = stem.placeM;
        const double r = stem.diameterM / 2;
        some |= bounds_.lowestGround({{x - r, y - r}, {x + r, y - r}, {x + r, y + r}, {x - r, y + r}}).has_value();
      }
    all(some && o.energyRatio > 0, "stems over the ground and an energy ratio above 0");
  }
  void judge(const BarrierOptions& o) {
    all(o.heightM > 0 && o.capacityJ > 0, "height and capacity above 0");
    const bool putsToRest = findEffect<SleepingOptions>(scene_.effects) != nullptr;
    if (!outlook_.groups.empty() && !putsToRest)
      outlook_.advice = "rocks that it catches stay awake until the time is over: list \"sleeping\" too";
  }
  void judge(const GroundDragOptions& o) {
    all(o.belowMPerS > 0 && o.withinM > 0 && o.decelerationMPerS2 > 0, "speed, layer and deceleration above 0");
  }
  void judge(const FragmentationOptions& o) {
    speedsThat([&](const GroupBounds&, double speed) { return speed * speed / 2 >= o.energyJPerKg; },
               fmt::format("an energy of {:g} J/kg", o.energyJPerKg));
  }
  void judge(const EventsOptions& o) {
    double least = o.dustImpulseNS > 0 ? o.dustImpulseNS : o.soundImpulseNS;
    if (o.soundImpulseNS > 0) least = std::min(least, o.soundImpulseNS);
    // A head-on impact of two equal rocks without loss of energy reverses both speeds.
    speedsThat([&](const GroupBounds& group, double speed) { return 2 * group.greatestMassKg * speed >= least; },
               fmt::format("an impulse of {:g} N s", least));
  }

  const Case& scene_;
  const SceneBounds& bounds_;
  EffectOutlook outlook_;
};

}  // namespace

std::vector<SoilNote> explainSoils(const Case& scene) {
  std::vector<SoilNote> notes;
  for (std::size_t i = 0; i < scene.effects.size(); ++i) {
    const auto* restitution = std::get_if<RestitutionOptions>(&scene.effects[i]);
    if (restitution == nullptr) continue;
    const auto& entries = restitution->value.entries;
    for (std::size_t pair = 0; pair < entries.size(); ++pair)
      for (const SoilClass& soil : soilClasses())
        if (soil.name == entries[pair].soil)
          notes.push_back({fmt::format("/effects/{}/pairs/{}", i, pair),
                           fmt::format("{} is {}: {:g} to {:g}, drawn by each run ({})", soil.name, soil.description,
                                       soil.restitution.low, soil.restitution.high, kSoilSource)});
  }
  return notes;
}

std::vector<EffectOutlook> explainEffects(const Case& scene, const SceneBounds& bounds) {
  Outlooks outlooks(scene, bounds);
  std::vector<EffectOutlook> all;
  for (std::size_t i = 0; i < scene.effects.size(); ++i) all.push_back(outlooks.of(i));
  return all;
}

}  // namespace cairn::rockfall

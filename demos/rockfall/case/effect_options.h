// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "rockfall/case/map_source.h"
#include "rockfall/case/materials.h"
#include "rockfall/case/plane_geometry.h"

namespace cairn::rockfall {

// The options of each effect in a case file: plain data, with units in the names. `kName` is the effect's name in the
// file. The effects themselves document their laws.

struct FrictionOptions {
  static constexpr std::string_view kName = "friction";
  PairTable coefficient;
};

struct RollingResistanceOptions {
  static constexpr std::string_view kName = "rolling_resistance";
  PairTable leverM;           ///< torque against rolling per normal force
  double spinningLeverM = 0;  ///< the same lever against spin about the normal, for all materials
};

enum class RestitutionLaw : std::uint8_t { constant, pfeiffer, bourrier };
struct RestitutionOptions {
  static constexpr std::string_view kName = "restitution";
  RestitutionLaw law = RestitutionLaw::constant;
  PairTable value;                ///< the coefficient; for bourrier the speed at which it is one half, m/s
  double halfSpeedMPerS = 9.144;  ///< pfeiffer: speed at which half of the coefficient remains
};

struct TangentialRestitutionOptions {
  static constexpr std::string_view kName = "tangential_restitution";
  PairTable coefficient;
};

struct SlipFrictionOptions {
  static constexpr std::string_view kName = "slip_friction";
  double min = 0, max = 0;
  double kappaPerM = 0, recoveryPerS = 0;
  std::vector<MaterialPair> pairs;  ///< pairs with this effect; empty: all
};

struct SurfaceRoughnessOptions {
  static constexpr std::string_view kName = "surface_roughness";
  struct Entry {
    MaterialId material;
    double roughnessM;
  };
  std::vector<Entry> entries;
};

struct GyroscopicOptions {
  static constexpr std::string_view kName = "gyroscopic";
  double minInertiaRatio = 1.05;  ///< greatest principal moment divided by the least
};

struct CcdOptions {
  static constexpr std::string_view kName = "ccd";
  double radiiPerStep = 0.5;
};

struct SleepingOptions {
  static constexpr std::string_view kName = "sleeping";
  double linearMPerS = 0, angularRadPerS = 0, afterS = 0;
};

struct AirDragOptions {
  static constexpr std::string_view kName = "air_drag";
  double densityKgPerM3 = 1.2, coefficient = 0.5;
};

struct WaterOptions {
  static constexpr std::string_view kName = "water";
  double levelM = 0, densityKgPerM3 = 1000, coefficient = 0.5;
  Polygon polygon;
};

struct ForestDragOptions {
  static constexpr std::string_view kName = "forest_drag";
  double heightM = 0, coefficientKgPerS = 0;
  Polygon polygon;
};

struct Stem {
  MapPoint placeM;
  double diameterM;
  double heightM = 0;  ///< 0: the usual one
};
struct StandOfTrees {
  double densityPerHa = 0;
  std::array<double, 2> diameterM{};  ///< least and greatest; uniformly distributed
  std::array<double, 2> heightM{};    ///< likewise; 0: the usual one
  Polygon polygon;
};
/// Trees of a map: single ones, or stands by their classes.
struct MappedTrees {
  MapSource map;
  std::string diameterField;  ///< of points, metres; empty: stands
  ClassTable<StandOfTrees> stands;
};
struct TreesOptions {
  static constexpr std::string_view kName = "trees";
  double energyRatio = 1;  ///< energy that a stem can absorb, divided by that of the measured stems
  /// Of a map there are stems once it is read.
  std::variant<std::vector<Stem>, StandOfTrees, MappedTrees> stems;
};

struct BarrierOptions {
  static constexpr std::string_view kName = "barrier";
  std::vector<Polyline> lines;
  std::optional<MapSource> map;  ///< of the lines; they are there once it is read
  double heightM = 0, capacityJ = 0;
};

struct SoilScarringOptions {
  static constexpr std::string_view kName = "soil_scarring";
  struct Entry {
    MaterialId material;
    double strengthKpa, densityKgPerM3, dragCoefficient;
  };
  std::vector<Entry> entries;
};

struct GroundDragOptions {
  static constexpr std::string_view kName = "ground_drag";
  double belowMPerS = 5, withinM = 1, decelerationMPerS2 = 0;
};

struct FragmentationOptions {
  static constexpr std::string_view kName = "fragmentation";
  double energyJPerKg = 0;
  std::uint32_t maxGenerations = 1;
};

struct EventsOptions {
  static constexpr std::string_view kName = "events";
  double dustImpulseNS = 0, soundImpulseNS = 0;  ///< 0: no events of this kind
};

using EffectOptions =
    std::variant<FrictionOptions, RollingResistanceOptions, RestitutionOptions, TangentialRestitutionOptions,
                 SlipFrictionOptions, SurfaceRoughnessOptions, GyroscopicOptions, CcdOptions, SleepingOptions,
                 AirDragOptions, WaterOptions, ForestDragOptions, TreesOptions, BarrierOptions, SoilScarringOptions,
                 GroundDragOptions, FragmentationOptions, EventsOptions>;

std::string_view nameOf(const EffectOptions& effect);

/// Returns the listed effect of a kind, or null. For effects that may be listed several times (water, forest_drag,
/// trees, barrier), returns the first.
template <class Options>
const Options* findEffect(const std::vector<EffectOptions>& effects) {
  for (const EffectOptions& effect : effects)
    if (const auto* found = std::get_if<Options>(&effect)) return found;
  return nullptr;
}

}  // namespace cairn::rockfall

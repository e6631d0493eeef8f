// SPDX-License-Identifier: GPL-3.0-or-later
#include "rockfall/simulation/effect_factory.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <string_view>
#include <utility>

#include "cairn/core/mix_bits.h"
#include "cairn/core/state_hash.h"
#include "cairn/effects/air_drag.h"
#include "cairn/effects/barrier.h"
#include "cairn/effects/continuous_collision.h"
#include "cairn/effects/forest_drag.h"
#include "cairn/effects/fragmentation.h"
#include "cairn/effects/friction.h"
#include "cairn/effects/ground_drag.h"
#include "cairn/effects/gyroscopic.h"
#include "cairn/effects/impact_events.h"
#include "cairn/effects/restitution.h"
#include "cairn/effects/rolling_resistance.h"
#include "cairn/effects/single_trees.h"
#include "cairn/effects/sleeping.h"
#include "cairn/effects/slip_friction.h"
#include "cairn/effects/soil_scarring.h"
#include "cairn/effects/surface_roughness.h"
#include "cairn/effects/tangential_restitution.h"
#include "cairn/effects/water.h"
#include "rockfall/case/draw_stem.h"
#include "rockfall/simulation/run_seed.h"
#include "scenes/figures/random.h"

namespace cairn::rockfall {
namespace {

btScalar scalar(double value) {
  return static_cast<btScalar>(value);
}
effects::MaterialId material(MaterialId id) {
  return static_cast<effects::MaterialId>(id);
}

effects::Region regionOf(const Polygon& polygon) {
  if (polygon.empty()) return {};
  std::vector<effects::Region::Point> corners;
  for (const MapPoint& corner : polygon) corners.push_back({scalar(corner[0]), scalar(corner[1])});
  return effects::Region(std::move(corners));
}

/// The area of the stand over the ground, except at its polygon's corners.
std::array<MapPoint, 2> boxOf(const StandOfTrees& stand, const Ground& ground) {
  MapPoint low{ground.lower().x, ground.lower().y}, high{ground.upper().x, ground.upper().y};
  for (std::size_t axis = 0; axis < 2 && !stand.polygon.empty(); ++axis) {
    const auto [least, greatest] = std::ranges::minmax(stand.polygon, {}, [&](const MapPoint& p) { return p[axis]; });
    low[axis] = std::max(low[axis], least[axis]);
    high[axis] = std::min(high[axis], greatest[axis]);
  }
  return {low, high};
}

/// In that box.
double stemCount(const StandOfTrees& stand, const Ground& ground) {
  constexpr double kSquareMetresPerHa = 1e4;
  const auto [low, high] = boxOf(stand, ground);
  return stand.densityPerHa * std::max(0.0, high[0] - low[0]) * std::max(0.0, high[1] - low[1]) / kSquareMetresPerHa;
}

/// A listed effect as one of the library's, by its options.
class Factory {
 public:
  Factory(const Scene& scene, std::size_t place, std::uint64_t run, const effects::GroundHeight& ground)
      : scene_(scene), place_(place), run_(run), ground_(ground) {}

  using Made = std::unique_ptr<effects::Effect>;

  Made operator()(const FrictionOptions& o) const {
    return std::make_unique<effects::Friction>(tableOf(o.coefficient));
  }
  Made operator()(const RollingResistanceOptions& o) const {
    using Lengths = effects::RollingResistance::Lengths;
    const btScalar spinning = scalar(o.spinningLeverM);
    effects::PairTable<Lengths> lengths({drawn(o.leverM.otherwise), spinning});
    for (const PairTable::Entry& entry : o.leverM.entries)
      lengths.set(material(entry.pair.first), material(entry.pair.second), {drawn(entry), spinning});
    return std::make_unique<effects::RollingResistance>(std::move(lengths));
  }
  Made operator()(const RestitutionOptions& o) const {
    effects::restitution::Law law = effects::restitution::Constant{};
    if (o.law == RestitutionLaw::pfeiffer) law = effects::restitution::Pfeiffer{scalar(o.halfSpeedMPerS)};
    if (o.law == RestitutionLaw::bourrier) law = effects::restitution::Bourrier{};
    return std::make_unique<effects::Restitution>(tableOf(o.value), law);
  }
  Made operator()(const TangentialRestitutionOptions& o) const {
    return std::make_unique<effects::TangentialRestitution>(tableOf(o.coefficient));
  }
  Made operator()(const SlipFrictionOptions& o) const {
    effects::PairTable<bool> applies(o.pairs.empty());
    for (const auto& [a, b] : o.pairs) applies.set(material(a), material(b), true);
    const effects::SlipFriction::Options options{.least = scalar(o.min),
                                                 .most = scalar(o.max),
                                                 .kappa = scalar(o.kappaPerM),
                                                 .recovery = scalar(o.recoveryPerS)};
    return std::make_unique<effects::SlipFriction>(options, std::move(applies));
  }
  Made operator()(const SurfaceRoughnessOptions& o) const {
    std::vector<btScalar> heights(scene_.description.materials.size());
    for (const auto& entry : o.entries) heights[entry.material] = scalar(entry.roughnessM);
    return std::make_unique<effects::SurfaceRoughness>(std::move(heights), seed(run_));
  }
  Made operator()(const GyroscopicOptions& o) const {
    return std::make_unique<effects::Gyroscopic>(effects::Gyroscopic::Options{scalar(o.minInertiaRatio)});
  }
  Made operator()(const CcdOptions& o) const {
    return std::make_unique<effects::ContinuousCollision>(
        effects::ContinuousCollision::Options{scalar(o.radiiPerStep)});
  }
  Made operator()(const SleepingOptions& o) const {
    return std::make_unique<effects::Sleeping>(
        effects::Sleeping::Options{scalar(o.linearMPerS), scalar(o.angularRadPerS), scalar(o.afterS)});
  }
  Made operator()(const AirDragOptions& o) const {
    return std::make_unique<effects::AirDrag>(
        effects::AirDrag::Options{.density = scalar(o.densityKgPerM3), .coefficient = scalar(o.coefficient)});
  }
  Made operator()(const WaterOptions& o) const {
    return std::make_unique<effects::Water>(effects::Water::Options{scalar(o.levelM), scalar(o.densityKgPerM3),
                                                                    scalar(o.coefficient), regionOf(o.polygon)});
  }
  Made operator()(const ForestDragOptions& o) const {
    return std::make_unique<effects::ForestDrag>(
        effects::ForestDrag::Options{scalar(o.heightM), scalar(o.coefficientKgPerS), regionOf(o.polygon)}, ground_);
  }
  Made operator()(const TreesOptions& o) const {
    std::vector<effects::SingleTrees::Stem> stems;
    if (const auto* stand = std::get_if<StandOfTrees>(&o.stems))
      stems = stemsOf(*stand);
    else if (const auto* single = std::get_if<std::vector<Stem>>(&o.stems))
      for (const Stem& stem : *single)
        stems.push_back({scalar(stem.placeM[0]), scalar(stem.placeM[1]), scalar(stem.diameterM), scalar(stem.heightM)});
    return std::make_unique<effects::SingleTrees>(std::move(stems), ground_,
                                                  effects::SingleTrees::Options{.energyRatio = scalar(o.energyRatio)});
  }
  Made operator()(const BarrierOptions& o) const {
    const auto post = [](const MapPoint& point) { return effects::Barrier::Point{scalar(point[0]), scalar(point[1])}; };
    std::vector<effects::Barrier::Segment> segments;
    for (const Polyline& line : o.lines)
      for (std::size_t i = 1; i < line.size(); ++i) segments.push_back({post(line[i - 1]), post(line[i])});
    const effects::Barrier::Options options{scalar(o.heightM), scalar(o.capacityJ)};
    return std::make_unique<effects::Barrier>(std::move(segments), ground_, options);
  }
  Made operator()(const SoilScarringOptions& o) const {
    std::vector<effects::SoilScarring::Soil> soils(scene_.description.materials.size());
    for (const auto& entry : o.entries)
      soils[entry.material] = {scalar(entry.strengthKpa), scalar(entry.densityKgPerM3), scalar(entry.dragCoefficient)};
    return std::make_unique<effects::SoilScarring>(std::move(soils));
  }
  Made operator()(const GroundDragOptions& o) const {
    return std::make_unique<effects::GroundDrag>(
        effects::GroundDrag::Options{scalar(o.belowMPerS), scalar(o.withinM), scalar(o.decelerationMPerS2)}, ground_);
  }
  Made operator()(const FragmentationOptions& o) const {
    return std::make_unique<effects::Fragmentation>(
        effects::Fragmentation::Options{scalar(o.energyJPerKg), o.maxGenerations});
  }
  Made operator()(const EventsOptions& o) const {
    const auto threshold = [](double impulse) {
      return impulse > 0 ? scalar(impulse) : std::numeric_limits<btScalar>::infinity();
    };
    return std::make_unique<effects::ImpactEvents>(effects::ImpactEvents::Options{
        .dustImpulse = threshold(o.dustImpulseNS), .soundImpulse = threshold(o.soundImpulseNS)});
  }

 private:
  /// The run's own value of a span; each pair of materials has a stream of random numbers, and the default has one.
  btScalar drawn(const Span& span, std::uint64_t stream = 0) const {
    if (span.low == span.high) return scalar(span.low);
    return scalar(scenes::Random(seed(run_, Variable::parameters), stream).uniform(span.low, span.high));
  }
  btScalar drawn(const PairTable::Entry& entry) const {
    constexpr std::uint64_t kMaxMaterials = 65536;
    return drawn(entry.value, 1 + entry.pair.first * kMaxMaterials + entry.pair.second);
  }
  effects::PairTable<btScalar> tableOf(const PairTable& table) const {
    effects::PairTable<btScalar> result(drawn(table.otherwise));
    for (const PairTable::Entry& entry : table.entries)
      result.set(material(entry.pair.first), material(entry.pair.second), drawn(entry));
    return result;
  }

  // By the effect's name and its number among those of its kind, so that the order of the list has no influence.
  std::uint64_t seed(std::uint64_t run, Variable variable = Variable::effects) const {
    const auto& effects = scene_.description.effects;
    const std::string_view name = nameOf(effects[place_]);
    const auto number = std::count_if(effects.begin(), effects.begin() + static_cast<std::ptrdiff_t>(place_),
                                      [&](const EffectOptions& other) { return nameOf(other) == name; });
    StateHash ofKind;
    ofKind.add(std::as_bytes(std::span(name.data(), name.size())));
    const std::uint64_t ofRun = seedOf(scene_.description.seed, scene_.description.name, run, variable);
    return mixBits(ofRun + ofKind.value()) + static_cast<std::uint64_t>(number);
  }

  // Spread evenly over the stand, or over all of the ground. The same in every run: a forest belongs to the scene.
  std::vector<effects::SingleTrees::Stem> stemsOf(const StandOfTrees& stand) const {
    const auto [low, high] = boxOf(stand, *scene_.ground);
    const auto count = static_cast<std::uint64_t>(std::llround(stemCount(stand, *scene_.ground)));
    scenes::Random random(seed(0));
    std::vector<effects::SingleTrees::Stem> stems;
    for (std::uint64_t i = 0; i < count; ++i) {
      const MapPoint place{random.uniform(low[0], high[0]), random.uniform(low[1], high[1])};
      const Stem stem = drawStem(stand, place, random);
      if (!contains(stand.polygon, place)) continue;
      stems.push_back({scalar(place[0]), scalar(place[1]), scalar(stem.diameterM), scalar(stem.heightM)});
    }
    return stems;
  }

  const Scene& scene_;
  std::size_t place_;
  std::uint64_t run_;
  const effects::GroundHeight& ground_;
};

}  // namespace

std::unique_ptr<effects::Effect> makeEffect(const Scene& scene, std::size_t place, std::uint64_t run,
                                            const effects::GroundHeight& ground) {
  return std::visit(Factory(scene, place, run, ground), scene.description.effects[place]);
}

Status checkStands(const Case& description, const Ground& ground) {
  constexpr double kMaxStems = 2e6;
  for (std::size_t i = 0; i < description.effects.size(); ++i) {
    const auto* trees = std::get_if<TreesOptions>(&description.effects[i]);
    const auto* stand = trees != nullptr ? std::get_if<StandOfTrees>(&trees->stems) : nullptr;
    if (stand == nullptr || stemCount(*stand, ground) <= kMaxStems) continue;
    return Error{
        fmt::format("/effects/{}/stems: there would be {:.3g} million stems, more than {:.0f} million: use a "
                    "smaller density or polygon, or forest_drag",
                    i, stemCount(*stand, ground) / 1e6, kMaxStems / 1e6)};
  }
  return {};
}

}  // namespace cairn::rockfall

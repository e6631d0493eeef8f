// SPDX-License-Identifier: Zlib
#include "every_effect.h"

#include "cairn/effects/air_drag.h"
#include "cairn/effects/barrier.h"
#include "cairn/effects/continuous_collision.h"
#include "cairn/effects/forest_drag.h"
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

namespace cairn::test {
namespace {

using namespace effects;

const Incline kIncline;
constexpr btScalar kFar = btScalar(1e6);

template <class EffectType, class... Arguments>
EffectRow::Make make(Arguments... arguments) {
  return [=] { return std::make_unique<EffectType>(arguments...); };
}

template <class Value>
PairTable<Value> onlyNowhere(Value value) {
  PairTable<Value> table;
  table.set(kNowhere, kNowhere, value);
  return table;
}

template <class Value>
std::vector<Value> byMaterial(MaterialId material, Value value) {
  std::vector<Value> values(std::size_t(material) + 1);
  values[material] = value;
  return values;
}

std::vector<EffectRow> contactEffects() {
  using Lengths = RollingResistance::Lengths;
  const restitution::Law law = restitution::Constant{};
  return {
      {"friction", make<Friction>(PairTable<btScalar>(btScalar(0.4))), make<Friction>(PairTable<btScalar>()), nullptr},
      {"rolling_resistance", make<RollingResistance>(PairTable<Lengths>({btScalar(0.05), btScalar(0.01)})),
       make<RollingResistance>(PairTable<Lengths>()), make<RollingResistance>(onlyNowhere(Lengths{1, 1}))},
      {"restitution", make<Restitution>(PairTable<btScalar>(btScalar(0.5)), law),
       make<Restitution>(PairTable<btScalar>(), law), nullptr},
      {"tangential_restitution", make<TangentialRestitution>(PairTable<btScalar>(btScalar(0.5))),
       make<TangentialRestitution>(PairTable<btScalar>(1)), nullptr},
      {"slip_friction", make<SlipFriction>(SlipFriction::Options{}, PairTable<bool>(true)),
       make<SlipFriction>(SlipFriction::Options{.least = 0, .most = 0}, PairTable<bool>(true)),
       make<SlipFriction>(SlipFriction::Options{}, onlyNowhere(true))},
      {"surface_roughness", make<SurfaceRoughness>(byMaterial(kSoil, btScalar(0.2)), 1),
       make<SurfaceRoughness>(byMaterial(kSoil, btScalar(0)), 1),
       make<SurfaceRoughness>(byMaterial(kNowhere, btScalar(1)), 1)},
  };
}

std::vector<EffectRow> mediumEffects() {
  // make_unique takes a reference to the ground, which lambdas would copy.
  const auto forest = [](ForestDrag::Options options) -> EffectRow::Make {
    return [options] { return std::make_unique<ForestDrag>(options, kIncline); };
  };
  const auto ground = [](GroundDrag::Options options) -> EffectRow::Make {
    return [options] { return std::make_unique<GroundDrag>(options, kIncline); };
  };
  const auto trees = [](btScalar away, btScalar ratio) -> EffectRow::Make {
    std::vector<SingleTrees::Stem> stems;
    for (int i = 0; i < 30; ++i)
      stems.push_back({away - btScalar(0.5) * btScalar(i), btScalar(2 * (i % 7) - 8), btScalar(0.2)});
    return [=] { return std::make_unique<SingleTrees>(stems, kIncline, SingleTrees::Options{20, ratio}); };
  };
  const auto barrier = [](btScalar away, btScalar capacity) -> EffectRow::Make {
    const std::vector<Barrier::Segment> segments{{{away, -50}, {away, 50}}};
    return [=] { return std::make_unique<Barrier>(segments, kIncline, Barrier::Options{20, capacity}); };
  };
  const Region elsewhere({{kFar, 0}, {2 * kFar, 0}, {2 * kFar, 1}});
  return {
      {"air_drag", make<AirDrag>(AirDrag::Options{}), make<AirDrag>(AirDrag::Options{.density = 0}),
       make<AirDrag>(AirDrag::Options{.leastSpeed = kFar})},
      {.name = "water",
       .active = make<Water>(Water::Options{.level = 1}),
       .zero = make<Water>(Water::Options{.level = 1, .density = 0}),
       .idle = make<Water>(Water::Options{.level = -kFar}),
       .dissipates = false},
      {"forest_drag", forest({.height = 5, .coefficient = 1}), forest({.height = 5, .coefficient = 0}),
       forest({.height = 5, .coefficient = 1, .region = elsewhere})},
      {"trees", trees(-1, btScalar(1e-4)), trees(-1, 0), trees(-kFar, 1)},
      {"barrier", barrier(-3, 1), barrier(-3, 0), barrier(-kFar, 1)},
      {"ground_drag", ground({.deceleration = 2}), ground({.deceleration = 0}),
       ground({.within = -kFar, .deceleration = 2})},
  };
}

std::vector<EffectRow> otherEffects() {
  using Soil = SoilScarring::Soil;
  const Soil meadow{.strength = 600, .density = 1800, .drag = btScalar(0.01)};
  Soil none = meadow;
  none.strength = 0;
  return {
      {"gyroscopic", make<Gyroscopic>(Gyroscopic::Options{}), make<Gyroscopic>(Gyroscopic::Options{kFar}),
       make<Gyroscopic>(Gyroscopic::Options{kFar})},
      {"ccd", make<ContinuousCollision>(ContinuousCollision::Options{}),
       make<ContinuousCollision>(ContinuousCollision::Options{0}),
       make<ContinuousCollision>(ContinuousCollision::Options{kFar})},
      {"sleeping", make<Sleeping>(Sleeping::Options{btScalar(0.3), btScalar(0.3), btScalar(0.2)}),
       make<Sleeping>(Sleeping::Options{0, 0, btScalar(0.2)}), make<Sleeping>(Sleeping::Options{.after = kFar})},
      {"soil_scarring", make<SoilScarring>(byMaterial(kSoil, meadow)), make<SoilScarring>(byMaterial(kSoil, none)),
       make<SoilScarring>(byMaterial(kNowhere, meadow))},
      {.name = "events",
       .active = make<ImpactEvents>(ImpactEvents::Options{.dustImpulse = 0, .soundImpulse = 0}),
       .zero = make<ImpactEvents>(ImpactEvents::Options{}),
       .idle = make<ImpactEvents>(ImpactEvents::Options{.dustImpulse = kFar, .soundImpulse = kFar}),
       .changesMotion = false},
  };
}

}  // namespace

std::vector<EffectRow> everyEffect() {
  std::vector<EffectRow> rows;
  for (const auto& some : {contactEffects(), mediumEffects(), otherEffects()})
    rows.insert(rows.end(), some.begin(), some.end());
  return rows;
}

}  // namespace cairn::test

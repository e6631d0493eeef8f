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
// Bodies are below it, so that a layer of no height on it is tried.
const Incline kRaisedIncline(100);
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
      {"friction",
       make<Friction>(PairTable<btScalar>(btScalar(0.4))),
       {{"coefficient", make<Friction>(PairTable<btScalar>())}},
       nullptr},
      {"rolling_resistance",
       make<RollingResistance>(PairTable<Lengths>({btScalar(0.05), btScalar(0.01)})),
       {{"lengths", make<RollingResistance>(PairTable<Lengths>())}},
       make<RollingResistance>(onlyNowhere(Lengths{1, 1}))},
      {"restitution",
       make<Restitution>(PairTable<btScalar>(btScalar(0.5)), law),
       {{"value", make<Restitution>(PairTable<btScalar>(), law)}},
       nullptr},
      {"tangential_restitution",
       make<TangentialRestitution>(PairTable<btScalar>(btScalar(0.5))),
       {{"part", make<TangentialRestitution>(PairTable<btScalar>(1))}},
       nullptr},
      {"slip_friction",
       make<SlipFriction>(SlipFriction::Options{}, PairTable<bool>(true)),
       {{"most", make<SlipFriction>(SlipFriction::Options{.least = 0, .most = 0}, PairTable<bool>(true))},
        {"pairs", make<SlipFriction>(SlipFriction::Options{}, PairTable<bool>())}},
       make<SlipFriction>(SlipFriction::Options{}, onlyNowhere(true))},
      {"surface_roughness",
       make<SurfaceRoughness>(byMaterial(kSoil, btScalar(0.2)), 1),
       {{"height", make<SurfaceRoughness>(byMaterial(kSoil, btScalar(0)), 1)}},
       make<SurfaceRoughness>(byMaterial(kNowhere, btScalar(1)), 1)},
  };
}

std::vector<EffectRow> mediumEffects() {
  // make_unique takes a reference to the ground, which lambdas would copy.
  const auto forest = [](ForestDrag::Options options, const Incline& on = kIncline) -> EffectRow::Make {
    return [options, &on] { return std::make_unique<ForestDrag>(options, on); };
  };
  const auto ground = [](GroundDrag::Options options, const Incline& on = kIncline) -> EffectRow::Make {
    return [options, &on] { return std::make_unique<GroundDrag>(options, on); };
  };
  const auto trees = [](btScalar away, btScalar diameter, SingleTrees::Options options,
                        const Incline& on = kIncline) -> EffectRow::Make {
    std::vector<SingleTrees::Stem> stems;
    for (int i = 0; i < 30; ++i)
      stems.push_back({away - btScalar(0.5) * btScalar(i), btScalar(2 * (i % 7) - 8), diameter});
    return [=, &on] { return std::make_unique<SingleTrees>(stems, on, options); };
  };
  const auto barrier = [](btScalar away, btScalar length, Barrier::Options options,
                          const Incline& on = kIncline) -> EffectRow::Make {
    const std::vector<Barrier::Segment> segments{{{away, -length / 2}, {away, length / 2}}};
    return [=, &on] { return std::make_unique<Barrier>(segments, on, options); };
  };
  const btScalar thick = btScalar(0.2), weak = btScalar(1e-4);
  const Region elsewhere({{kFar, 0}, {2 * kFar, 0}, {2 * kFar, 1}});
  return {
      {"air_drag",
       make<AirDrag>(AirDrag::Options{}),
       {{"density", make<AirDrag>(AirDrag::Options{.density = 0})},
        {"coefficient", make<AirDrag>(AirDrag::Options{.coefficient = 0})}},
       make<AirDrag>(AirDrag::Options{.leastSpeed = kFar})},
      {.name = "water",
       .active = make<Water>(Water::Options{.level = 1}),
       .zeros = {{"density", make<Water>(Water::Options{.level = 1, .density = 0})}},
       .idle = make<Water>(Water::Options{.level = -kFar}),
       .dissipates = false},
      {"forest_drag",
       forest({.height = 5, .coefficient = 1}),
       {{"coefficient", forest({.height = 5, .coefficient = 0})},
        {"height", forest({.height = 0, .coefficient = 1}, kRaisedIncline)}},
       forest({.height = 5, .coefficient = 1, .region = elsewhere})},
      {"trees",
       trees(-1, thick, {20, weak}),
       {{"energy_ratio", trees(-1, thick, {20, 0})},
        {"height", trees(-1, thick, {0, weak}, kRaisedIncline)},
        {"diameter", trees(-1, 0, {20, weak})}},
       trees(-kFar, thick, {20, 1})},
      {"barrier",
       barrier(-3, 100, {20, 1}),
       {{"capacity", barrier(-3, 100, {20, 0})},
        {"height", barrier(-3, 100, {0, 1}, kRaisedIncline)},
        {"length", barrier(-3, 0, {20, 1})}},
       barrier(-kFar, 100, {20, 1})},
      {"ground_drag",
       ground({.deceleration = 2}),
       {{"deceleration", ground({.deceleration = 0})},
        {"within", ground({.within = 0, .deceleration = 2}, kRaisedIncline)},
        {"below", ground({.below = 0, .deceleration = 2})}},
       ground({.within = -kFar, .deceleration = 2})},
  };
}

std::vector<EffectRow> otherEffects() {
  using Soil = SoilScarring::Soil;
  const auto scarring = [](Soil soil) { return make<SoilScarring>(byMaterial(kSoil, soil)); };
  const Soil meadow{.strength = 600, .density = 1800, .drag = btScalar(0.01)};
  return {
      {"gyroscopic",
       make<Gyroscopic>(Gyroscopic::Options{}),
       {{"min_inertia_ratio", make<Gyroscopic>(Gyroscopic::Options{kFar})}},
       make<Gyroscopic>(Gyroscopic::Options{kFar})},
      {"ccd",
       make<ContinuousCollision>(ContinuousCollision::Options{}),
       {{"radii_per_step", make<ContinuousCollision>(ContinuousCollision::Options{0})}},
       make<ContinuousCollision>(ContinuousCollision::Options{kFar})},
      {"sleeping",
       make<Sleeping>(Sleeping::Options{btScalar(0.3), btScalar(0.3), btScalar(0.2)}),
       {{"linear", make<Sleeping>(Sleeping::Options{.linear = 0, .angular = kFar, .after = 0})},
        {"angular", make<Sleeping>(Sleeping::Options{.linear = kFar, .angular = 0, .after = 0})}},
       make<Sleeping>(Sleeping::Options{.after = kFar})},
      {"soil_scarring",
       scarring(meadow),
       {{"strength", scarring({.strength = 0, .density = meadow.density, .drag = meadow.drag})},
        {"density", scarring({.strength = meadow.strength, .density = 0, .drag = meadow.drag})},
        {"drag", scarring({.strength = meadow.strength, .density = meadow.density, .drag = 0})}},
       make<SoilScarring>(byMaterial(kNowhere, meadow))},
      {.name = "events",
       .active = make<ImpactEvents>(ImpactEvents::Options{.dustImpulse = 0, .soundImpulse = 0}),
       .zeros = {{"impulses", make<ImpactEvents>(ImpactEvents::Options{})}},
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

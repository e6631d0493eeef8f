// SPDX-License-Identifier: GPL-3.0-or-later
#include "rockfall/case/effects_section.h"

#include <fmt/format.h>

#include <array>

#include "rockfall/case/effect_readers.h"

namespace cairn::rockfall {
namespace {

struct Reader {
  std::string_view name;
  EffectOptions (*read)(Object&, const Materials&);
  bool ofAPlace = false;
};

template <class Options>
constexpr Reader readerOf(EffectOptions (*read)(Object&, const Materials&), bool ofAPlace = false) {
  return {Options::kName, read, ofAPlace};
}

constexpr std::array kReaders{
    readerOf<FrictionOptions>(readFriction),
    readerOf<RollingResistanceOptions>(readRollingResistance),
    readerOf<RestitutionOptions>(readRestitution),
    readerOf<TangentialRestitutionOptions>(readTangentialRestitution),
    readerOf<SlipFrictionOptions>(readSlipFriction),
    readerOf<SurfaceRoughnessOptions>(readSurfaceRoughness),
    readerOf<GyroscopicOptions>(readGyroscopic),
    readerOf<CcdOptions>(readCcd),
    readerOf<SleepingOptions>(readSleeping),
    readerOf<AirDragOptions>(readAirDrag),
    readerOf<WaterOptions>(readWater, true),
    readerOf<ForestDragOptions>(readForestDrag, true),
    readerOf<TreesOptions>(readTrees, true),
    readerOf<BarrierOptions>(readBarrier, true),
    readerOf<SoilScarringOptions>(readSoilScarring),
    readerOf<GroundDragOptions>(readGroundDrag),
    readerOf<FragmentationOptions>(readFragmentation),
    readerOf<EventsOptions>(readEvents),
};
static_assert(kReaders.size() == std::variant_size_v<EffectOptions>, "every effect has its reader");

constexpr std::size_t kMaxEffects = 1000;

}  // namespace

std::string_view nameOf(const EffectOptions& effect) {
  return std::visit([](const auto& options) { return options.kName; }, effect);
}

std::vector<EffectOptions> readEffects(const Value& value, const Materials& materials) {
  std::array<std::string_view, kReaders.size()> names;
  for (std::size_t i = 0; i < names.size(); ++i) names[i] = kReaders[i].name;
  std::array<bool, kReaders.size()> seen{};
  std::vector<EffectOptions> effects;
  for (const Value& item : value.items(0, kMaxEffects)) {
    Object object(item);
    const std::size_t i = object.at("effect").choice(names, "effect");
    if (seen[i] && !kReaders[i].ofAPlace)
      item.refuse(fmt::format("the effect \"{}\" is listed twice", kReaders[i].name));
    seen[i] = true;
    effects.push_back(kReaders[i].read(object, materials));
  }
  return effects;
}

}  // namespace cairn::rockfall

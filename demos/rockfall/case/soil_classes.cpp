// SPDX-License-Identifier: GPL-3.0-or-later
#include "rockfall/case/soil_classes.h"

#include <array>

namespace cairn::rockfall {
namespace {

constexpr std::array kClasses{
    SoilClass{"rockyfor3d-0", "river, swamp or material that a rock could penetrate completely", {0, 0}},
    SoilClass{"rockyfor3d-1", "fine soil material, deeper than about 1 m", {0.21, 0.25}},
    SoilClass{
        "rockyfor3d-2", "fine soil material, shallower than about 1 m, or sand and gravel in the valley", {0.25, 0.31}},
    SoilClass{"rockyfor3d-3",
              "scree below about 10 cm, compact soil with small rock fragments, or forest road",
              {0.30, 0.36}},
    SoilClass{"rockyfor3d-4", "talus slope above about 10 cm, or compact soil with large rock fragments", {0.34, 0.42}},
    SoilClass{"rockyfor3d-5", "bedrock with thin weathered material or soil cover", {0.39, 0.47}},
    SoilClass{"rockyfor3d-6", "bedrock", {0.48, 0.58}},
    SoilClass{"rockyfor3d-7", "asphalt road", {0.32, 0.39}}};

}  // namespace

std::span<const SoilClass> soilClasses() {
  return kClasses;
}

const SoilClass& readSoil(const Value& value) {
  std::array<std::string_view, kClasses.size()> names;
  for (std::size_t i = 0; i < names.size(); ++i) names[i] = kClasses[i].name;
  return kClasses[value.choice(names, "class of soil")];
}

}  // namespace cairn::rockfall

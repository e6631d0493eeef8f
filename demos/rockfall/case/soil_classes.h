// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string_view>

#include "rockfall/case/materials.h"

namespace cairn::rockfall {

/// A published class of soil: what it is, and the coefficient of normal restitution of rocks on it for the law
/// "pfeiffer".
struct SoilClass {
  std::string_view name, description;
  Span restitution;
};

/// The soil types of Rockyfor3D by their numbers, with the ranges from which it draws: Dorren 2016, "Rockyfor3D (v5.2)
/// revealed", section 2.1, soiltype. Its law has a half speed of 9 m/s.
std::span<const SoilClass> soilClasses();
inline constexpr std::string_view kSoilSource = "Dorren 2016, Rockyfor3D (v5.2) revealed, 2.1";

/// Reads the name of a class.
const SoilClass& readSoil(const Value& value);

}  // namespace cairn::rockfall

// SPDX-License-Identifier: Zlib
#pragma once

#include <LinearMath/btVector3.h>

#include <cstdio>
#include <string>

#include "cairn/core/result.h"

namespace cairn::simulation {

/// The numbers that a world takes. Beyond them floats lose what a step needs: inverse masses become infinite, planes
/// lose their place, time stands still. JavaScript's interface has the same (wasm/js/ranges.mjs).
struct Range {
  btScalar min, max;
  const char* unit;

  bool holds(btScalar number) const { return number >= min && number <= max; }  // false for NaN
  bool holds(const btVector3& v) const { return holds(v.x()) && holds(v.y()) && holds(v.z()); }
};

inline constexpr Range kPlaces{btScalar(-1e6), btScalar(1e6), "metres"};
inline constexpr Range kGravities{btScalar(-1e4), btScalar(1e4), "m/s^2"};
inline constexpr Range kVelocities{btScalar(-1e4), btScalar(1e4), "m/s or rad/s"};
inline constexpr Range kTimeSteps{btScalar(1e-5), 1, "seconds"};
inline constexpr Range kNormalLengths{btScalar(1e-3), btScalar(1e3), ""};
inline constexpr Range kHalfExtents{btScalar(1e-4), btScalar(1e6), "metres"};
inline constexpr Range kMasses{btScalar(1e-6), btScalar(1e9), "kilograms"};  // and 0
inline constexpr Range kFrictions{0, 100, ""};
inline constexpr Range kRestitutions{0, 1, ""};
inline constexpr Range kSizes{btScalar(1e-4), btScalar(1e5), "metres"};
inline constexpr int kMaxIterations = 1000;

inline std::string shown(btScalar number) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", double(number));
  return text;
}
inline std::string shown(const btVector3& v) {
  return "(" + shown(v.x()) + ", " + shown(v.y()) + ", " + shown(v.z()) + ")";
}

/// Refuses a number or vector out of its range. `what`: such as "the mass".
template <class Value>
Status check(const Range& range, const Value& value, const std::string& what) {
  if (range.holds(value)) return {};
  const std::string unit = *range.unit ? std::string(" ") + range.unit : std::string();
  return Error{what + " is " + shown(value) + "; give" + (*range.unit ? "" : " numbers") + unit + " from " +
               shown(range.min) + " to " + shown(range.max)};
}

}  // namespace cairn::simulation

// SPDX-License-Identifier: GPL-3.0-or-later
#include "rockfall/terrain/generated.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <string>

#include "rockfall/terrain/raster.h"
#include "scenes/figures/random.h"

namespace cairn::rockfall {

namespace {

constexpr double kSteepest = 85;  // degrees

// Rounded to float: a C library's last bit does not show.
double slopeOf(double degrees) {
  return double(static_cast<float>(std::tan(degrees * std::numbers::pi / 180)));
}

Status checkLength(const char* what, double value, bool mayBeZero = false) {
  if (std::isfinite(value) && (value > 0 || (mayBeZero && value == 0))) return {};
  return Error{std::string("a generated terrain's ") + what + " is " + std::to_string(value) +
               " m: give a finite one " + (mayBeZero ? "that is not negative" : "greater than 0")};
}

Status checkDegrees(const char* what, double value) {
  if (value >= 0 && value <= kSteepest) return {};
  return Error{std::string("a generated terrain's ") + what + " is " + std::to_string(value) +
               " degrees: give 0 to 85"};
}

Status firstOf(std::initializer_list<Status> checks) {
  for (const Status& status : checks)
    if (!status) return status;
  return {};
}

struct Extent {
  double length, width;
};

// Heights by `height(x, y)`, and roughness: on both sides the same where `isMirrored`.
Result<bullet::TerrainGrid> makeGrid(const GeneratedGround& ground, const Extent& extent, bool isMirrored,
                                     const auto& height) {
  if (Status status = firstOf({checkLength("cell", ground.cell), checkLength("roughness", ground.roughness, true)});
      !status)
    return status.error();
  constexpr double kMost = 1e15;  // what an integer surely holds
  const double alongX = std::min(std::max(std::round(extent.length / ground.cell), 1.0) + 1, kMost);
  const double halfY = std::min(std::max(std::round(0.5 * extent.width / ground.cell), 1.0), kMost);
  const auto columns = static_cast<std::uint64_t>(alongX), half = static_cast<std::uint64_t>(halfY);
  if (Status status = checkRasterSize(columns, 2 * half + 1); !status)
    return Error{"a generated terrain " + status.error().message};
  bullet::TerrainGrid grid;
  grid.columns = static_cast<std::uint32_t>(columns);
  grid.rows = static_cast<std::uint32_t>(2 * half + 1);
  grid.cell = ground.cell;
  grid.origin = {0, -double(half) * ground.cell, 0};
  grid.heights.reserve(std::size_t(columns) * grid.rows);
  for (std::uint32_t row = 0; row < grid.rows; ++row) {
    const double steps = double(row) - double(half);
    const std::uint64_t noiseRow = isMirrored ? static_cast<std::uint64_t>(std::abs(steps)) : row;
    for (std::uint32_t column = 0; column < grid.columns; ++column) {
      scenes::Random random(ground.seed, noiseRow * columns + column);
      const double z = height(column * ground.cell, steps * ground.cell) + ground.roughness * random.uniform(-1, 1);
      grid.heights.push_back(static_cast<float>(z));
    }
  }
  return grid;
}

}  // namespace

Result<bullet::TerrainGrid> makePlane(const PlaneTerrain& terrain) {
  if (Status status = firstOf({checkLength("length", terrain.length), checkLength("width", terrain.width),
                               checkDegrees("angle", terrain.degrees)});
      !status)
    return status.error();
  const double slope = slopeOf(terrain.degrees);
  return makeGrid(terrain.ground, {terrain.length, terrain.width}, false,
                  [&](double x, double) { return (terrain.length - x) * slope; });
}

namespace {

// How far the slope has come down, as a part of it, at a part of the way: each step is a bench and then a riser.
struct Steps {
  double count, fraction;      // of benches, of the way that they take
  double ofBenches, ofRisers;  // parts of the height

  double drop(double way) const {
    const double step = std::floor(std::clamp(way, 0.0, 1.0) * count),
                 within = std::clamp(way, 0.0, 1.0) * count - step;
    const double bench = std::min(within / fraction, 1.0);
    const double riser = std::max((within - fraction) / (1 - fraction), 0.0);
    return (step + ofBenches * bench + ofRisers * riser) / count;
  }
};

Status checkSteps(const SteppedSlope& t) {
  if (t.benches < 1) return Error{"a stepped slope has no benches: give at least one, or use a plane"};
  if (!(t.benchFraction > 0) || !(t.benchFraction < 1))
    return Error{"a stepped slope's benches take " + std::to_string(t.benchFraction) +
                 " of its length: give more than 0 and less than 1"};
  if (t.benchDegrees > t.degrees)
    return Error{"a stepped slope's benches are steeper than the slope: give an angle of at most " +
                 std::to_string(t.degrees) + " degrees"};
  const double riser = (slopeOf(t.degrees) - t.benchFraction * slopeOf(t.benchDegrees)) / (1 - t.benchFraction);
  if (riser > slopeOf(kSteepest))
    return Error{"a stepped slope's risers would be steeper than 85 degrees: give benches less of its length"};
  return {};
}

}  // namespace

Result<bullet::TerrainGrid> makeSteppedSlope(const SteppedSlope& terrain) {
  const SteppedSlope& t = terrain;
  if (Status status =
          firstOf({checkLength("length", t.length), checkLength("width", t.width), checkLength("shelf", t.shelf, true),
                   checkLength("basin", t.basin, true), checkDegrees("angle", t.degrees),
                   checkDegrees("bench angle", t.benchDegrees), checkSteps(t)});
      !status)
    return status.error();
  const double slope = slopeOf(t.degrees), height = t.length * slope;
  const double ofBenches = slope > 0 ? t.benchFraction * slopeOf(t.benchDegrees) / slope : t.benchFraction;
  const Steps steps{double(t.benches), t.benchFraction, ofBenches, 1 - ofBenches};
  return makeGrid(t.ground, {t.shelf + t.length + t.basin, t.width}, false,
                  [&](double x, double) { return height * (1 - steps.drop((x - t.shelf) / t.length)); });
}

Result<bullet::TerrainGrid> makeChannel(const ChannelTerrain& terrain) {
  const ChannelTerrain& t = terrain;
  if (Status status =
          firstOf({checkLength("length", t.length), checkLength("width", t.width), checkLength("bottom", t.bottom),
                   checkDegrees("angle", t.degrees), checkDegrees("banks' angle", t.bankDegrees)});
      !status)
    return status.error();
  const double slope = slopeOf(t.degrees), bank = slopeOf(t.bankDegrees), half = 0.5 * t.bottom;
  return makeGrid(t.ground, {t.length, t.width}, true, [&](double x, double y) {
    return (t.length - x) * slope + bank * (std::sqrt(y * y + half * half) - half);
  });
}

Result<bullet::TerrainGrid> makeTalusCone(const TalusCone& terrain) {
  const TalusCone& t = terrain;
  if (Status status = firstOf(
          {checkLength("radius", t.radius), checkLength("basin", t.basin, true), checkDegrees("angle", t.degrees)});
      !status)
    return status.error();
  const double slope = slopeOf(t.degrees), reach = t.radius + t.basin;
  return makeGrid(t.ground, {reach, 2 * reach}, false,
                  [&](double x, double y) { return slope * std::max(t.radius - std::sqrt(x * x + y * y), 0.0); });
}

}  // namespace cairn::rockfall

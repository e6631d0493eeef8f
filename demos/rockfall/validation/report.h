// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string>

#include "rockfall/validation/calibrate.h"

namespace cairn::rockfall {

std::string validationText(std::span<const ProfileComparison> profiles);
/// The same with units in the keys, and the settings as they were.
std::string validationJson(std::span<const ProfileComparison> profiles, const ValidationSettings& settings);
/// Shares of blocks up to run-out and lateral place, a row of panels a profile: an SVG.
std::string validationFigure(std::span<const ProfileComparison> profiles);

std::string calibrationText(const Calibration& calibration, const ValidationSettings& settings);
/// The settings with the values that were found, as a file: with how they were found.
Result<std::string> calibratedSettings(const Calibration& calibration, const ValidationSettings& settings);

}  // namespace cairn::rockfall

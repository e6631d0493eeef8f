// SPDX-License-Identifier: GPL-3.0-or-later
#include "tool/grain_report.h"

namespace cairn::tool {
namespace {

Json tripleJson(const Vec3d& v) {
  return {v.x, v.y, v.z};
}

Json rowsJson(const Mat3d& m) {
  return {tripleJson(m.rows[0]), tripleJson(m.rows[1]), tripleJson(m.rows[2])};
}

}  // namespace

Json massJson(const MassProperties& mass, double density) {
  const double total = density * mass.volume;
  return {{"volume", mass.volume},
          {"density", density},
          {"mass", total},
          {"center_of_mass", tripleJson(mass.centerOfMass)},
          {"inertia", rowsJson(mass.inertia * total)},
          {"principal_moments", tripleJson(mass.principalMoments * total)},
          {"principal_axes_columns", rowsJson(mass.principalAxes)}};
}

}  // namespace cairn::tool

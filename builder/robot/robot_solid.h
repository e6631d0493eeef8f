// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "cairn/builder/robot.h"

namespace cairn::builder {

/// 1 or -1 for each factor of a scale.
Vec3d signsOf(const Vec3d& scale);

/// The triangles of a mesh file, scaled by positive factors. They need not bound a solid.
Result<TriangleMesh> readScaledSurface(const std::filesystem::path& path, const Vec3d& factors);

/// The solid of a surface: the surface itself where it bounds one, else repaired, else wrapped.
Result<RobotSolid> solidOf(TriangleMesh surface, const ProgressCallback& progress);

}  // namespace cairn::builder

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "still_scenes.h"
#include "test_solids.h"

namespace cairn::hard {

/// Of every case, m/s2.
inline constexpr double kGravity = 9.81;

/// One body in one kind of shape; mass properties are those of the solid, whatever the shape.
struct CaseBody {
  std::string name;
  test::TriedBody body;
};

/// The same body in several: ours first, then Bullet's.
using CaseBodies = std::vector<CaseBody>;

/// Ours by the builder, "box" and the like as `own` (left out where null), "hull" exact, "gimpact" the triangles.
/// Centre of mass in the solid's origin, principal axes along its own. Built once a process for each `key`.
const CaseBodies& bodiesOf(const std::string& key, const test::Solid& solid, const std::string& ownName,
                           std::shared_ptr<btCollisionShape> own);
const CaseBodies& cubes(double edge);
const CaseBodies& boxes(const Vec3d& size);
/// Of 2048 faces.
const CaseBodies& balls(double radius);
/// A generated rock of 320 faces, its diagonal `size` metres, in the frame of its principal axes.
const CaseBodies& rocks(std::uint64_t seed, double size);

/// The mesh of `rocks(seed, size)`, in the same frame.
const test::Solid& solidOfRock(std::uint64_t seed, double size);

/// Ours alone.
std::shared_ptr<btCollisionShape> treeOf(const test::Solid& solid, std::uint32_t depth);

}  // namespace cairn::hard

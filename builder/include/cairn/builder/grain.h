// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string>
#include <vector>

#include "cairn/builder/ball.h"
#include "cairn/builder/triangle_mesh.h"
#include "cairn/core/mass_properties.h"
#include "cairn/core/result.h"

namespace cairn::builder {

/// Mass properties of the solid a mesh bounds: exact polyhedral integrals. Precondition: `checkMesh(mesh)`. Linear.
MassProperties massOf(const TriangleMesh& mesh);

/// Mass properties of the union of balls, in which what several hold counts once: exact formulas, up to rounding. The
/// union is divided into the parts of balls within their cells of the power diagram; by the divergence theorem volume,
/// first and second moments of a part come from its plane faces alone, which are polygons cut by a circle. Radii are
/// above 0; precondition: not empty. Cubic in the balls that overlap one of them, at worst.
MassProperties massOf(std::span<const Ball> balls);

/// What a grain's spheres and body are written with.
struct Grain {
  std::span<const Ball> balls;  ///< mesh frame
  MassProperties mass;          ///< of what the grain stands for: decides centre and axes
};

/// The multisphere template of LIGGGHTS: a line `x y z r` a sphere, about the centre of mass, the mesh's axes.
std::string liggghtsText(const Grain& grain);
/// What YADE's `ymport.textClumps` reads: `#format x_y_z_r_clumpId`, then a line `x y z r 0` a sphere, about the centre
/// of mass, the mesh's axes.
std::string yadeText(const Grain& grain);
/// What Chrono's DEM engine loads: `x,y,z,r` and a line a sphere, about the centre of mass, principal axes.
std::string chronoText(const Grain& grain);
/// What CLUMP writes: a line `x,y,z,r` a sphere, without a head, the mesh's frame.
std::string clumpText(const Grain& grain);

/// The spheres of a file `cairn cover` wrote, or of any text whose lines begin `x y z r`; what follows on a line has to
/// be numbers, and is passed over. Fails for what is no such file: the sentence says which line.
Result<std::vector<Ball>> readCover(const std::string& path);

}  // namespace cairn::builder

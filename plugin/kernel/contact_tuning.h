// SPDX-License-Identifier: Zlib
#pragma once

#include <cstddef>

#include "cairn/bullet/sphere_tree_shape.h"

namespace cairn::bullet::tuning {

// Every number that decides which contacts two surfaces have. "Size" is the box diagonal of the smaller body; a
// "contact distance" is `kContactDistance` of it. See docs/algorithms/contacts.md.

/// Surfaces no farther apart than this are told to the solver, which lets them close and no more. Sizes. At 0.1 %
/// heaps of cubes keep 3 to 4 mJ/kg; what is farther off brakes rolling bodies.
inline constexpr float kContactDistance = static_cast<float>(kSpeculativeFraction);

/// Depth to which local minima are trusted; deeper, regions of overlap answer. Sizes. At 1 % heaps of cubes keep 2.5 to
/// 8.7 mJ/kg.
inline constexpr float kTrustedDepth = 0.02F;
/// And never more than this part of the thinner body's thickness: beyond its middle the other side is nearer.
inline constexpr float kTrustedThickness = 0.5F;

/// What could cross half of a shell's wall in a step is met that much ahead, up to this many walls, so that a fast body
/// is not asked about all of the other. Without, one of 18 bodies leaves a shaken cup, and a plate passes a ball
/// (`ThinWall.IsNotCrossedByWhatIsFasterThanItIsThick`).
inline constexpr float kMaxWalls = 4;

/// How far beside a face or an edge a point may lie and still touch it, where the surfaces are apart. Contact
/// distances. Rounding, and corners that lie on corners. Where they overlap it is the depth, up to one contact
/// distance.
inline constexpr float kBeside = 0.02F;

/// A feature's cone of normals opens with depth: a neighbour may be below the tangent plane by the depth, up to this
/// part of its own distance (11 degrees). Without, of three heaps of 100 cubes one keeps 3 mJ/kg and one 22, in
/// place of 0.4 at most. Without the cap nothing that was measured gets worse.
inline constexpr float kConeOpening = 0.2F;

/// Sine of the angle below which two edges are parallel: their faces and vertices touch instead.
inline constexpr float kParallelSine = 0.02F;

/// A penetrating contact gives way to one near it that is shallower than this part of its depth, if their normals are
/// farther apart than this (50 degrees), and they are within so many of its depths and contact distances of each other.
inline constexpr float kShallower = 0.9F;
inline constexpr float kOtherWayCosine = 0.642787610F;
inline constexpr float kNearDepths = 2;
inline constexpr float kNearDistances = 0.1F;

/// A point inside the other body is explained by a contact near it if its depth below the contact's plane is at least
/// minus this many contact distances, and at most so many of the contact's depths and as many contact distances.
inline constexpr float kExplainedSlack = 0.5F;
inline constexpr float kExplainedDepths = 1.5F;

/// Of a region of overlap that is not explained, points deeper than this part of its width along the way out are
/// contacts.
inline constexpr float kDeepPart = 0.3F;
/// An area that is this part of what it is summed from, or less, is its rounding: a rod through a plate.
inline constexpr float kNoArea = 1e-3F;
/// Regions narrower than so many contact distances are left alone: what is in contact crosses by that much.
inline constexpr float kMinWidth = 0.5F;
/// Near patches are looked for so much farther than contacts reach, and found again once bodies have moved by that.
/// Sizes. Their features are listed for about so many steps like the last one. Matters of time alone: with more, each
/// step asks more of them; with less, they are listed more often (`ContactKernel.ListsLastForSomeSteps`).
inline constexpr float kPatchSkin = 0.01F;
inline constexpr float kListSteps = 3;

/// Until the bodies have moved so far against each other since the last look, their contacts stay as they are. Contact
/// distances: below one, what comes to touch meanwhile is told in time. At a tenth heaps take twice the time at rest;
/// at one, four of five heaps of blocks stay awake, at half one.
inline constexpr float kReused = 0.5F;

/// Of a body that comes near one of Bullet's meshes so many vertices, evenly spread over its list, say whether it is
/// inside: a ring's middle, or a few vertices, may be inside what it hangs on (`MeshGround.HoldsFromBothSides`).
inline constexpr std::size_t kAskedVertices = 24;
/// Larger meshes of Bullet's are told by leaves: what is derived takes about half a kilobyte and three microseconds a
/// triangle, in the step in which a body first comes near (`GroundSurface.IsNotOfHugeMeshes`).
inline constexpr std::size_t kMaxTriangles = 200000;

/// Hulls of more corners are asked by GJK: a question of faces takes some ten nanoseconds a corner
/// (`ConvexSurface.AsksHugeHullsByGjk`).
inline constexpr int kMaxHullVertices = 512;
/// Places along an edge that are looked at for where a convex body is nearest, or where a face of it ends: a thousandth
/// of the edge where they halve it. With five, one nearest contact of seven is off by more than rounding, or missing
/// (`ConvexContacts.TellWhatIsNearest`).
inline constexpr int kMaxLooks = 10;

/// Cosine of the 25 degrees within which contacts share a manifold. At 50 degrees cups that stand in each other do not
/// come to rest (`Mechanisms.CupsStandInEachOther`).
inline constexpr float kOneManifold = 0.906307787F;

}  // namespace cairn::bullet::tuning

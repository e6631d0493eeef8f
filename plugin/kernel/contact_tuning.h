// SPDX-License-Identifier: Zlib
#pragma once

#include <cstddef>

#include "cairn/bullet/sphere_tree_shape.h"

namespace cairn::bullet::tuning {

// All numbers that decide which contacts two surfaces have. "Size" is the diagonal of the smaller body's box; a
// "contact distance" is `kContactDistance` sizes. See docs/algorithms/contacts.md.

/// Sizes. Surfaces nearer than this are given to the solver, which lets them close and no more. At 0.1 % heaps of cubes
/// keep 3 to 4 mJ/kg; at more than 0.2 % the contacts brake rolling bodies.
inline constexpr float kContactDistance = static_cast<float>(kSpeculativeFraction);

/// Sizes. Depth to which local minima are trusted; deeper overlap is answered by regions. At 1 % heaps of cubes keep
/// 2.5 to 8.7 mJ/kg.
inline constexpr float kTrustedDepth = 0.02F;
/// The trusted depth's limit as a fraction of the thinner body's thickness: beyond its middle the other side is nearer.
inline constexpr float kTrustedThickness = 0.5F;

/// Walls. A body that could cross half of a shell's wall in a step gets contacts that far ahead, up to this many walls.
/// The cap keeps a fast body from testing all of the other. Without the look ahead, one of 18 bodies leaves a shaken
/// cup, and a plate passes a ball (`ThinWall.IsNotCrossedByWhatIsFasterThanItIsThick`).
inline constexpr float kMaxWalls = 4;

/// Contact distances. How far beside a face or an edge a point may lie and still touch it, where the surfaces are
/// apart. It covers rounding, and corners that lie on corners. Where surfaces overlap the limit is their depth, up to
/// one contact distance.
inline constexpr float kBeside = 0.02F;

/// A feature's cone of normals opens with the depth of the overlap. A neighbour may be below the tangent plane by that
/// depth, up to this fraction of its own distance (11 degrees). Without the opening, flat pieces topple
/// (`FlatPieces.StandInPilesOfSix`). Without the cap, heaps of 100 s-shapes take a third longer to fall asleep.
inline constexpr float kConeOpening = 0.2F;

/// Sine of the angle below which two edges are parallel: their faces and vertices touch instead.
inline constexpr float kParallelSine = 0.02F;

/// A penetrating contact gives way to a shallower one near it if all of these hold. The other is shallower than the
/// first fraction of its depth. Their normals differ by more than 50 degrees (cosine below). Their distance is at most
/// so many of its depths, plus so many contact distances.
inline constexpr float kShallower = 0.9F;
inline constexpr float kOtherDirectionCosine = 0.642787610F;
inline constexpr float kNearDepths = 2;
inline constexpr float kNearDistances = 0.1F;

/// A contact explains a nearby point inside the other body if the point's depth below the contact's plane is in a
/// range. The lower end is minus the slack, in contact distances. The upper end is this many of the contact's depths,
/// plus the slack. A way out is tried with the slack too: with less, a peg jams on the rim of its hole
/// (`Fits.APegFallsIntoItsHole`).
inline constexpr float kExplainedSlack = 0.5F;
inline constexpr float kExplainedDepths = 1.5F;

/// In an unexplained region of overlap, points deeper than this fraction of the region's width along the way out become
/// contacts.
inline constexpr float kDeepPart = 0.3F;
/// A vector area that is at most this fraction of the sum of its parts is rounding: a rod through a plate.
inline constexpr float kNoArea = 1e-3F;
/// Contact distances. Narrower regions get no contacts of their own, because ordinary contacts overlap by that much.
inline constexpr float kMinWidth = 0.5F;
/// Sizes. Nearby patches are searched this much farther than contacts are wanted, and again once bodies have moved by
/// it. Features are listed for about `kListSteps` steps like the last one. Both affect time alone. With larger values
/// each step tests more; with smaller ones lists are made more often (`ContactKernel.ListsLastForSomeSteps`).
inline constexpr float kPatchSkin = 0.01F;
inline constexpr float kListSteps = 3;

/// Contact distances. Contacts are reused until the bodies have moved this far against each other since the last test.
/// It must stay below 1, so that new contacts are found in time. At 0.1 heaps at rest take twice the time; at 1, four
/// of five heaps of blocks stay awake, at 0.5 one does.
inline constexpr float kReused = 0.5F;

/// Number of vertices, evenly spread over the list, that decide whether a body near one of Bullet's meshes is inside
/// it. One point does not suffice: a ring's middle, or a few vertices, may be inside the mesh it hangs on
/// (`MeshGround.HoldsFromBothSides`).
inline constexpr std::size_t kSampledVertices = 24;
/// Larger meshes of Bullet's are answered by leaves. The derived data takes about half a kilobyte and three
/// microseconds a triangle, in the step in which a body first comes near (`GroundSurface.IsNotOfHugeMeshes`).
inline constexpr std::size_t kMaxTriangles = 200000;

/// Hulls of more corners are queried by GJK, because a query of faces takes some ten nanoseconds a corner
/// (`ConvexSurface.AsksHugeHullsByGjk`).
inline constexpr int kMaxHullVertices = 512;
/// Iterations that search an edge for its nearest point to a convex body, or for the end of a face. Ten halvings reach
/// a thousandth of the edge. With five, one nearest contact of seven is missing or wrong by more than rounding
/// (`ConvexContacts.TellWhatIsNearest`).
inline constexpr int kMaxIterations = 10;

/// Cosine of the 25 degrees within which contacts share a manifold. At 50 degrees cups inside each other do not come to
/// rest (`Mechanisms.CupsStandInEachOther`).
inline constexpr float kOneManifold = 0.906307787F;

}  // namespace cairn::bullet::tuning

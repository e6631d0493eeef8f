// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <variant>

#include "balls/sphere_set.h"
#include "cairn/builder/build.h"
#include "medial/candidates.h"

namespace cairn::builder {

/// The choice of the ball for a part of the surface, after the division has fixed the part.
enum class Refit : std::uint8_t {
  none,        ///< the centre that the method chose, with the radius needed
  smallest,    ///< the smallest ball around the part
  tightest,    ///< the better of the chosen centre and one moved downhill on the stand-off (thesis 6.1, Alg. 9)
  leastError,  ///< the least certified error of several balls, the smallest ball among them; see `fittedRegion`
};

/// The means by which a method divides the surface.
enum class Division : std::uint8_t {
  spheres,  ///< a set of spheres for each region
  cubes,    ///< cells of an octree: always by eight, no sphere set
  groups,   ///< Hubbard's merged medial spheres
  levels,   ///< spheres of a whole level at once
};

/// The frame in which a tree grows.
enum class GrownIn : std::uint8_t {
  mesh,  ///< the mesh's: the solid is divided along the user's axes
  body,  ///< the body's own (hierarchy/body_frame.h): the mesh's position, rotation and scale change nothing
};

/// A method that needs only the points.
using FitToPoints = SphereSet (*)(const CoverProblem& problem);
/// A method that reduces balls of the medial axis. `optimiser` is what goes on with its set.
using FitFromMedial = SphereSet (*)(Optimiser optimiser, const CoverProblem& problem, const Candidates& candidates);
/// The construction of a region's set of at most `problem.count` balls, which hold the problem's points. Nothing for
/// methods that make no set for a region.
using SphereFit = std::variant<std::monostate, FitToPoints, FitFromMedial>;

/// A method's construction of sphere sets, and their treatment after it. This table is the one place that defines both.
/// A construction that serves for comparison gets the treatment of the thesis and no more, unless the user asks for it.
struct MethodTraits {
  Method method;
  const char* name;
  /// Used when the user does not choose. With `cairn`, sets are optimised (spheres/optimise.h), again for the seams,
  /// and fitted against the closing; divisions are chosen with lookahead.
  Optimiser optimiser;
  Refit refit;
  Division division;
  GrownIn frame;
  SphereFit fit{};  ///< present where `division` is by spheres
};

/// Returns all methods, in the order in which they are listed to users.
std::span<const MethodTraits> allMethods();
/// Returns the traits of a method. Precondition: `method` is a value of the enumeration.
const MethodTraits& traitsOf(Method method);

}  // namespace cairn::builder

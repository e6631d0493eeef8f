// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>

#include "cairn/builder/build.h"

namespace cairn::builder {

/// The ball of a part of the surface, once the division has said which part that is.
enum class Refit : std::uint8_t {
  none,        ///< the centre the method chose, with the radius needed
  smallest,    ///< the smallest ball around the part
  tightest,    ///< the better of the chosen centre and one moved downhill on the stand-off (thesis 6.1, Alg. 9)
  leastError,  ///< the least certified error of several, the smallest ball among them; see `fittedRegion`
};

/// What a method divides the surface by.
enum class Division : std::uint8_t {
  spheres,  ///< a set of spheres for each region
  cubes,    ///< cells of an octree: always by eight, no sphere set
  groups,   ///< Hubbard's merged medial spheres
  levels,   ///< spheres of a whole level at once
};

/// The frame a tree is grown in.
enum class GrownIn : std::uint8_t {
  mesh,  ///< the mesh's: divided along the axes the user gave it
  body,  ///< the body's own (hierarchy/body_frame.h): place, turn and scale of the mesh change nothing
};

/// What is done to the sphere sets of a method beside making them. The one place that says so: a construction that is
/// here to be compared with gets what the thesis gives it and no more, unless the user asks for it.
struct MethodTraits {
  Method method;
  const char* name;
  /// When the user does not choose. With `cairn` sets are optimised (spheres/optimise.h), again for the seams, and
  /// fitted against the closing; divisions are chosen with lookahead.
  Optimiser optimiser;
  Refit refit;
  Division division;
  GrownIn frame;
};

/// All methods, in the order they are listed to users.
std::span<const MethodTraits> allMethods();
/// Precondition: `method` is one of the enumeration's.
const MethodTraits& traitsOf(Method method);

}  // namespace cairn::builder

// SPDX-License-Identifier: Zlib
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>

#include "cairn/core/vec3.h"

class btCollisionShape;
class btSdfCollisionShape;

namespace cairn::bullet {

/// The shape if it is such a field, else null: others may share its type number.
const btSdfCollisionShape* asField(const btCollisionShape& shape);

/// A btSdfCollisionShape's field, in the shape's frame and unit. Bullet ignores the shape's scaling and its margin, and
/// so does this. The surface is where the field is zero, whatever it was made from.
///
/// All that can be asked is the domain's box and, inside it, value and gradient of an interpolation. What is assumed of
/// it, as nothing in it says so: from a point of the surface to any other point it rises by no more than `kSteepest`
/// times their distance. Cubic interpolations of exact distances rise by up to 1.3 times, near edges that no cell's
/// border follows. What rises by less makes nothing wrong, only slower. Where it says nothing (cells that were left
/// out, not a number) a surface may be anywhere and is met nowhere; outside the domain there is none.
class DistanceField {
 public:
  static constexpr float kSteepest = 1.5F;
  /// Below this length a gradient has no direction to speak of.
  static constexpr float kMinGradient = 0.05F;

  struct Sample {
    float value = 0;  ///< negative inside
    Vec3 gradient;
    float least = 0;  ///< any surface is so far away at least, see `leastDistance`
    bool isInDomain = true;

    /// False in the middle between two surfaces, and where it is no field of distances.
    bool hasDirection() const { return lengthSq(gradient) > kMinGradient * kMinGradient; }
    /// Distance of the surface, to first order: a field that rises too much or too little is off by that factor near
    /// its surface. Within `kSteepest`, because inside, near an edge, it may not rise at all.
    float height() const { return value / std::clamp(length(gradient), 1 / kSteepest, kSteepest); }
  };

  /// The shape must outlive its use here. One that never got a field is a box in which nothing is said, or empty.
  void take(const btSdfCollisionShape& shape);
  /// Diagonal of the domain; infinite where there is none.
  float size() const;
  /// No point of the domain has a greater coordinate: lengths that round.
  float extent() const { return extent_; }
  /// Changes with the domain, and with the value at any of four points well inside it.
  std::uint64_t fingerprint() const;

  /// Nothing where the field says nothing. Outside the domain, what leads to it: continuous, and no more than the
  /// distance of any surface if the field is one of distances.
  std::optional<Sample> at(const Vec3& p) const;
  /// By how much any surface is away from `p` at least; 0 where it may be anywhere, infinite where there is none.
  float leastDistance(const Vec3& p) const;
  /// Whether that is more than `distance`; asks the field only where its box does not say so.
  bool isFarther(const Vec3& p, float distance) const;

 private:
  struct Nearest {
    Vec3 point;      // of the domain
    Vec3 beyond;     // from there to what was asked about
    float distance;  // of the two
  };
  std::optional<Nearest> nearestInDomain(const Vec3& p) const;
  float leastDistance(const Nearest& nearest) const;
  std::optional<Sample> query(const Vec3& p) const;

  // Asking it changes nothing, but Bullet's query is not const.
  btSdfCollisionShape* shape_ = nullptr;
  Vec3 lower_, upper_;  // a little inside the domain
  float extent_ = 0;
  bool isEmpty_ = true;
};

}  // namespace cairn::bullet

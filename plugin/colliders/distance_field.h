// SPDX-License-Identifier: Zlib
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>

#include "cairn/core/vec3.h"

class btCollisionShape;
class btSdfCollisionShape;

namespace cairn::bullet {

/// The shape as a distance field, or null: other shapes may use its type number.
const btSdfCollisionShape* asField(const btCollisionShape& shape);

/// The field of a btSdfCollisionShape, in the shape's frame and unit. Bullet ignores the shape's scaling and margin,
/// and so does this class. The surface is where the field is zero.
///
///     DistanceField field;
///     field.take(shape);
///     if (const auto sample = field.at(p)) use(sample->value, sample->gradient);
///
/// Bullet gives the domain's box and, inside it, the value and gradient of an interpolation. One property is assumed,
/// because nothing in the field states it. From a point of the surface to any other point the field rises by at most
/// `kSteepest` times their distance. Cubic interpolations of exact distances rise by up to 1.3 times, near edges that
/// no cell border follows. A smaller rise makes queries slower, not wrong.
///
/// Where the field has no value (cells left out, NaN), a surface may be anywhere and is met nowhere. Outside the domain
/// there is no surface.
class DistanceField {
 public:
  static constexpr float kSteepest = 1.5F;
  /// A gradient shorter than this has no usable direction.
  static constexpr float kMinGradient = 0.05F;

  struct Sample {
    float value = 0;  ///< negative inside
    Vec3 gradient;
    float least = 0;  ///< lower bound on the distance to any surface, see `leastDistance`
    bool isInDomain = true;

    /// False in the middle between two surfaces, and where the field is not a distance.
    bool hasDirection() const { return lengthSq(gradient) > kMinGradient * kMinGradient; }
    /// Distance to the surface, to first order: divides by the gradient, so that a field that rises too fast or too
    /// slowly is corrected. The divisor stays within `kSteepest`, because a field may not rise at all inside, near an
    /// edge.
    float height() const { return value / std::clamp(length(gradient), 1 / kSteepest, kSteepest); }
  };

  /// Takes the shape's field. The shape must outlive its use here. A shape that never got a field is an empty domain,
  /// or a domain without values.
  void take(const btSdfCollisionShape& shape);
  /// Diagonal of the domain; infinite for an empty one.
  float size() const;
  /// Bound on the coordinates of the domain; it scales rounding errors.
  float extent() const { return extent_; }
  /// Changes with the domain, and with the value at any of four points well inside it.
  std::uint64_t fingerprint() const;

  /// The field at `p`; empty where the field has no value. Outside the domain the value is continued: it is continuous
  /// and, for a true distance field, at most the distance to any surface.
  std::optional<Sample> at(const Vec3& p) const;
  /// Lower bound on the distance from `p` to any surface. 0 where a surface may be anywhere, infinite without any.
  float leastDistance(const Vec3& p) const;
  /// Whether that bound exceeds `distance`; queries the field only where the box does not decide.
  bool isFarther(const Vec3& p, float distance) const;

 private:
  struct Nearest {
    Vec3 point;      // of the domain
    Vec3 beyond;     // from `point` to the query point
    float distance;  // between the two
  };
  std::optional<Nearest> nearestInDomain(const Vec3& p) const;
  float leastDistance(const Nearest& nearest) const;
  std::optional<Sample> query(const Vec3& p) const;

  // A query changes nothing, but Bullet's function is not const.
  btSdfCollisionShape* shape_ = nullptr;
  Vec3 lower_, upper_;  // slightly inside the domain
  float extent_ = 0;
  bool isEmpty_ = true;
};

}  // namespace cairn::bullet

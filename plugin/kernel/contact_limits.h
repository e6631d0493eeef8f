// SPDX-License-Identifier: Zlib
#pragma once

namespace cairn::bullet {

/// The world lengths that decide which features of a pair are contacts; contact_tuning.h has their fractions.
struct ContactLimits {
  float contactDistance = 0;  ///< scale of all tolerances, even for queries that look farther
  float maxSeparation = 0;    ///< contacts up to this separation are wanted; at least `contactDistance`
  float trustedDepth = 0;     ///< deeper overlap, without margins, is not a local minimum of the distance
  float thickness = 0;        ///< of the thinner body; overlap counts as no deeper
  float margins = 0;          ///< sum of both surfaces' margins
  /// Lists stay complete until a point of one body has moved this far against the other.
  float skin = 0;
  float size = 0;     ///< of the smaller body
  float overlap = 0;  ///< depth of the deepest local minimum, if it is known already

  /// `thickness`: of the thinner body, see `TreeSurface`. Minima are trusted to half of it, and to at most
  /// `tuning::kTrustedDepth` of the size. All arguments in world lengths.
  static ContactLimits of(float contactDistance, float maxSeparation, float thickness, float margins);

  /// Bound on the displacement between points of two bodies by rounding.
  float rounding() const { return 1e-6F * size; }
  /// Bound, in radians, on how far directions turn while lists hold. A rotation moves the farthest point of a body by
  /// the angle times the radius of a ball around it. That radius is at least size / (2 sqrt 3), so 4 skin / size
  /// suffices.
  float turn() const { return 1e-6F + (size > 0 ? 4 * skin / size : 0.0F); }
  /// Whether a separation may belong to a contact.
  bool trusts(float separation) const { return separation <= maxSeparation && separation + margins >= -trustedDepth; }
  /// How far beside a feature a point at this separation may be and still touch it.
  float besideAt(float separation) const;
  /// How far a neighbour at this distance may be on the wrong side of the contact's tangent plane. Bodies that overlap
  /// may tilt by the deepest overlap: their shallow side holds them too.
  float belowAt(float separation, float neighbourDistance) const;
};

}  // namespace cairn::bullet

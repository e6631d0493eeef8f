// SPDX-License-Identifier: Zlib
#pragma once

namespace cairn::bullet {

/// World lengths that decide what counts as a contact of a pair; see `contact_tuning.h`.
struct ContactLimits {
  float contactDistance = 0;  ///< the scale of all tolerances, however far a query looks
  float reach = 0;            ///< contacts no farther apart than this are wanted; at least `contactDistance`
  float trustedDepth = 0;     ///< what overlaps more, without margins, is no local minimum of the distance
  float margins = 0;          ///< grow both surfaces together
  /// What is listed is all that may be in contact until a point of one body has moved so far against the other.
  float skin = 0;
  float size = 0;  ///< of the smaller body

  /// `thickness`: of the thinner body, see `TreeSurface`. Minima are trusted to half of that, or to
  /// `tuning::kTrustedDepth`.
  static ContactLimits of(float contactDistance, float reach, float thickness, float margins);

  /// What rounding may move points of two bodies by against each other.
  float rounding() const { return 1e-6F * size; }
  /// How far, in radians, directions may turn meanwhile: a turn about the middle moves what is farthest by half the
  /// size.
  float turn() const { return 1e-6F + (size > 0 ? 4 * skin / size : 0.0F); }
  /// Whether a separation is one of a contact.
  bool trusts(float separation) const { return separation <= reach && separation + margins >= -trustedDepth; }
  /// How far beside a feature a point may be that is so far from it.
  float besideAt(float separation) const;
  /// How far a neighbour at this distance may be on the wrong side of the contact's tangent plane.
  float belowAt(float separation, float neighbourDistance) const;
};

}  // namespace cairn::bullet

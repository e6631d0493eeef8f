// SPDX-License-Identifier: Zlib
#pragma once

#include <vector>

#include "cairn/core/export.h"
#include "cairn/effects/effect.h"

namespace cairn::effects {

/// Roughness below what the terrain's mesh shows: in a blow the surface's normal is tilted in a random direction by an
/// angle uniform in [0, atan(roughness / R)], R the radius of the ball of the body's volume (as in PlatRock). The same
/// for all contacts of a blow in a step; contacts at rest are left alone. A tilt that would turn the blow into a
/// parting is not made.
///
/// Counter-based: a tilt is a pure function of the seed, the body's id and the step's number, so neither threads nor
/// other bodies change it.
class CAIRN_EFFECTS_EXPORT SurfaceRoughness final : public Effect, MaterialHook {
 public:
  /// `heights`: m, by material, of the side that does not move; materials beyond it are smooth.
  SurfaceRoughness(std::vector<btScalar> heights, std::uint64_t seed) : heights_(std::move(heights)), seed_(seed) {}

  std::string_view name() const override { return "surface_roughness"; }
  Turn turn() const override { return Turn::surfaceRoughness; }
  Hooks hooks() override { return {.material = this}; }

  /// `normal` turned as for this body in this step. Precondition: unit normal, `maxTilt` in radians, below pi/2.
  btVector3 tilted(const btVector3& normal, btScalar maxTilt, std::uint32_t bodyId, std::uint64_t step) const;

 private:
  bool concerns(MaterialId a, MaterialId b) const override { return heightOf(a) > 0 || heightOf(b) > 0; }
  std::uint32_t changeContacts(std::span<Contact> contacts, const Step& step) override;
  void restoreContacts(std::span<Contact> contacts) override;
  bool tilt(Contact& contact, const Step& step);
  btScalar heightOf(MaterialId material) const { return material < heights_.size() ? heights_[material] : btScalar(0); }

  struct Changed {
    btManifoldPoint* point;
    btVector3 normal;
  };

  std::vector<btScalar> heights_;
  std::uint64_t seed_;
  std::vector<Changed> changed_;
};

}  // namespace cairn::effects

// SPDX-License-Identifier: Zlib
#pragma once

#include <vector>

#include "cairn/core/export.h"
#include "cairn/effects/bounded_log.h"
#include "cairn/effects/effect.h"

namespace cairn::effects {

/// Soft ground takes energy from what ploughs into it. A blow at normal speed vn leaves a scar of depth
/// d = 0.16 m^(1/4) ME^(-2/5) vn^(4/5) (m in kg, ME the soil's strength in kPa, vn in m/s, d in m), but no deeper than
/// R, the radius of the ball of the body's volume. The soil resists on the cap's section A = pi (2 R d - d^2) with
/// F = 1/2 drag density A v^2, v the speed before the blow, and takes the work F d, at most the translational energy
/// the blow left. (Lu et al. 2019, as rust_rockfall has it.) The velocity is scaled down in its direction; spin is left
/// alone.
///
/// Criterion: has a volume, and strikes something that does not move and whose material is soil here. Acts after the
/// solver, on top of restitution and friction.
class CAIRN_EFFECTS_EXPORT SoilScarring final : public Effect, ImpactHook {
 public:
  /// A material's softness.
  struct Soil {
    btScalar strength = 0;  ///< ME, kPa; zero: no soil
    btScalar density = 0;   ///< kg/m^3, >= 0
    btScalar drag = 0;      ///< coefficient, >= 0
  };
  /// One mark that a blow left.
  struct Scar {
    btVector3 place;       ///< of the contact, world frame
    btScalar depth;        ///< m
    btScalar energy;       ///< that it took, J
    std::uint32_t bodyId;  ///< in the set
  };
  /// The scar of a blow, whatever energy is left for it.
  struct Work {
    btScalar depth;   ///< m
    btScalar energy;  ///< F d, J
  };

  /// `soils` by material; materials beyond it are none. Keeps up to `kept` scars until they are taken.
  explicit SoilScarring(std::vector<Soil> soils, std::size_t kept = 4096) : soils_(std::move(soils)), scars_(kept) {}

  std::string_view name() const override { return "soil_scarring"; }
  Turn turn() const override { return Turn::soilScarring; }
  Hooks hooks() override { return {.impact = this}; }

  /// The scars since this was last asked.
  BoundedLog<Scar>& scars() { return scars_; }
  /// `radius` > 0, speeds >= 0.
  static Work workOf(const Soil& soil, btScalar mass, btScalar radius, btScalar normalSpeed, btScalar speed);

 private:
  std::uint32_t afterImpacts(std::span<const Impact> impacts, const Step& step) override;
  bool concerns(MaterialId a, MaterialId b) const override { return isSoil(a) || isSoil(b); }
  bool isSoil(MaterialId material) const { return material < soils_.size() && soils_[material].strength > 0; }
  bool scar(const Impact& impact, std::size_t side);

  std::vector<Soil> soils_;
  BoundedLog<Scar> scars_;
};

}  // namespace cairn::effects

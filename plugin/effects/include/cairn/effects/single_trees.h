// SPDX-License-Identifier: Zlib
#pragma once

#include <memory>
#include <vector>

#include "cairn/core/export.h"
#include "cairn/effects/effect.h"
#include "cairn/effects/ground_height.h"

namespace cairn::effects {

class StemGrid;

/// Trees that stand one by one. A body that meets a stem loses kinetic energy, once for each meeting: a share of what
/// the stem can take, E = energyRatio 38.7 D^2.31 J with D the diameter at breast height in cm, or all it has. The
/// share is that of the place where the stem is hit, 0.98 in the middle and none at its edge (Dorren and Berger 2006,
/// Tree Physiology 26, 63-71, as Rockyfor3D has it: Dorren 2016, "Rockyfor3D (v5.2) revealed", 3.4).
///
/// The energy comes from the motion towards the axis first, so that a hit beside it turns the body aside; a stem has no
/// friction. If that motion has too little, all velocities, spin included, are scaled down for the rest. No body is
/// thrown back. The direction is Cairn's; the sources draw it at random.
///
/// A meeting: the ball of the body's volume, on its way in this step, touches the stem's cylinder; it ends when a step
/// goes by without. All stems are asked, however close to each other (Rockyfor3D before 6.0 kept one a cell: ecorisQ,
/// "In-depth revision of Rockyfor3D").
///
/// Criterion: has a volume, moves, and touches a stem. Stems where the ground is unknown do not stand.
class CAIRN_EFFECTS_EXPORT SingleTrees final : public Effect, ForceHook {
 public:
  /// One tree.
  struct Stem {
    btScalar x, y;        ///< of the axis, world frame, m; z is up
    btScalar diameter;    ///< at breast height, m, > 0; that of the whole cylinder
    btScalar height = 0;  ///< above its ground, m; 0: `Options::height`
  };
  /// What all trees have in common.
  struct Options {
    btScalar height = 20;  ///< of stems above their ground that have none of their own, m; zero: none of these stand
    btScalar energyRatio = 1;  ///< >= 0, of the species' fracture energy to that of the stems measured; zero: nothing
  };

  /// `ground` is asked here and not kept.
  SingleTrees(std::vector<Stem> stems, const GroundHeight& ground, const Options& options);
  ~SingleTrees() override;

  std::string_view name() const override { return "trees"; }
  Turn turn() const override { return Turn::trees; }
  Hooks hooks() override { return {.force = this}; }
  void welcome(Body& body) override;
  void dismiss(Body& body) override;

  /// How many have ground to stand on.
  std::size_t standing() const;
  /// Energy that a stem of this diameter (m) can absorb, J.
  static btScalar mostEnergy(btScalar diameter, btScalar energyRatio);
  /// Share of it that a hit takes. `offset`: of the touching point from the axis, across the body's way, over the
  /// stem's radius; 0 to 1.
  static btScalar shareOf(btScalar offset);

 private:
  std::uint32_t applyForces(std::span<Body* const> bodies, const Step& step) override;

  Options options_;
  std::unique_ptr<const StemGrid> stems_;
  std::vector<std::vector<std::uint32_t>> meeting_;  // by body id: the stems it touched in its last step
  std::vector<std::uint32_t> touched_;
};

}  // namespace cairn::effects

// SPDX-License-Identifier: Zlib
#include "kernel/near_patches.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace cairn::bullet {

namespace {

// The axis-parallel box around a box turned into another frame.
PlacedBox placed(const Box& box, const Similarity& to) {
  const Vec3 half = (box.upper - box.lower) * 0.5F;
  PlacedBox result;
  result.middle = to * box.middle();
  for (int row = 0; row < 3; ++row) {
    const Vec3& of = to.linear.rows[static_cast<std::size_t>(row)];
    result.half[row] = std::abs(of.x) * half.x + std::abs(of.y) * half.y + std::abs(of.z) * half.z;
  }
  return result;
}

PlacedBox asPlaced(const Box& box) {
  return {box.middle(), (box.upper - box.lower) * 0.5F};
}

}  // namespace

template <class MayTouch, class OnPatch>
bool NearPatches::descend(const PlacedSurface& surface, const PlacedBox& box, const NearLimits& limits, Budget& budget,
                          const MayTouch& mayTouch, const OnPatch& onPatch) {
  const std::span<const PatchFamily> families = surface.patches().families();
  waiting_.assign(1, 0);
  while (!waiting_.empty()) {
    if (!budget.charge(kOverlapTestCost * PatchFamily::kWidth)) return false;
    const PatchFamily& family = families[waiting_.back()];
    waiting_.pop_back();
    const FamilyTest test = testFamily(family, box, limits);
    minSeparation_ = std::min(minSeparation_, test.minSeparation * surface.scale);
    for (std::uint32_t lanes = test.near; lanes != 0; lanes &= lanes - 1) {
      const auto lane = static_cast<std::uint32_t>(std::countr_zero(lanes));
      if (!mayTouch(family, lane)) continue;
      if (family.isPatch(lane))
        onPatch(family.child[lane], test.margin[lane]);
      else
        waiting_.push_back(family.child[lane]);
    }
  }
  return true;
}

bool NearPatches::findNearOfA(const SurfacePair& surfaces, const PlacedPatches& a, const PlacedPatches& b,
                              Budget& budget) {
  nearOfA_.clear();
  const PlacedBox allOfB = placed(surfaces.b.patches().box(), surfaces.b.toOther);
  const auto mayTouch = [&](const PatchFamily& family, std::uint32_t lane) {
    budget.forceCharge(kOverlapTestCost * PatchFamily::kWidth);
    const PlacedBox box = placed(family.box(lane), surfaces.a.toOther);
    const FamilyTest test = testFamily(surfaces.b.patches().families()[0], box, b.limits());
    minSeparation_ = std::min(minSeparation_, test.minSeparation * surfaces.b.scale);
    return test.near != 0;
  };
  return descend(surfaces.a, allOfB, a.limits(), budget, mayTouch,
                 [&](std::uint32_t patch, float) { nearOfA_.push_back(patch); });
}

bool NearPatches::find(const SurfacePair& surfaces, PlacedPatches& a, PlacedPatches& b, std::vector<PatchPair>& found,
                       Budget& budget) {
  found.clear();
  minSeparation_ = std::numeric_limits<float>::infinity();
  if (!findNearOfA(surfaces, a, b, budget)) return false;
  for (const std::uint32_t ofA : nearOfA_) {
    a.place(ofA);
    const auto always = [](const PatchFamily&, std::uint32_t) { return true; };
    const auto onPatch = [&](std::uint32_t ofB, float margin) {
      b.place(ofB);
      const PlacedPatch& here = a[ofA];
      const Box& there = b[ofB].placed;
      const float marginInA = there.separationTo(here.near);
      if (marginInA <= a.limits().skin)
        found.push_back({ofA, ofB, std::max(margin * b.scale(), marginInA * a.scale())});
      else
        minSeparation_ = std::min(minSeparation_, there.separationTo(here.patch.box) * a.scale());
    };
    if (!descend(surfaces.b, asPlaced(a[ofA].placed), b.limits(), budget, always, onPatch)) return false;
  }
  minSeparation_ -= a.margins();
  return true;
}

}  // namespace cairn::bullet

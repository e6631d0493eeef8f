// SPDX-License-Identifier: Zlib
#include "kernel/near_patches.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "kernel/family_test.h"

namespace cairn::bullet {

namespace {

// Boxes of one side, seen from the other.
struct BoxView {
  Similarity to;
  Mat3 sizes;         // absolute values of the linear part
  NearLimits limits;  // in the other's frame

  BoxView(const PlacedSurface& side, const PlacedSurface& other, const ContactLimits& of)
      : to(side.toOther), limits(other.scale, of) {
    for (std::size_t row = 0; row < 3; ++row)
      for (int column = 0; column < 3; ++column) sizes.rows[row][column] = std::abs(to.linear.rows[row][column]);
  }

  PlacedBox place(const Box& box) const { return {to * box.middle(), sizes * ((box.upper - box.lower) * 0.5F)}; }
};

// Of the square of a box's diagonal, world length.
float sizeOf(const Box& box, float scale) {
  return lengthSq(box.upper - box.lower) * scale * scale;
}

}  // namespace

bool NearPatches::find(const SurfacePair& surfaces, const ContactLimits& limits, Budget& budget) {
  const BoxView fromA(surfaces.a, surfaces.b, limits), fromB(surfaces.b, surfaces.a, limits);
  found_.clear();
  apart_ = std::numeric_limits<float>::infinity();
  waiting_.assign(1, {surfaces.a.surface().patches.box(), true, false, 0, 0});
  while (!waiting_.empty()) {
    const Visit visit = waiting_.back();
    waiting_.pop_back();
    if (!budget.charge(kOverlapTestCost * PatchFamily::kWidth)) return false;
    const BoxView& view = visit.isOfA ? fromA : fromB;
    const PlacedSurface& other = visit.isOfA ? surfaces.b : surfaces.a;
    const FamilyTest test =
        testFamily(other.surface().patches.families()[visit.family], view.place(visit.box), view.limits);
    apart_ = std::min(apart_, test.apart * other.scale);
    for (std::uint32_t lanes = test.near; lanes != 0; lanes &= lanes - 1)
      meet(surfaces, visit, static_cast<std::uint32_t>(std::countr_zero(lanes)));
  }
  apart_ -= limits.margins;
  return true;
}

// The larger of the two is looked into.
void NearPatches::meet(const SurfacePair& surfaces, const Visit& visit, std::uint32_t lane) {
  const PlacedSurface &own = visit.isOfA ? surfaces.a : surfaces.b, &other = visit.isOfA ? surfaces.b : surfaces.a;
  const PatchFamily& family = other.surface().patches.families()[visit.family];
  const std::uint32_t child = family.child[lane];
  if (visit.isPatch && family.isPatch(lane)) {
    found_.push_back(visit.isOfA ? Pair{visit.index, child} : Pair{child, visit.index});
    return;
  }
  const Box box = family.box(lane);
  const bool looksIntoOther =
      visit.isPatch || (!family.isPatch(lane) && sizeOf(box, other.scale) > sizeOf(visit.box, own.scale));
  if (looksIntoOther)
    waiting_.push_back({visit.box, visit.isOfA, visit.isPatch, visit.index, child});
  else
    waiting_.push_back({box, !visit.isOfA, family.isPatch(lane), child, visit.index});
}

}  // namespace cairn::bullet

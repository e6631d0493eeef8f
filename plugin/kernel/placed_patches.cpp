// SPDX-License-Identifier: Zlib
#include "kernel/placed_patches.h"

#include <algorithm>

#include "kernel/place_vertices.h"

namespace cairn::bullet {

void PlacedPatches::begin(const PlacedSurface& side, const ContactLimits& limits) {
  side_ = &side;
  limits_ = NearLimits(side.scale, limits);
  count_ = 0;
  const std::uint32_t count = side.patches().count();
  if (slots_.size() < count) slots_.resize(count);
  if (++run_ == 0) {  // all stamps are old
    slots_.assign(slots_.size(), {});
    run_ = 1;
  }
}

void PlacedPatches::place(std::uint32_t index) {
  Slot& slot = slots_[index];
  if (slot.run == run_) return;
  slot = {run_, count_};
  if (count_ == placed_.size()) placed_.emplace_back();
  PlacedPatch& here = placed_[count_++];
  here.patch = side_->patches().patch(index);
  here.placed = placeVertices(here.patch, side_->toOther, here.columns);
  const SurfacePatch& patch = here.patch;
  here.near = limits_.around(patch.box, patch.normals);
  here.nearLowest = patch.lowest + limits_.depth - limits_.besideDeep;
  here.nearHighest = patch.highest + std::max(limits_.maxSeparation, 0.0F) + limits_.besideDeep;
}

}  // namespace cairn::bullet

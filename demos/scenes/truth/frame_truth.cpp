// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenes/truth/frame_truth.h"

#include <algorithm>

#include "scenes/heap/interpenetration.h"

namespace cairn::scenes {

FrameTruth::FrameTruth(const ExactSurface& surface, const Model& model, std::span<const BodyMotion> motions)
    : surface_(surface), size_(model.size) {
  std::vector<Box> boxes;
  for (const BodyMotion& motion : motions) {
    const PlacedBody body = placeBody(motion.pose, model);
    worldFromBody_.push_back(body.worldFromBody);
    boxes.push_back(body.box);
  }
  for (int i = 0; i < static_cast<int>(boxes.size()); ++i)
    for (int j = i + 1; j < static_cast<int>(boxes.size()); ++j)
      if (boxes[i].overlaps(boxes[j]) && surfacesMeet(surface_, surface_, relative({i, j})))
        meeting_.emplace_back(i, j);
}

bool FrameTruth::meets(const BodyPair& pair) const {
  return std::ranges::binary_search(meeting_, pair);
}

double FrameTruth::gap(const BodyPair& pair) {
  if (meets(pair)) return 0;
  const auto [entry, isNew] = gaps_.try_emplace(pair, 0);
  if (isNew) entry->second = surfaceDistance(surface_, surface_, relative(pair));
  return entry->second;
}

double FrameTruth::depth(const BodyPair& pair) const {
  return mutualPenetration(surface_, surface_, relative(pair), kDepthToleranceFraction * size_);
}

double FrameTruth::distanceFromMesh(int body, const Vec3d& point) const {
  return surface_.distanceTo(worldFromBody_[static_cast<std::size_t>(body)].inverse() * point);
}

double FrameTruth::distanceFromSolid(int body, const Vec3d& point) const {
  return std::max(0.0, -surface_.depth(worldFromBody_[static_cast<std::size_t>(body)].inverse() * point));
}

Placement FrameTruth::relative(const BodyPair& pair) const {
  return relativePlacement(worldFromBody_[static_cast<std::size_t>(pair.first)],
                           worldFromBody_[static_cast<std::size_t>(pair.second)]);
}

}  // namespace cairn::scenes

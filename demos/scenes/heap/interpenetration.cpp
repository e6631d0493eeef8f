// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenes/heap/interpenetration.h"

#include <utility>
#include <vector>

#include "scenes/truth/exact_check.h"
#include "scenes/truth/placed_body.h"

namespace cairn::scenes {
namespace {

std::vector<PlacedBody> placeBodies(std::span<const btTransform> poses, const Model& model) {
  std::vector<PlacedBody> bodies;
  for (const btTransform& pose : poses) bodies.push_back(placeBody(pose, model));
  return bodies;
}

template <class Visit>
void forOverlappingBoxes(const std::vector<PlacedBody>& bodies, const Visit& visit) {
  for (std::size_t i = 0; i < bodies.size(); ++i)
    for (std::size_t j = i + 1; j < bodies.size(); ++j)
      if (bodies[i].box.overlaps(bodies[j].box)) visit(i, j);
}

class SceneCheck {
 public:
  SceneCheck(const BodyScene& scene, const ExactSurface& surface) : scene_(scene), surface_(surface) {
    for (const btRigidBody* body : scene.world().bodies())
      bodies_.push_back(placeBody(body->getWorldTransform(), scene.model()));
  }

  Interpenetration run() {
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      for (std::size_t j = i + 1; j < bodies_.size(); ++j)
        if (bodies_[i].box.overlaps(bodies_[j].box) || isLoaded(i, j)) checkPair(i, j);
      checkAgainstGround(i);
    }
    const double size = scene_.model().size;
    return {depth_.over(size), gap_.over(size), pitDepth_.over(size), pitGap_.over(size)};
  }

 private:
  bool isLoaded(std::size_t i, std::size_t j) const {
    return scene_.world().loads().isLoaded(static_cast<int>(i), static_cast<int>(j));
  }

  void checkPair(std::size_t i, std::size_t j) {
    const Placement jFromI = relativePlacement(bodies_[i].worldFromBody, bodies_[j].worldFromBody);
    const double depth = mutualPenetration(surface_, surface_, jFromI, kDepthToleranceFraction * scene_.model().size);
    if (depth > 0) depth_.add(depth);
    if (isLoaded(i, j)) gap_.add(depth > 0 ? 0 : surfaceDistance(surface_, surface_, jFromI));
  }

  void checkAgainstGround(std::size_t i) {
    for (std::size_t f = 0; f < scene_.groundParts(); ++f) {
      const double room = scene_.clearance(bodies_[i], surface_, f);
      if (room < 0) pitDepth_.add(-room);
      if (scene_.world().loads().isLoaded(World::staticNumber(f), static_cast<int>(i)))
        pitGap_.add(std::max(0.0, room));
    }
  }

  const BodyScene& scene_;
  const ExactSurface& surface_;
  std::vector<PlacedBody> bodies_;
  SpreadOfLengths depth_, gap_, pitDepth_, pitGap_;
};

}  // namespace

Spread penetrations(const ExactSurface& surface, const Model& model, std::span<const btTransform> poses) {
  const std::vector<PlacedBody> bodies = placeBodies(poses, model);
  SpreadOfLengths depths;
  forOverlappingBoxes(bodies, [&](std::size_t i, std::size_t j) {
    const Placement jFromI = relativePlacement(bodies[i].worldFromBody, bodies[j].worldFromBody);
    const double depth = mutualPenetration(surface, surface, jFromI, kDepthToleranceFraction * model.size);
    if (depth > 0) depths.add(depth);
  });
  return depths.over(model.size);
}

double worstPenetration(const ExactSurface& surface, const Model& model, std::span<const btTransform> poses) {
  const std::vector<PlacedBody> bodies = placeBodies(poses, model);
  double worst = 0;
  forOverlappingBoxes(bodies, [&](std::size_t i, std::size_t j) {
    const Placement jFromI = relativePlacement(bodies[i].worldFromBody, bodies[j].worldFromBody);
    worst = mutualPenetration(surface, surface, jFromI, kDepthToleranceFraction * model.size, worst);
  });
  return worst / model.size;
}

Result<Interpenetration> measureInterpenetration(const BodyScene& scene) {
  const auto surface = ExactSurface::create(scene.model().vertices, scene.model().triangles);
  if (!surface) return surface.error();
  return SceneCheck(scene, surface.value()).run();
}

}  // namespace cairn::scenes

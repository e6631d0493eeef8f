// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenes/world/body_scene.h"

#include <utility>

namespace cairn::scenes {

Status BodyScene::begin(const WorldOptions& options, const ShapeOptions& shapeOptions) {
  auto shape = BodyShape::create(options.shape, model_, shapeOptions);
  if (!shape) return shape.error();
  auto world = World::create(options);
  if (!world) return world.error();
  if (stepsWithoutBudget_ > 0)
    if (Status status = world.value()->setBudget({}); !status) return status;
  shape_ = std::move(shape).value();
  world_ = std::move(world).value();
  return {};
}

}  // namespace cairn::scenes

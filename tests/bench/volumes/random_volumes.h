// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <random>

#include "random_tree.h"
#include "volumes/swept_ball.h"

namespace cairn::bench {

/// A volume in the cube of half width 1, of a size such that about a third of pairs meet.
inline SweptBall randomVolume(VolumeKind kind, std::mt19937_64& engine) {
  const Mat3d turn = test::randomRotation(engine);
  SweptBall volume{kind, test::randomPoint(engine), {turn.column(0), turn.column(1), turn.column(2)}, {}, 0};
  for (int i = 0; i < volume.dimensions(); ++i) volume.half[i] = test::uniform(engine, 0.05, 0.8);
  volume.radius = test::uniform(engine, 0.05, kind == VolumeKind::ball ? 0.8 : 0.3);
  return volume;
}

}  // namespace cairn::bench

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "compare.h"

namespace cairn::hard {

struct LyingStart {
  double size = 1;             ///< diagonal, metres
  double seconds = 60;         ///< watched, after it has come to lie
  double settling = 5;         ///< seconds before that
  double timeStep = 1.0 / 60;  ///< seconds
  test::Resisted resisted = test::Resisted::sliding;
};

/// A body let down on a plane, friction 0.5, awake: RMS of its place about the mean and drift, both in per cent of its
/// size.
Figures lie(const test::TriedBody& tried, const LyingStart& start);

}  // namespace cairn::hard

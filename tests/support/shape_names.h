// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "scenes/bodies/body_shape.h"

namespace cairn::test {

/// A shape's name as Google Test wants them: letters and digits.
inline std::string shapeTestName(const ::testing::TestParamInfo<scenes::ShapeKind>& shape) {
  std::string name = scenes::shapeName(shape.param);
  std::replace(name.begin(), name.end(), '+', '_');
  return name;
}

}  // namespace cairn::test

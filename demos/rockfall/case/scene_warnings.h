// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "rockfall/case/explain.h"

namespace cairn::rockfall {

/// Something about a case as a whole that its answer may hang on.
struct SceneWarning {
  std::string path;  ///< in the case
  std::string text;  ///< one sentence: what, and what to do
};

/// A step that is long for the speeds and sizes of the scene, and effects that it needs and does not list. By bounds:
/// rocks may be slower.
std::vector<SceneWarning> sceneWarnings(const Case& scene, const SceneBounds& bounds);

}  // namespace cairn::rockfall

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "options.h"
#include "scenes/bodies/model.h"

namespace cairn::frame_budget {

/// The mesh and tree of the bodies of a scene.
struct Subject {
  scenes::SourcedTree source;
  scenes::Model model;  ///< 1 m across
};

/// Builds or loads the tree. Fails as that does, and for a level of spheres that the tree does not have.
Result<Subject> obtainSubject(const Options& options);

}  // namespace cairn::frame_budget

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "options.h"

namespace cairn::frame_budget {

/// The scene `converge`: records the poses, shows them to every shape, prints the table, writes the files.
Status measureConverge(const Options& options, const scenes::SourcedTree& source, const scenes::Model& model);

}  // namespace cairn::frame_budget

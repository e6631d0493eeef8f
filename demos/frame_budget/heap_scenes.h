// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "options.h"

namespace cairn::frame_budget {

/// The scenes `heap` and `crush`: simulates every shape in turn, prints the table, writes the files.
Status measureHeaps(const Options& options, const scenes::SourcedTree& source, const scenes::Model& model);

}  // namespace cairn::frame_budget

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cairn/builder/evaluate.h"
#include "cairn/core/sphere_tree.h"

namespace cairn::tool {

/// Keys keep the order in which they were set.
using Json = nlohmann::ordered_json;

/// Returns `levels` of the reports. With `Sampling::none` the sampled measures are left out.
Json levelsJson(const std::vector<builder::LevelFit>& fits, builder::Sampling sampling);

/// Returns the build options of a tree, with which the reports begin.
Json buildInfoJson(const SphereTree& tree);

/// SHA-256 of the bytes of the tree's file.
std::string treeSha256(const SphereTree& tree);

/// Writes a report to `path`; "-" means standard output. Does nothing for an empty path.
Status writeJson(const Json& json, const std::string& path);

/// Prints the fit per level as tables on standard output: lengths in percent of the mesh's diagonal, volumes in percent
/// of its volume.
void printLevels(const std::vector<builder::LevelFit>& fits, builder::Sampling sampling);

}  // namespace cairn::tool

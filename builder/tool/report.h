// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cairn/builder/evaluate.h"
#include "cairn/core/sphere_tree.h"

namespace cairn::tool {

/// Keys keep the order they are set in.
using Json = nlohmann::ordered_json;

/// `levels` of the reports; the sampled measures are left out with `Sampling::none`.
Json levelsJson(const std::vector<builder::LevelFit>& fits, builder::Sampling sampling);

/// The options a tree was built with, as the reports begin.
Json buildInfoJson(const SphereTree& tree);

/// SHA-256 of the bytes of the tree's file.
std::string treeSha256(const SphereTree& tree);

/// Writes a report to `path`, "-" being standard output; does nothing for an empty path.
Status writeJson(const Json& json, const std::string& path);

/// The fit per level as tables on standard output: lengths in percent of the mesh's diagonal, volumes of its own.
void printLevels(const std::vector<builder::LevelFit>& fits, builder::Sampling sampling);

}  // namespace cairn::tool

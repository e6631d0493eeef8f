// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cairn/builder/evaluate.h"
#include "cairn/builder/progress.h"
#include "cairn/builder/repair.h"
#include "cairn/builder/triangle_mesh.h"
#include "cairn/builder/wrap.h"
#include "cairn/core/result.h"
#include "tool/report.h"

namespace cairn::tool {

/// The options that turn a mesh file into the solid of a tree.
struct MeshSourceOptions {
  std::string path;
  bool repair = false, wrap = false;
  builder::RepairOptions repairOptions;
  builder::WrapOptions wrapOptions;
  std::string output;  ///< where the solid is written, as PLY; empty: nowhere
};

/// Adds MESH, `--repair` and `--wrap` with their lengths, and `--mesh-output`.
void addMeshSource(CLI::App& command, MeshSourceOptions& options);

/// Checks combinations of options; throws as the parser does.
void checkMeshSource(const MeshSourceOptions& options);

/// A solid, and the changes that produced it.
struct MeshSource {
  builder::TriangleMesh mesh;  ///< has passed `checkMesh`
  std::optional<builder::RepairCounts> repair;
  builder::RepairOptions repairOptions;
  std::optional<builder::Wrap> wrap;  ///< without its mesh, which is the one above
};

/// Reads the file and repairs or wraps it as requested. Prints the number of dropped triangles on standard error.
/// Writes no file.
Result<MeshSource> readMeshSource(const MeshSourceOptions& options, const builder::ProgressCallback& progress);

/// Adds `certified_mesh`, `repair` and `wrap` to a report, and to each of its `levels` the error against the original.
void reportMeshSource(const MeshSource& source, const std::vector<builder::LevelFit>& fits, Json& json);

/// Prints the changes as sentences on standard output; nothing for an unchanged mesh.
void printMeshSource(const MeshSource& source, const std::vector<builder::LevelFit>& fits);

/// Writes the solid to `options.output`.
Status writeMeshOutput(const MeshSource& source, const MeshSourceOptions& options);

}  // namespace cairn::tool

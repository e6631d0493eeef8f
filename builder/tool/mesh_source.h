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

/// How a mesh file becomes the solid a tree is built on.
struct MeshSourceOptions {
  std::string path;
  bool repair = false, wrap = false;
  builder::WrapOptions wrapOptions;
  std::string output;  ///< where the solid is written, as PLY; empty: nowhere
};

/// Adds MESH, `--repair`, `--wrap` with its lengths, and `--mesh-output`.
void addMeshSource(CLI::App& command, MeshSourceOptions& options);

/// What single options cannot tell; throws as the parser does.
void checkMeshSource(const MeshSourceOptions& options);

/// A solid and what was done to get it.
struct MeshSource {
  builder::TriangleMesh mesh;  ///< has passed `checkMesh`
  std::optional<builder::RepairCounts> repair;
  std::optional<builder::Wrap> wrap;  ///< without its mesh, which is the one above
  builder::WrapOptions wrapOptions;
};

/// Reads the file and repairs or wraps it as asked; notes what an import left out on standard error. Writes nothing.
Result<MeshSource> readMeshSource(const MeshSourceOptions& options, const builder::ProgressCallback& progress);

/// Adds `certified_mesh`, `repair` and `wrap` to a report, and to each of its `levels` the error against the original.
void reportMeshSource(const MeshSource& source, const std::vector<builder::LevelFit>& fits, Json& json);

/// The same as sentences on standard output; nothing for a mesh taken as it is.
void printMeshSource(const MeshSource& source, const std::vector<builder::LevelFit>& fits);

/// Writes the solid to where the options say.
Status writeMeshOutput(const MeshSource& source, const MeshSourceOptions& options);

}  // namespace cairn::tool

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "cairn/builder/progress.h"
#include "cairn/builder/triangle_mesh.h"
#include "cairn/core/result.h"

namespace cairn::accuracy_cost {

/// A solid for experiments; its mesh has passed `checkMesh`.
struct Model {
  std::string name;
  builder::TriangleMesh mesh;
};

/// Debian's archive of test meshes, from the package libcgal-demo.
inline constexpr const char* kMeshArchive = "/usr/share/doc/libcgal-dev/data.tar.gz";
/// Number of triangles of scanned models, about as many as in the thesis.
inline constexpr std::uint32_t kModelTriangles = 1500;

/// The source of models.
struct ModelSource {
  std::filesystem::path made;  ///< folder for models made here, as NAME.obj; created if missing
  std::filesystem::path archive = kMeshArchive;
  std::filesystem::path folder{};  ///< not empty: only the meshes in this folder are used
};

/// Returns the names of all models that can be made: scans from the archive, then computed solids.
std::vector<std::string> modelNames();

/// Returns the file of a model below `source.made` and makes it if it is missing. A scan comes from the archive, is
/// wrapped tightly if it is open or intersects itself, and is simplified to `kModelTriangles`. Fails for an unknown
/// name, for an archive that cannot be read, and with `kCancelled`. Takes seconds for a scan.
Result<std::filesystem::path> makeModel(const std::string& name, const ModelSource& source,
                                        const builder::ProgressCallback& progress = {});

/// Returns the models of these names; with `source.folder`, all meshes in it, by name. Models of a missing archive are
/// left out and listed in `leftOut`. Fails when no model is left, for meshes that bound no solid, for two of one name,
/// and with `kCancelled`.
Result<std::vector<Model>> readModels(const std::vector<std::string>& names, const ModelSource& source,
                                      std::vector<std::string>& leftOut,
                                      const builder::ProgressCallback& progress = {});

}  // namespace cairn::accuracy_cost

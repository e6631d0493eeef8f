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

/// A solid that experiments are made on; its mesh has passed `checkMesh`.
struct Model {
  std::string name;
  builder::TriangleMesh mesh;
};

/// Debian's archive of test meshes, from the package libcgal-demo.
inline constexpr const char* kMeshArchive = "/usr/share/doc/libcgal-dev/data.tar.gz";
/// Triangles of scanned models, about as many as the thesis's have.
inline constexpr std::uint32_t kModelTriangles = 1500;

/// Where models come from.
struct ModelSource {
  std::filesystem::path made;  ///< folder that models made here are kept in, as NAME.obj; made if missing
  std::filesystem::path archive = kMeshArchive;
  std::filesystem::path folder{};  ///< not empty: the meshes in here instead, and no others
};

/// Names of all models that can be made: scans from the archive, then computed solids.
std::vector<std::string> modelNames();

/// The file of a model below `source.made`, made if it is not there: a scan is taken from the archive, wrapped tightly
/// if it is open or crosses itself, and simplified to `kModelTriangles`. Fails for an unknown name, for an archive that
/// cannot be read, and with `kCancelled`. Seconds for a scan.
Result<std::filesystem::path> makeModel(const std::string& name, const ModelSource& source,
                                        const builder::ProgressCallback& progress = {});

/// The models of these names, or with a folder all meshes in it, by name. Those the archive would have to give are left
/// out where there is no archive: `leftOut` is told. Fails when none is left, for meshes that bound no solid, for two
/// of one name, and with `kCancelled`.
Result<std::vector<Model>> readModels(const std::vector<std::string>& names, const ModelSource& source,
                                      std::vector<std::string>& leftOut,
                                      const builder::ProgressCallback& progress = {});

}  // namespace cairn::accuracy_cost

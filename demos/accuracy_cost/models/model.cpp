// SPDX-License-Identifier: GPL-3.0-or-later
#include "accuracy_cost/models/model.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>
#include <system_error>
#include <utility>

#include "accuracy_cost/models/solids.h"
#include "cairn/builder/import.h"
#include "cairn/builder/simplify.h"
#include "cairn/builder/wrap.h"
#include "cairn/core/atomic_file.h"
#include "scenes/command/subprocess.h"

namespace cairn::accuracy_cost {
namespace {

namespace fs = std::filesystem;
using builder::TriangleMesh;

struct Scan {
  const char* name;
  const char* file;  // in data/meshes of the archive
  bool wrapped;      // the scan is open or intersects itself, so a tight wrap is made first
};

constexpr std::array kScans{
    Scan{"bunny", "bunny00.off", false},
    Scan{"dragon", "ChineseDragon-10kv.off", true},
    Scan{"cow", "cow.off", true},
    Scan{"armadillo", "armadillo.off", false},
    Scan{"elephant", "elephant.off", false},
    Scan{"ellipsoid", "ellipsoid.off", false},
};

struct Solid {
  const char* name;
  TriangleMesh (*make)();
};

/// Round solids have 60 or more sides, so that facets are small beside the errors of sphere sets.
const std::array kSolids{
    Solid{"s-shape", [] { return sShape(); }},     Solid{"cube", [] { return box({1, 1, 1}); }},
    Solid{"block", [] { return box({1, 1, 3}); }}, Solid{"cylinder", [] { return cylinder(3, 64); }},
    Solid{"cone", [] { return cone(2, 64); }},     Solid{"torus", [] { return torus(1, 0.35, 40, 20); }},
};

Result<fs::path> extracted(const Scan& scan, const ModelSource& source) {
  const fs::path file = source.made / scan.file;
  const fs::path log = source.made / (std::string(scan.file) + ".log");
  const int code = scenes::runCommand({"tar", "-xzf", source.archive.string(), "-C", source.made.string(),
                                       "--strip-components=2", fmt::format("data/meshes/{}", scan.file)},
                                      log);
  std::error_code ignored;
  fs::remove(log, ignored);
  if (code == 0 && fs::exists(file)) return file;
  return Error{fmt::format("{} has no data/meshes/{}; install libcgal-demo or name a folder of meshes by --models",
                           source.archive.string(), scan.file)};
}

Result<TriangleMesh> solidOf(const Scan& scan, const fs::path& file, const builder::ProgressCallback& progress) {
  if (!scan.wrapped) return builder::importMesh(file);
  const auto surface = builder::importSurface(file);
  if (!surface) return surface.error();
  auto skin = builder::wrap(surface.value(), {.alpha = 0.01, .offset = 0.001}, progress);
  if (!skin) return skin.error();
  return std::move(std::move(skin).value().mesh);
}

Result<TriangleMesh> prepared(const Scan& scan, const ModelSource& source, const builder::ProgressCallback& progress) {
  const auto file = extracted(scan, source);
  if (!file) return file.error();
  const auto mesh = solidOf(scan, file.value(), progress);
  std::error_code ignored;
  fs::remove(file.value(), ignored);
  if (!mesh) return mesh.error();
  return builder::simplify(mesh.value(), kModelTriangles, progress);
}

bool isScan(const std::string& name) {
  return std::ranges::any_of(kScans, [&](const Scan& scan) { return name == scan.name; });
}

Result<TriangleMesh> made(const std::string& name, const ModelSource& source,
                          const builder::ProgressCallback& progress) {
  for (const Scan& scan : kScans)
    if (name == scan.name) return prepared(scan, source, progress);
  for (const Solid& solid : kSolids)
    if (name == solid.name) return solid.make();
  return Error{fmt::format("there is no model '{}'; choose of {}", name, fmt::join(modelNames(), ", "))};
}

/// Returns the mesh files of the folder by extension and name. A set of models has a text beside them.
Result<std::vector<fs::path>> filesIn(const fs::path& folder) {
  std::error_code failure;
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder, failure))
    if (entry.is_regular_file() && builder::isMeshFile(entry.path())) files.push_back(entry.path());
  if (failure) return Error{fmt::format("{}: {}", folder.string(), failure.message())};
  std::ranges::sort(files);
  if (files.empty())
    return Error{fmt::format(
        "{} holds no file of a mesh format; name a folder of OBJ, OFF, PLY, STL or glTF by --models", folder.string())};
  return files;
}

Result<std::vector<Model>> modelsOf(const std::vector<fs::path>& files) {
  std::vector<Model> models;
  for (const fs::path& file : files) {
    auto mesh = builder::importMesh(file);
    if (!mesh) return mesh.error();
    const std::string name = file.stem().string();
    if (name.find_first_of(",\"\n") != std::string::npos)
      return Error{fmt::format("{}: the name of a model has no comma, quote or line break; rename it", file.string())};
    if (std::ranges::find(models, name, &Model::name) != models.end())
      return Error{fmt::format("two meshes are called {}; rename one", name)};
    models.push_back({name, std::move(mesh).value()});
  }
  return models;
}

}  // namespace

std::vector<std::string> modelNames() {
  std::vector<std::string> names;
  for (const Scan& scan : kScans) names.emplace_back(scan.name);
  for (const Solid& solid : kSolids) names.emplace_back(solid.name);
  return names;
}

Result<fs::path> makeModel(const std::string& name, const ModelSource& source,
                           const builder::ProgressCallback& progress) {
  std::error_code failure;
  fs::create_directories(source.made, failure);
  if (failure) return Error{fmt::format("cannot make the folder {}: {}", source.made.string(), failure.message())};
  fs::path file = source.made / (name + ".obj");
  if (fs::exists(file)) return file;
  const auto mesh = made(name, source, progress);
  if (!mesh) return mesh.error();
  if (Status written = writeFileAtomically(file, builder::objText(mesh.value())); !written) return written.error();
  return file;
}

Result<std::vector<Model>> readModels(const std::vector<std::string>& names, const ModelSource& source,
                                      std::vector<std::string>& leftOut, const builder::ProgressCallback& progress) {
  if (!source.folder.empty()) {
    const auto files = filesIn(source.folder);
    if (!files) return files.error();
    return modelsOf(files.value());
  }
  std::vector<fs::path> files;
  for (const std::string& name : names) {
    const bool there = fs::exists(source.archive) || fs::exists(source.made / (name + ".obj"));
    if (isScan(name) && !there) {
      leftOut.push_back(name);
      continue;
    }
    const auto file = makeModel(name, source, progress);
    if (!file) return file.error();
    files.push_back(file.value());
  }
  if (files.empty())
    return Error{fmt::format("no model can be made without {}; install libcgal-demo or name a folder by --models",
                             source.archive.string())};
  return modelsOf(files);
}

}  // namespace cairn::accuracy_cost

// SPDX-License-Identifier: GPL-3.0-or-later
//
// Feeds the builder solids with random damage. Whatever comes, the answer is a tree whose certificate holds, or one
// sentence; `repair` is asked too, and what it calls a solid has to be one.
#include "cairn/builder/certify.h"
#include "cairn/builder/import.h"
#include "cairn/builder/mesh_file.h"
#include "cairn/builder/repair.h"
#include "mesh_from_bytes.h"
#include "require.h"
#include "run_program.h"

namespace {

using namespace cairn;
using fuzz::require;

void useTree(const SphereTree& tree, const builder::TriangleMesh& mesh) {
  const auto certificate = builder::certify(tree, mesh);
  require(certificate.ok(), "a tree was built of a mesh that certify refuses");
  const auto failures = certificate.value().failures(tree);
  require(failures.empty(), failures.empty() ? "" : failures.front());
}

/// As a file brings it, because that is what `repair` takes.
Result<builder::TriangleMesh> repaired(const builder::TriangleMesh& mesh) {
  const test::TemporaryFolder folder;
  const auto path = folder.path() / "mesh.ply";
  std::ofstream(path, std::ios::binary) << builder::plyBytes(mesh);
  const auto surface = builder::importSurface(path);
  if (!surface) return surface.error();
  return builder::repair(surface.value());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::Bytes bytes({data, size});
  const bool mend = bytes.below(2) != 0;
  const builder::BuildOptions options = fuzz::optionsFrom(bytes);
  builder::TriangleMesh mesh = fuzz::meshFrom(bytes);
  if (mend) {
    auto solid = repaired(mesh);
    if (!solid) {
      fuzz::requireSentence(solid.error().message);
      return 0;
    }
    require(builder::checkMesh(solid.value()).ok(), "repair returned no solid");
    mesh = std::move(solid).value();
  }
  const auto tree = builder::buildTree(mesh, options);
  if (tree)
    useTree(tree.value(), mesh);
  else
    fuzz::requireSentence(tree.error().message);
  return 0;
}

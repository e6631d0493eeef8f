// SPDX-License-Identifier: GPL-3.0-or-later
//
// Feeds the importer files: the first byte says which of the formats that are checked before assimp sees them, the rest
// is the file.
#include <algorithm>
#include <array>
#include <cstdint>

#include "cairn/builder/import.h"
#include "require.h"
#include "run_program.h"

// assimp loses what it had made of some files it gives up on (a PLY whose header is cut by zeros): nothing we could
// free.
extern "C" const char* __lsan_default_suppressions() {
  return "leak:libassimp\n";
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace cairn;
  if (size == 0) return 0;
  constexpr std::array<const char*, 4> kNames{"mesh.obj", "mesh.off", "mesh.ply", "mesh.stl"};
  const test::TemporaryFolder folder;
  const auto path = folder.path() / kNames[data[0] % kNames.size()];
  std::ofstream(path, std::ios::binary).write(reinterpret_cast<const char*>(data + 1), std::streamsize(size - 1));

  const auto surface = builder::importSurface(path);
  if (!surface) fuzz::requireSentence(surface.error().message);
  if (surface) {
    const builder::TriangleMesh& mesh = surface.value();
    fuzz::require(!mesh.triangles.empty(), "a surface without triangles was accepted");
    for (const Vec3d& v : mesh.vertices) fuzz::require(isFinite(Vec3(v)), "a vertex is not finite");
    for (const builder::Triangle& t : mesh.triangles)
      fuzz::require(std::ranges::all_of(t, [&](std::uint32_t v) { return v < mesh.vertices.size(); }),
                    "a triangle names a vertex that does not exist");
  }
  const auto solid = builder::importMesh(path);
  if (!solid) fuzz::requireSentence(solid.error().message);
  if (solid) fuzz::require(surface.ok() && builder::checkMesh(solid.value()).ok(), "an imported solid is none");
  return 0;
}

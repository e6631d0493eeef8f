// SPDX-License-Identifier: GPL-3.0-or-later
//
// Feeds the importer files: the first byte says which of the formats that are checked before assimp sees them, and in
// which one a surface that was accepted is written and read again; the rest is the file.
#include <algorithm>
#include <array>
#include <cstdint>

#include "cairn/builder/import.h"
#include "cairn/builder/mesh_file.h"
#include "cairn/builder/simplify.h"
#include "mesh_texts.h"
#include "require.h"
#include "run_program.h"

// assimp loses what it had made of some files it gives up on (a PLY whose header is cut by zeros): nothing we could
// free.
extern "C" const char* __lsan_default_suppressions() {
  return "leak:libassimp\n";
}

namespace {

using cairn::builder::TriangleMesh;

// An accepted surface, written by another program, is read as the same triangles.
void requireSameWhenWritten(const TriangleMesh& mesh, unsigned which, const std::filesystem::path& folder) {
  struct Form {
    const char* name;
    std::string (*bytes)(const TriangleMesh&);
  };
  constexpr std::array<Form, 6> kForms{{{"again.obj", cairn::builder::objText},
                                        {"again.off", cairn::test::offText},
                                        {"text.ply", cairn::test::plyText},
                                        {"float.ply", cairn::builder::plyBytes},
                                        {"text.stl", cairn::test::stlText},
                                        {"binary.stl", cairn::test::stlBinary}}};
  const Form& form = kForms[which % kForms.size()];
  std::ofstream(folder / form.name, std::ios::binary) << form.bytes(mesh);
  const auto again = cairn::builder::importSurface(folder / form.name);
  cairn::fuzz::require(again.ok(), std::string("a surface is refused when written as ") + form.name);
  cairn::fuzz::require(again.value().triangles.size() == mesh.triangles.size(),
                       "a surface lost triangles when written");
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    for (int i = 0; i < 3; ++i)
      cairn::fuzz::require(cairn::Vec3(again.value().corners(t)[i]) == cairn::Vec3(mesh.corners(t)[i]),
                           "a surface has other corners when written");
}

}  // namespace

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
    requireSameWhenWritten(mesh, data[0] / kNames.size(), folder.path());
  }
  const auto solid = builder::importMesh(path);
  if (!solid) fuzz::requireSentence(solid.error().message);
  if (solid) fuzz::require(surface.ok() && builder::checkMesh(solid.value()).ok(), "an imported solid is none");
  return 0;
}

// SPDX-License-Identifier: GPL-3.0-or-later
#include <sstream>
#include <string>

#include "builder_meshes.h"
#include "cairn/builder/repair.h"
#include "cairn/core/tree_file.h"
#include "family_demands.h"
#include "geometry_cases.h"
#include "mesh_texts.h"
#include "oracle/tree_difference.h"

// Every vertex written once for each triangle that uses it, or a hundred times, or a hair's breadth apart: the surface
// is cracked along every edge until vertices are welded.
//
//        *-------**-------*
//         \     /  \     /      ** : two vertices at one place, or 1e-12 of
//          \   /    \   /            the size apart
//           \ /      \ /
//            *        *
namespace cairn::hard {
namespace {

/// Corners that floats hold exactly, because `repair` keeps floats.
builder::TriangleMesh solid(Effort effort) {
  return test::moved(test::lumpyBall(effort == Effort::quick ? 2 : 10, 3),
                     [](const Vec3d& v) { return Vec3d(Vec3(v)); });
}

/// OBJ: each vertex `copies` times, each triangle with copies of its own choice, `apart` from each other.
std::string objOfCopies(const builder::TriangleMesh& mesh, std::uint32_t copies, double apart) {
  std::mt19937_64 engine(copies);
  std::ostringstream out;
  out.precision(17);
  for (const Vec3d& v : mesh.vertices)
    for (std::uint32_t i = 0; i < copies; ++i) {
      const Vec3d p = v + test::randomPoint(engine) * (i == 0 ? 0 : apart);
      out << "v " << p.x << ' ' << p.y << ' ' << p.z << '\n';
    }
  for (const builder::Triangle& t : mesh.triangles) {
    out << 'f';
    for (const std::uint32_t v : t) out << ' ' << v * copies + engine() % copies + 1;
    out << '\n';
  }
  return out.str();
}

/// The tree without the hash of the file it came from, which tells one file from another.
std::vector<std::byte> withoutSource(const SphereTree& tree) {
  SphereTreeData data = tree.data();
  data.info.meshName.clear();
  data.info.meshSha256.clear();
  return encodeTree(SphereTree::create(std::move(data)).value());
}

Outcome runDuplicateVertices(Effort effort) {
  FamilyDemands demands(effort, 60);
  const builder::TriangleMesh mesh = solid(effort);
  const auto welded = demands.accepted(demands.import("welded.obj", test::objText(mesh)));
  if (!welded) throw std::runtime_error("a solid was refused");

  const auto base = demands.build(*welded);
  int others = 0;
  const auto same = [&](const char* name, const std::string& bytes) {
    const auto copied = demands.accepted(demands.import(name, bytes));
    const auto tree = copied ? demands.build(*copied) : std::nullopt;
    others += base && tree && withoutSource(*tree) == withoutSource(*base) ? 0 : 1;
  };
  same("soup.stl", test::stlText(mesh));
  same("twice.obj", objOfCopies(mesh, 2, 0));
  same("often.obj", objOfCopies(mesh, 100, 0));
  Outcome outcome{{{"trees that differ from the welded mesh's", double(others), 0, Bound::atMost, "of 3", "", 0}}, ""};

  const double size = builder::boundsOf(mesh).diagonal();
  const std::string cracked = objOfCopies(mesh, 2, 1e-12 * size);
  demands.refuses(demands.import("cracked.obj", cracked), "the mesh is open");
  const auto surface = demands.accepted(demands.importSurface("cracked.obj", cracked));
  const auto mended = surface ? demands.accepted(builder::repair(*surface)) : std::nullopt;
  const auto tree = mended ? demands.build(*mended) : std::nullopt;
  if (base && tree) {
    const TreeDifference apart(*base, *tree);
    outcome.measures.push_back({"cracks of 1e-12, after --repair: balls differ by", apart.balls / size, 1e-4,
                                Bound::atMost, "of size", "", 0});
  }
  demands.addTo(outcome);
  return outcome;
}

}  // namespace

HardCase duplicateVertices() {
  return {
      "G3", "duplicate vertices",
      "a soup, vertices twice and a hundred times: the same tree as the welded mesh, byte for byte (proposed list); "
      "copies 1e-12 of the size apart are refused as open; after --repair their balls are that tree's to 1e-4 of "
      "the size, the resolution of the certificate",
      runDuplicateVertices};
}

}  // namespace cairn::hard

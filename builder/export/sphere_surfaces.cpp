// SPDX-License-Identifier: GPL-3.0-or-later
//
// Only this file writes with assimp.
#include <assimp/scene.h>
#include <fmt/format.h>

#include <algorithm>
#include <assimp/Exporter.hpp>
#include <cstddef>
#include <exception>
#include <memory>
#include <span>
#include <vector>

#include "cairn/builder/export.h"
#include "cairn/core/atomic_file.h"
#include "surface/icosphere.h"

namespace cairn::builder {
namespace {

constexpr int kSubdivisions = 2;  // 320 triangles a sphere: round at a glance, 160 000 for 512 spheres

/// One mesh with all spheres.
std::unique_ptr<aiMesh> meshOf(std::span<const Ball> balls) {
  const TriangleMesh unit = unitIcosphere(kSubdivisions);
  auto mesh = std::make_unique<aiMesh>();
  mesh->mPrimitiveTypes = aiPrimitiveType_TRIANGLE;
  mesh->mNumVertices = static_cast<unsigned>(unit.vertices.size() * balls.size());
  mesh->mVertices = new aiVector3D[mesh->mNumVertices];  // aiMesh deletes them
  mesh->mNormals = new aiVector3D[mesh->mNumVertices];
  mesh->mNumFaces = static_cast<unsigned>(unit.triangles.size() * balls.size());
  mesh->mFaces = new aiFace[mesh->mNumFaces];
  unsigned vertex = 0, face = 0;
  for (const Ball& ball : balls) {
    const unsigned first = vertex;
    for (const Vec3d& direction : unit.vertices) {
      const Vec3 n(direction), p(ball.center + direction * ball.radius);
      mesh->mNormals[vertex] = {n.x, n.y, n.z};
      mesh->mVertices[vertex++] = {p.x, p.y, p.z};
    }
    for (const Triangle& t : unit.triangles) {
      aiFace& target = mesh->mFaces[face++];
      target.mNumIndices = 3;
      target.mIndices = new unsigned[3]{first + t[0], first + t[1], first + t[2]};
    }
  }
  return mesh;
}

std::unique_ptr<aiScene> sceneOf(std::unique_ptr<aiMesh> mesh) {
  auto scene = std::make_unique<aiScene>();  // owns and deletes all it points to
  scene->mNumMaterials = 1;
  scene->mMaterials = new aiMaterial* [1] { new aiMaterial };
  scene->mNumMeshes = 1;
  scene->mMeshes = new aiMesh* [1] { mesh.release() };
  scene->mRootNode = new aiNode("spheres");
  scene->mRootNode->mNumMeshes = 1;
  scene->mRootNode->mMeshes = new unsigned[1]{0};
  return scene;
}

/// In memory, because assimp's writer of OBJ files does not notice a full disk.
Result<std::vector<std::byte>> bytesOf(const aiScene& scene, SurfaceFormat format) {
  // "objnomtl": the plain one would come with a material file.
  const char* id = format == SurfaceFormat::obj ? "objnomtl" : "glb2";
  try {
    Assimp::Exporter exporter;
    const aiExportDataBlob* blob = exporter.ExportToBlob(&scene, id);
    if (blob == nullptr)
      return Error{fmt::format("assimp cannot write it ({}); choose another format", exporter.GetErrorString())};
    const auto* first = static_cast<const std::byte*>(blob->data);
    return std::vector<std::byte>(first, first + blob->size);
  } catch (const std::exception& e) {
    return Error{fmt::format("assimp failed to write it ({}); choose another format", e.what())};
  }
}

}  // namespace

Status writeSphereSurfaces(const SphereTree& tree, std::uint32_t level, SurfaceFormat format,
                           const std::filesystem::path& path) {
  const Result<std::vector<Ball>> balls = ballsOfLevel(tree, level);
  return balls ? writeSphereSurfaces(balls.value(), format, path) : balls.error();
}

Status writeSphereSurfaces(std::span<const Ball> balls, SurfaceFormat format, const std::filesystem::path& path) {
  const std::unique_ptr<aiScene> scene = sceneOf(meshOf(balls));
  const auto bytes = bytesOf(*scene, format);
  return bytes ? writeFileAtomically(path, std::span(bytes.value())) : bytes.error();
}

}  // namespace cairn::builder

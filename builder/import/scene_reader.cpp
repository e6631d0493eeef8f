// SPDX-License-Identifier: GPL-3.0-or-later
#include "import/scene_reader.h"

#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <assimp/Importer.hpp>
#include <exception>
#include <utility>

#include "cairn/builder/import.h"

namespace cairn::builder {
namespace {

/// Affine placement in double; assimp's own flattening works in float.
struct Placement {
  Mat3d linear;
  Vec3d offset;

  Vec3d operator()(const aiVector3D& p) const { return linear * Vec3d(p.x, p.y, p.z) + offset; }
  bool mirrors() const { return dot(linear.rows[0], cross(linear.rows[1], linear.rows[2])) < 0; }
};

Placement after(const Placement& parent, const aiMatrix4x4& m) {
  const Mat3d linear{{Vec3d(m.a1, m.a2, m.a3), Vec3d(m.b1, m.b2, m.b3), Vec3d(m.c1, m.c2, m.c3)}};
  return {parent.linear * linear, parent.linear * Vec3d(m.a4, m.b4, m.c4) + parent.offset};
}

/// Appends one mesh. False when a face names a vertex the mesh does not have.
bool appendMesh(const aiMesh& mesh, const Placement& placement, TriangleSoup& soup) {
  for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
    const aiFace& face = mesh.mFaces[f];
    if (face.mNumIndices != 3) continue;  // points and lines of a mixed mesh
    std::array<Vec3d, 3> corners;
    for (int i = 0; i < 3; ++i) {
      if (face.mIndices[i] >= mesh.mNumVertices) return false;
      corners[i] = placement(mesh.mVertices[face.mIndices[i]]);
    }
    if (placement.mirrors()) std::swap(corners[1], corners[2]);
    soup.push_back(corners);
  }
  return true;
}

bool appendNode(const aiScene& scene, const aiNode& node, const Placement& parent, TriangleSoup& soup) {
  const Placement placement = after(parent, node.mTransformation);
  for (unsigned i = 0; i < node.mNumMeshes; ++i) {
    if (node.mMeshes[i] >= scene.mNumMeshes) return false;
    if (!appendMesh(*scene.mMeshes[node.mMeshes[i]], placement, soup)) return false;
  }
  for (unsigned i = 0; i < node.mNumChildren; ++i) {
    if (!appendNode(scene, *node.mChildren[i], placement, soup)) return false;
  }
  return true;
}

bool reads(const Assimp::Importer& importer, const std::filesystem::path& path) {
  return path.has_extension() && importer.IsExtensionSupported(path.extension().string());
}

/// Reads the file itself when `text` is empty.
Result<TriangleSoup> readScene(const std::filesystem::path& path, std::span<const std::byte> text, UpDirection up) {
  const std::string file = path.filename().string();
  Assimp::Importer importer;
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, up == UpDirection::ignored);
  if (!reads(importer, path))
    return Error{
        fmt::format("{}: '{}' is not the extension of a mesh format assimp reads; export it as OBJ, OFF, PLY, STL "
                    "or glTF",
                    file, path.extension().string())};
  constexpr unsigned kSteps = aiProcess_Triangulate | aiProcess_ValidateDataStructure;
  const std::string format = path.extension().string().substr(1);
  const aiScene* scene = text.empty() ? importer.ReadFile(path.string(), kSteps)
                                      : importer.ReadFileFromMemory(text.data(), text.size(), kSteps, format.c_str());
  if (scene == nullptr || scene->mRootNode == nullptr)
    return Error{fmt::format("{}: assimp cannot read it ({}); check that the file is complete and export it again",
                             file, importer.GetErrorString())};
  TriangleSoup soup;
  if (!appendNode(*scene, *scene->mRootNode, {}, soup))
    return Error{fmt::format("{}: a face names a vertex the file does not have; export it again", file)};
  if (soup.empty()) return Error{fmt::format("{}: it holds no triangles; export a surface mesh", file)};
  return soup;
}

}  // namespace

bool isMeshFile(const std::filesystem::path& path) {
  return reads(Assimp::Importer(), path);
}

Result<TriangleSoup> readTriangles(const std::filesystem::path& path, UpDirection up) {
  return readTriangles(path, {}, up);
}

Result<TriangleSoup> readTriangles(const std::filesystem::path& path, std::span<const std::byte> text, UpDirection up) {
  try {
    return readScene(path, text, up);
  } catch (const std::exception& e) {
    return Error{fmt::format("{}: assimp failed on it ({}); check that the file is complete and export it again",
                             path.filename().string(), e.what())};
  }
}

}  // namespace cairn::builder

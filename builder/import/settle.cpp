// SPDX-License-Identifier: GPL-3.0-or-later
#include "import/settle.h"

#include <bit>
#include <span>
#include <string>

#include "cairn/builder/mesh_file.h"
#include "cairn/builder/sha256.h"
#include "import/weld.h"

namespace cairn::builder {
namespace {

/// Little-endian on every machine.
void appendBits(std::string& bytes, std::uint32_t bits) {
  for (int shift = 0; shift < 32; shift += 8) bytes.push_back(static_cast<char>(bits >> shift & 0xFF));
}

}  // namespace

std::string plyBytes(const TriangleMesh& mesh) {
  std::string bytes = "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(mesh.vertices.size()) +
                      "\nproperty float x\nproperty float y\nproperty float z\nelement face " +
                      std::to_string(mesh.triangles.size()) + "\nproperty list uchar int vertex_indices\nend_header\n";
  for (const Vec3d& v : mesh.vertices) {
    for (int axis = 0; axis < 3; ++axis) appendBits(bytes, std::bit_cast<std::uint32_t>(static_cast<float>(v[axis])));
  }
  for (const Triangle& t : mesh.triangles) {
    bytes.push_back(3);
    for (const std::uint32_t v : t) appendBits(bytes, v);
  }
  return bytes;
}

TriangleMesh settled(const TriangleMesh& mesh) {
  TriangleSoup soup(mesh.triangles.size());
  for (std::uint32_t t = 0; t < soup.size(); ++t) {
    soup[t] = mesh.corners(t);
    for (Vec3d& corner : soup[t]) corner = Vec3d(Vec3(corner));
  }
  ImportCounts ignored;  // a wrongly dropped triangle shows as an open edge
  TriangleMesh result = weld(soup, ignored);
  result.name = mesh.name;
  const std::string bytes = plyBytes(result);
  result.sha256 = sha256Hex(std::as_bytes(std::span(bytes)));
  return result;
}

}  // namespace cairn::builder

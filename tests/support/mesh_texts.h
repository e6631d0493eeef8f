// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <sstream>
#include <string>

#include "cairn/builder/triangle_mesh.h"

/// Meshes as other programs write them, 17 digits to a coordinate. OBJ is `objText`.
namespace cairn::test {

inline std::string offText(const builder::TriangleMesh& mesh) {
  std::ostringstream out;
  out.precision(17);
  out << "OFF\n# a comment\n" << mesh.vertices.size() << ' ' << mesh.triangles.size() << " 0\n";
  for (const Vec3d& v : mesh.vertices) out << v.x << ' ' << v.y << ' ' << v.z << '\n';
  for (const builder::Triangle& t : mesh.triangles) out << "3 " << t[0] << ' ' << t[1] << ' ' << t[2] << '\n';
  return out.str();
}

inline std::string plyText(const builder::TriangleMesh& mesh) {
  std::ostringstream out;
  out.precision(17);
  out << "ply\nformat ascii 1.0\nelement vertex " << mesh.vertices.size()
      << "\nproperty double x\nproperty double y\nproperty double z\nelement face " << mesh.triangles.size()
      << "\nproperty list uchar int vertex_indices\nend_header\n";
  for (const Vec3d& v : mesh.vertices) out << v.x << ' ' << v.y << ' ' << v.z << '\n';
  for (const builder::Triangle& t : mesh.triangles) out << "3 " << t[0] << ' ' << t[1] << ' ' << t[2] << '\n';
  return out.str();
}

inline std::string stlText(const builder::TriangleMesh& mesh) {
  std::ostringstream out;
  out.precision(17);
  out << "solid test\n";
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    out << "facet normal 0 0 0\nouter loop\n";
    for (const Vec3d& c : mesh.corners(t)) out << "vertex " << c.x << ' ' << c.y << ' ' << c.z << '\n';
    out << "endloop\nendfacet\n";
  }
  out << "endsolid test\n";
  return out.str();
}

template <class T>
void appendBytes(std::string& text, const T& value) {
  text.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// Doubles, and faces of 16-bit vertex numbers. Precondition: fewer than 2^16 vertices.
inline std::string plyBinary(const builder::TriangleMesh& mesh) {
  std::string bytes = "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(mesh.vertices.size()) +
                      "\nproperty double x\nproperty double y\nproperty double z\nelement face " +
                      std::to_string(mesh.triangles.size()) + "\nproperty list uchar ushort vertex_index\nend_header\n";
  for (const Vec3d& v : mesh.vertices) appendBytes(bytes, v);
  for (const builder::Triangle& t : mesh.triangles) {
    bytes.push_back(3);
    for (const std::uint32_t v : t) appendBytes(bytes, static_cast<std::uint16_t>(v));
  }
  return bytes;
}

inline std::string stlBinary(const builder::TriangleMesh& mesh) {
  std::string bytes(80, ' ');
  appendBytes(bytes, static_cast<std::uint32_t>(mesh.triangles.size()));
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    appendBytes(bytes, Vec3{});
    for (const Vec3d& c : mesh.corners(t)) appendBytes(bytes, Vec3(c));
    bytes.append(2, '\0');
  }
  return bytes;
}

}  // namespace cairn::test

// SPDX-License-Identifier: GPL-3.0-or-later
// Formats that carry doubles give them back, so that where a mesh lies on disk matters as little as in memory.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <string>

#include "builder_meshes.h"
#include "cairn/builder/build.h"
#include "cairn/builder/import.h"
#include "mesh_texts.h"
#include "placed_mesh.h"
#include "run_program.h"

namespace cairn::builder::double_precision_test {
namespace {

/// The same values, most significant byte first.
std::string plyBigEndian(const TriangleMesh& mesh) {
  const auto append = [](std::string& bytes, auto value) {
    std::string bits;
    test::appendBytes(bits, value);
    if constexpr (std::endian::native == std::endian::little) std::reverse(bits.begin(), bits.end());
    bytes += bits;
  };
  std::string bytes =
      "ply\nformat binary_big_endian 1.0\nelement camera 1\nproperty list uchar float view\nelement vertex " +
      std::to_string(mesh.vertices.size()) +
      "\nproperty uchar red\nproperty double x\nproperty double y\nproperty double z\nelement face " +
      std::to_string(mesh.triangles.size()) +
      "\nproperty list ushort int vertex_indices\nproperty short id\nend_header\n";
  append(bytes, std::uint8_t{2});
  append(bytes, 1.5F);
  append(bytes, 2.5F);
  for (const Vec3d& v : mesh.vertices) {
    append(bytes, std::uint8_t{7});
    for (int axis = 0; axis < 3; ++axis) append(bytes, v[axis]);
  }
  for (const Triangle& t : mesh.triangles) {
    append(bytes, std::uint16_t{3});
    for (const std::uint32_t v : t) append(bytes, static_cast<std::int32_t>(v));
    append(bytes, std::int16_t{-1});
  }
  return bytes;
}

struct Format {
  const char* name;
  std::string (*text)(const TriangleMesh&);
};

/// A turn, then a scale, then a shift far away.
struct Move {
  double scale, shift;

  TriangleMesh of(const TriangleMesh& mesh) const {
    return test::moved(test::placedMesh(mesh, scale), [&](const Vec3d& p) { return p + Vec3d(shift, shift, -shift); });
  }
  std::string text() const { return "scale " + std::to_string(scale) + ", shift " + std::to_string(shift); }
};

class DoublePrecision : public testing::TestWithParam<Format> {
 protected:
  static Result<TriangleMesh> throughAFile(const TriangleMesh& mesh) {
    const test::TemporaryFolder folder;
    return importMesh(test::writeText(folder.path() / GetParam().name, GetParam().text(mesh)));
  }
};

INSTANTIATE_TEST_SUITE_P(Formats, DoublePrecision,
                         testing::Values(Format{"mesh.obj", test::objText}, Format{"mesh.off", test::offText},
                                         Format{"text.ply", test::plyText}, Format{"little.ply", test::plyBinary},
                                         Format{"big.ply", plyBigEndian}, Format{"text.stl", test::stlText}),
                         [](const auto& format) {
                           std::string name = format.param.name;
                           name[name.find('.')] = '_';
                           return name;
                         });

TEST_P(DoublePrecision, GivesBackTheSameDoubles) {
  for (const Move& move : {Move{1.0, 0.0}, {1e-6, 0.0}, {1e6, 0.0}, {1.0, 1e6}, {1e-12, 0.0}}) {
    SCOPED_TRACE(move.text());
    const TriangleMesh mesh = move.of(test::lumpyBall(4, 11));
    const Result<TriangleMesh> read = throughAFile(mesh);
    ASSERT_TRUE(read.ok()) << read.error().message;
    ASSERT_EQ(read.value().triangles.size(), mesh.triangles.size());
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
      ASSERT_EQ(read.value().corners(t), mesh.corners(t)) << "triangle " << t;
  }
}

/// Within what the same movements change in memory: see `BodyFrame`.
TEST_P(DoublePrecision, AdaptiveLevelsAreTheSameHoweverTheFilesMeshLies) {
  const TriangleMesh mesh = test::lumpyBall(1, 5);
  const auto as = buildTree(mesh, test::quickAdaptive());
  ASSERT_TRUE(as);
  for (const Move& move : {Move{1e-6, 0.0}, {1e6, 0.0}, {1.0, 1e6}}) {
    SCOPED_TRACE(move.text());
    const Result<TriangleMesh> read = throughAFile(move.of(mesh));
    ASSERT_TRUE(read.ok()) << read.error().message;
    test::expectSameLevels(mesh, as.value(), read.value(), move.scale);
  }
}

}  // namespace
}  // namespace cairn::builder::double_precision_test

// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cstring>
#include <string>

#include "builder_meshes.h"
#include "cairn/builder/import.h"
#include "mesh_texts.h"
#include "run_program.h"
#include "surface/mass_properties.h"

namespace cairn::builder::import_test {
namespace {

using test::appendBytes;
using test::cuboid;
using test::meshOf;
using test::offText;
using test::plyBinary;
using test::plyText;
using test::stlBinary;
using test::stlText;

/// Corners of the triangles in the order of the file, as floats: what every format keeps of them.
void expectSameSurface(const TriangleMesh& a, const TriangleMesh& b) {
  ASSERT_EQ(a.triangles.size(), b.triangles.size());
  for (std::uint32_t t = 0; t < a.triangles.size(); ++t) {
    for (int i = 0; i < 3; ++i) EXPECT_EQ(Vec3(a.corners(t)[i]), Vec3(b.corners(t)[i])) << "triangle " << t;
  }
}

struct Format {
  const char* name;
  std::string (*text)(const TriangleMesh&);
};

class ImportFormat : public testing::TestWithParam<Format> {};

TEST_P(ImportFormat, GivesBackTheSurface) {
  const test::TemporaryFolder folder;
  const TriangleMesh mesh = test::lumpyBall(4, 11);
  const auto path = test::writeText(folder.path() / GetParam().name, GetParam().text(mesh));
  const Result<TriangleMesh> read = importMesh(path);
  ASSERT_TRUE(read.ok()) << read.error().message;
  expectSameSurface(read.value(), mesh);
  EXPECT_EQ(read.value().vertices.size(), mesh.vertices.size());  // also a soup's corners are welded
  EXPECT_EQ(read.value().name, GetParam().name);
  EXPECT_EQ(read.value().sha256.size(), 64U);
}

INSTANTIATE_TEST_SUITE_P(Formats, ImportFormat,
                         testing::Values(Format{"mesh.obj", test::objText}, Format{"mesh.off", offText},
                                         Format{"mesh.ply", plyText}, Format{"text.stl", stlText},
                                         Format{"binary.stl", stlBinary}, Format{"binary.ply", plyBinary}),
                         [](const auto& format) {
                           return std::string(format.param.name).substr(0, 4) + std::to_string(format.index);
                         });

TEST(Import, AppliesNodeTransformsAndMirrors) {
  const test::TemporaryFolder folder;
  const TriangleMesh cube = meshOf(cuboid({2, 2, 2}, 1));
  std::string buffer;
  for (const Vec3d& v : cube.vertices) appendBytes(buffer, Vec3(v));
  const std::size_t positions = buffer.size();
  for (const Triangle& t : cube.triangles) {
    for (const std::uint32_t v : t) appendBytes(buffer, static_cast<std::uint16_t>(v));
  }
  test::writeText(folder.path() / "cube.bin", buffer);
  std::ostringstream json;
  json << R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],)"
       << R"("nodes":[{"scale":[2,2,2],"children":[1,2]},{"mesh":0,"translation":[5,0,0]},)"
       << R"({"mesh":0,"translation":[-5,0,0],"scale":[-1,1,1]}],)"
       << R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],)"
       << R"("buffers":[{"uri":"cube.bin","byteLength":)" << buffer.size() << "}],"
       << R"("bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":)" << positions << R"(},{"buffer":0,"byteOffset":)"
       << positions << R"(,"byteLength":)" << buffer.size() - positions << "}],"
       << R"("accessors":[{"bufferView":0,"componentType":5126,"type":"VEC3","count":)" << cube.vertices.size()
       << R"(,"min":[-1,-1,-1],"max":[1,1,1]},{"bufferView":1,"componentType":5123,"type":"SCALAR","count":)"
       << 3 * cube.triangles.size() << "}]}";
  const Result<TriangleMesh> read = importMesh(test::writeText(folder.path() / "cubes.gltf", json.str()));
  ASSERT_TRUE(read.ok()) << read.error().message;
  EXPECT_EQ(read.value().triangles.size(), 24U);
  EXPECT_NEAR(signedVolume(read.value()), 2 * 64, 1e-3);  // both outward, the mirrored one too
  EXPECT_NEAR(boundsOf(read.value()).lower.x, -12, 1e-5);
  EXPECT_NEAR(boundsOf(read.value()).upper.x, 12, 1e-5);
}

TEST(Import, TriangulatesPolygonsAndResolvesNegativeIndices) {
  const test::TemporaryFolder folder;
  const auto path = test::writeText(folder.path() / "cube.obj",
                                    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
                                    "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf -8 -4 -1 -5\n");
  const Result<TriangleMesh> read = importMesh(path);
  ASSERT_TRUE(read.ok()) << read.error().message;
  EXPECT_NEAR(signedVolume(read.value()), 1, 1e-12);
}

TEST(Import, ReadsTheRarerFormsOfOffAndObj) {
  const test::TemporaryFolder folder;
  const TriangleMesh cube = meshOf(cuboid({1, 2, 3}, 1));
  std::ostringstream weighed, oldFaces, coloured, decorated;
  decorated << "STCNOFF\n" << cube.vertices.size() << ' ' << cube.triangles.size() << " 0\n";
  for (const Vec3d& v : cube.vertices) {
    weighed << "v " << 4 * v.x << ' ' << 4 * v.y << ' ' << 4 * v.z << " 4\n";
    coloured << "v " << v.x << ' ' << v.y << ' ' << v.z << " 0.5 0.25 1\n";
    decorated << v.x << ' ' << v.y << ' ' << v.z << " 0 0 1 255 0 0 255 0.5 0.5\n";
  }
  for (const Triangle& t : cube.triangles) {
    weighed << "f\t" << t[0] + 1 << "//1\t" << t[1] + 1 << "//1\t" << t[2] + 1 << "//1\n";
    oldFaces << "fo " << t[0] + 1 << ' ' << t[1] + 1 << ' ' << t[2] + 1 << '\n';
    decorated << "3 " << t[0] << ' ' << t[1] << ' ' << t[2] << " 255 0 0\n";
  }
  const auto expectCube = [&](const char* name, const std::string& text) {
    const Result<TriangleMesh> read = importMesh(test::writeText(folder.path() / name, text));
    ASSERT_TRUE(read.ok()) << read.error().message;
    expectSameSurface(read.value(), cube);
  };
  expectCube("weighed.obj", weighed.str());
  expectCube("coloured.obj", "l 1 2\np 1\no thing\n" + coloured.str() + oldFaces.str());
  expectCube("decorated.off", decorated.str());
}

TEST(Import, ReadsCountsOfAnOffEachOnALineOfItsOwn) {
  const test::TemporaryFolder folder;
  const TriangleMesh cube = meshOf(cuboid({1, 2, 3}, 1));
  std::string text = offText(cube);
  const auto expectCube = [&](const std::string& counts) {
    std::string other = text;
    other.replace(other.find("8 12 0"), 6, counts);
    const Result<TriangleMesh> read = importMesh(test::writeText(folder.path() / "cube.off", other));
    ASSERT_TRUE(read.ok()) << counts << ": " << read.error().message;
    expectSameSurface(read.value(), cube);
  };
  for (const char* counts : {"8\n12\n0", "8\n12 0", "8 12\n0", "8 12", "8 # vertices\n\n12 # faces\n0"})
    expectCube(counts);
}

TEST(Import, ReadsLinesOfAnObjThatABackslashContinues) {
  const test::TemporaryFolder folder;
  const TriangleMesh cube = meshOf(cuboid({1, 2, 3}, 1));
  std::ostringstream text;
  for (const Vec3d& v : cube.vertices) text << "v " << v.x << " \\\n  " << v.y << "\\\r\n" << v.z << '\n';
  for (const Triangle& t : cube.triangles)
    text << "f \\\n" << t[0] + 1 << ' ' << t[1] + 1 << " \\\n " << t[2] + 1 << '\n';
  const Result<TriangleMesh> read = importMesh(test::writeText(folder.path() / "cube.obj", text.str()));
  ASSERT_TRUE(read.ok()) << read.error().message;
  expectSameSurface(read.value(), cube);
}

TEST(Import, TakesWhatIsTooSmallForADoubleForZero) {
  const test::TemporaryFolder folder;
  const auto path = test::writeText(
      folder.path() / "a.obj", "v 1e-400 0 -1e-4000\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n");
  const Result<TriangleMesh> read = importMesh(path);
  ASSERT_TRUE(read.ok()) << read.error().message;
  EXPECT_EQ(boundsOf(read.value()).lower.x, 0);
  EXPECT_EQ(boundsOf(read.value()).lower.z, 0);
}

TEST(Import, ReadsTextStlOfAnyCaseAndLayout) {
  const test::TemporaryFolder folder;
  const TriangleMesh cube = meshOf(cuboid({1, 2, 3}, 1));
  std::string upper = stlText(cube), layout = " \n\t";
  std::ranges::transform(upper, upper.begin(), [](unsigned char c) { return char(std::toupper(c)); });
  for (const char c : stlText(cube)) layout += c == '\n' ? "\r\n\t " : std::string(1, c);
  std::string joined = stlText(cube);  // all but the solid's name on one line
  std::replace(joined.begin() + std::ptrdiff_t(joined.find('\n')) + 1, joined.end(), '\n', ' ');
  for (const std::string& text : {upper, layout, joined}) {
    const Result<TriangleMesh> read = importMesh(test::writeText(folder.path() / "cube.stl", text));
    ASSERT_TRUE(read.ok()) << read.error().message;
    expectSameSurface(read.value(), cube);
  }
}

TEST(Import, ReadsBinaryStlWhoseHeaderBeginsAsATextDoes) {
  const test::TemporaryFolder folder;
  const TriangleMesh cube = meshOf(cuboid({1, 2, 3}, 1));
  for (const char* header : {"solid", "solid facet normal 0 0 1 outer loop", "SOLID x", "COLOR=\x80\x80\x80\xff"}) {
    std::string bytes = stlBinary(cube);
    bytes.replace(0, std::strlen(header), header);
    const Result<TriangleMesh> read = importMesh(test::writeText(folder.path() / "cube.stl", bytes));
    ASSERT_TRUE(read.ok()) << header << ": " << read.error().message;
    expectSameSurface(read.value(), cube);
  }
}

TEST(Import, PassesOverAByteOrderMark) {
  const test::TemporaryFolder folder;
  const TriangleMesh cube = meshOf(cuboid({1, 1, 1}, 1));
  for (const Format& format :
       {Format{"a.obj", test::objText}, Format{"a.off", offText}, Format{"A.OBJ", test::objText}}) {
    const Result<TriangleMesh> read =
        importMesh(test::writeText(folder.path() / format.name, "\xEF\xBB\xBF" + format.text(cube)));
    ASSERT_TRUE(read.ok()) << read.error().message;
    expectSameSurface(read.value(), cube);
  }
}

TEST(Import, NamesTheOmissionThatOpensATJunction) {
  // The side of a cube has a vertex in the middle of an edge; a triangle without area joins it to the edge's ends.
  const test::TemporaryFolder folder;
  const std::string text =
      "v 0 0 0\nv 0 0 1\nv 0 1 0\nv 0 1 1\nv 1 0 0\nv 1 0 1\nv 1 1 0\nv 1 1 1\nv 0 0 0.5\n"
      "f 1 4 3\nf 5 7 8\nf 5 8 6\nf 1 5 6\nf 1 6 2\nf 3 4 8\nf 3 8 7\nf 1 3 7\nf 1 7 5\nf 2 6 8\nf 2 8 4\n"
      "f 1 9 4\nf 9 2 4\nf 1 2 9\n";
  const Result<TriangleMesh> read = importMesh(test::writeText(folder.path() / "tj.obj", text));
  ASSERT_FALSE(read.ok());
  EXPECT_NE(read.error().message.find("the mesh is open"), std::string::npos) << read.error().message;
  EXPECT_NE(read.error().message.find("after 1 triangle without area was left out"), std::string::npos)
      << read.error().message;
}

TEST(Import, CountsTrianglesWithoutArea) {
  const test::TemporaryFolder folder;
  const std::string text = test::objText(meshOf(cuboid({1, 1, 1}, 1))) + "f 1 1 2\nf 3 3 3\n";
  ImportCounts counts;
  const Result<TriangleMesh> read = importMesh(test::writeText(folder.path() / "cube.obj", text), &counts);
  ASSERT_TRUE(read.ok()) << read.error().message;
  EXPECT_EQ(counts.degenerateTriangles, 2U);
  EXPECT_EQ(read.value().triangles.size(), 12U);
}

TEST(Import, LeavesOutVerticesNobodyUses) {
  const test::TemporaryFolder folder;
  const std::string text = "v 9 9 9\n" + std::string("v 8 8 8\n");
  std::string cube = test::objText(meshOf(cuboid({1, 1, 1}, 1)));
  const Result<TriangleMesh> read = importMesh(test::writeText(folder.path() / "cube.obj", cube + text));
  ASSERT_TRUE(read.ok()) << read.error().message;
  EXPECT_EQ(read.value().vertices.size(), 8U);
}

}  // namespace
}  // namespace cairn::builder::import_test

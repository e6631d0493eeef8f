// SPDX-License-Identifier: GPL-3.0-or-later
// Forms that PLY allows, and files that are refused.
#include <gtest/gtest.h>

#include <cstring>
#include <string>

#include "builder_meshes.h"
#include "cairn/builder/import.h"
#include "mesh_texts.h"
#include "run_program.h"

namespace cairn::builder::import_refusal_test {
namespace {

using test::appendBytes;
using test::cuboid;
using test::meshOf;
using test::offText;
using test::plyBinary;
using test::plyText;
using test::stlBinary;
using test::stlText;

struct Format {
  const char* name;
  std::string (*text)(const TriangleMesh&);
};

/// The header of a PLY of four vertices and two faces.
std::string plyHeader(const std::string& format) {
  return "ply\nformat " + format + " 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n" +
         "element face 2\nproperty list uchar int vertex_indices\nend_header\n";
}

/// The header of a PLY of four vertices and one strip.
std::string plyOfStrip(const std::string& format) {
  return "ply\nformat " + format + " 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n" +
         "element tristrips 1\nproperty list int int vertex_indices\nend_header\n";
}

const std::string kTetrahedronPoints = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n";

std::string plyTextWithFace(const std::string& second) {
  return plyHeader("ascii") + "0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 1 2\n" + second + "\n";
}

/// Binary, little-endian; the second face has `corners` corners.
std::string plyBinaryWithFace(std::uint8_t corners) {
  std::string bytes = plyHeader("binary_little_endian");
  for (const Vec3& v : {Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) appendBytes(bytes, v);
  for (const std::uint8_t count : {std::uint8_t{3}, corners}) {
    appendBytes(bytes, count);
    for (std::int32_t i = 0; i < count; ++i) appendBytes(bytes, i);
  }
  return bytes;
}

TEST(ImportPly, PassesOverWhatABinaryFileIsPaddedWith) {
  const test::TemporaryFolder folder;
  for (const std::string& padding : {std::string("\r\n"), std::string(6, '\0')}) {
    const auto file = test::writeText(folder.path() / "a.ply", plyBinaryWithFace(3) + padding);
    const Result<TriangleMesh> read = importSurface(file);
    ASSERT_TRUE(read.ok()) << read.error().message;
    EXPECT_EQ(read.value().triangles.size(), 2U);
  }
}

// 0 1 2 | 1 2 3 turned | ... of a strip, and of one begun anew: the four sides of a tetrahedron, outwards.
TEST(ImportPly, ReadsStripsAsTriangles) {
  const test::TemporaryFolder folder;
  for (const std::string strip : {"6 0 2 1 3 0 2", "9 0 2 1 -1 2 3 1 0 2", "10 0 2 1 3 -1 3 0 2 -1 3"}) {
    SCOPED_TRACE(strip);
    const std::string text = plyOfStrip("ascii") + kTetrahedronPoints + strip + "\n";
    const Result<TriangleMesh> read = importSurface(test::writeText(folder.path() / "a.ply", text));
    ASSERT_TRUE(read.ok()) << read.error().message;
    EXPECT_EQ(read.value().vertices.size(), 4U);
  }
  const std::string text = plyOfStrip("ascii") + kTetrahedronPoints + "6 0 2 1 3 0 2\n";
  const Result<TriangleMesh> solid = importMesh(test::writeText(folder.path() / "a.ply", text));
  ASSERT_TRUE(solid.ok()) << solid.error().message;
  EXPECT_EQ(solid.value().triangles.size(), 4U);
}

struct BadFile {
  const char* test;
  const char* name;
  std::string text;
  const char* message;  // a part of it
};

class ImportRefuses : public testing::TestWithParam<BadFile> {};

TEST_P(ImportRefuses, WithOneSentence) {
  const test::TemporaryFolder folder;
  const Result<TriangleMesh> read = importMesh(test::writeText(folder.path() / GetParam().name, GetParam().text));
  ASSERT_FALSE(read.ok());
  EXPECT_NE(read.error().message.find(GetParam().message), std::string::npos) << read.error().message;
  EXPECT_NE(read.error().message.find(GetParam().name), std::string::npos) << read.error().message;
  EXPECT_EQ(read.error().message.find('\n'), std::string::npos) << read.error().message;
}

const std::string kTetrahedron = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";

INSTANTIATE_TEST_SUITE_P(
    Files, ImportRefuses,
    testing::Values(
        BadFile{"Empty", "a.obj", "", "is empty"},  //
        BadFile{"UnknownFormat", "a.xyzzy", "hello", "not the extension of a mesh format"},
        BadFile{"NoTriangles", "a.obj", kTetrahedron, "a.obj"},
        BadFile{"ObjNan", "a.obj", "v 0 0 0\nv nan 0 0\n", "line 2: the coordinate nan is not finite"},
        BadFile{"ObjHuge", "a.obj", "v 0 0 0\nv 1e300 0 0\n", "line 2: the coordinate 1e300 is not finite"},
        BadFile{"ObjHuger", "a.obj", "v 0 0 0\nv 0 -1e400 0\n", "line 2: the coordinate -1e400 is not finite"},
        BadFile{"ObjWord", "a.obj", "v 0 0 0\nv 1 x 0\n", "line 2: 'x' is not a coordinate"},
        BadFile{"ObjTruncatedVertex", "a.obj", "v 0 0 0\nv 1 2", "line 2: a vertex needs three coordinates"},
        BadFile{"ObjIndexTooLarge", "a.obj", kTetrahedron + "f 1 3 2\nf 1 2 9\n",
                "line 6: the face names vertex 9 but the file has 4"},
        BadFile{"ObjIndexZero", "a.obj", kTetrahedron + "f 0 1 2\n", "line 5: '0' does not name a vertex"},
        BadFile{"ObjIndexTooNegative", "a.obj", kTetrahedron + "f -1 -2 -9\n", "line 5: the face names vertex -4"},
        BadFile{"ObjTruncatedFace", "a.obj", kTetrahedron + "f 1 2", "line 5: a face needs at least three vertices"},
        BadFile{"OffTruncatedVertices", "a.off", "OFF\n4 4 0\n0 0 0\n1 0 0\n", "ends after 2 of 4 vertices"},
        BadFile{"OffTruncatedFaces", "a.off", "OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", "ends after 1 of 2 faces"},
        BadFile{"OffIndex", "a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n",
                "line 6: '7' does not name one of the 3"},
        BadFile{"OffCutFace", "a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1\n",
                "line 6: the face ends after 2 of 3 corners"},
        BadFile{"OffSeveralOnALine", "a.off", "OFF\n3 1 0\n0 0 0 1 0 0 0 1 0\n3 0 1 2\n",
                "ends after 2 of 3 vertices, one a line; it is truncated or writes several on a line"},
        BadFile{"OffMoreFaces", "a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 0 2 1\n",
                "line 7: the file goes on after the 3 vertices and 1 faces it promises"},
        BadFile{"OffWithoutCounts", "a.off", "OFF\n3\n", "the counts of vertices and faces are missing"},
        BadFile{"OffBinary", "a.off", "OFF BINARY\n", "line 1: binary OFF is not supported"},
        BadFile{"OffNotOff", "a.off", "hello\n", "line 1: an OFF file begins with the word OFF"},
        BadFile{"StlTruncatedText", "a.stl", "solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0", "truncated"},
        BadFile{"StlTruncatedBinary", "a.stl",
                std::string(80, ' ') + std::string("\x0c\0\0\0", 4) + std::string(99, 'a'),
                "183 bytes are too few for a binary STL of 12 triangles"},
        BadFile{"PlyTruncated", "a.ply", plyText(meshOf(cuboid({1, 1, 1}, 1))).substr(0, 300), "a.ply"},
        BadFile{"PlyIndex", "a.ply", plyTextWithFace("3 0 1 4"), "line 15: face 1 names vertex 4 of 4"},
        BadFile{"PlyIndexNegative", "a.ply", plyTextWithFace("3 0 1 -1"), "line 15: face 1 names vertex -1 of 4"},
        BadFile{"PlyWord", "a.ply", plyTextWithFace("3 0 1 x"), "line 15: a value is missing or is no number"},
        BadFile{"PlyMoreFaces", "a.ply", plyTextWithFace("3 0 1 3\n3 0 3 2"),
                "line 16: the file goes on after the elements it promises"},
        BadFile{"PlyMoreBytes", "a.ply", plyBinaryWithFace(3) + "\x03",
                "the file goes on after the elements it promises"},
        BadFile{"PlyHuge", "a.ply", plyHeader("ascii") + "1e39 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 1 2\n3 0 1 3\n",
                "triangle 0 has a coordinate that is not finite in single precision"},
        BadFile{"ObjWeight", "a.obj", "v 0 0 0 0\n", "line 1: the vertex divided by its fourth number is not finite"},
        BadFile{"StlWord", "a.stl", "solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 x\nendsolid\n",
                "line 4: 'x' is not a coordinate"},
        BadFile{"StlTwoCorners", "a.stl",
                "solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nendloop\nendfacet\nendsolid\n",
                "line 6: a facet needs three vertices, this one has 2"},
        BadFile{"StlWithoutEnd", "a.stl", "solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n",
                "line 4: the file ends after 0 facets, without 'endsolid'"},
        BadFile{"StlSecondWithoutEnd", "a.stl", stlText(meshOf(cuboid({1, 1, 1}, 1))) + "solid y\nfacet normal 0 0 1",
                "the file ends after 12 facets, without 'endsolid'"},
        BadFile{"StlOpenFacet", "a.stl",
                "solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendsolid\n",
                "line 7: 'endsolid' comes before the 'endloop' of facet 1"},
        BadFile{"StlFacetInFacet", "a.stl",
                "solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nfacet normal 0 0 1\nouter loop\nendsolid\n",
                "line 5: 'facet' comes before the 'endloop' of facet 1"},
        BadFile{"StlFacetAfterEnd", "a.stl", stlText(meshOf(cuboid({1, 1, 1}, 1))) + "facet normal 0 0 1\n",
                "line 87: 'facet' comes outside of a solid"},
        BadFile{"StlVertexAfterEnd", "a.stl", stlText(meshOf(cuboid({1, 1, 1}, 1))) + "vertex 0 0 1\n",
                "line 87: 'vertex' comes outside of a solid"},
        BadFile{"StlFragmentAfterEnd", "a.stl", stlText(meshOf(cuboid({1, 1, 1}, 1))) + "face",
                "line 87: 'face' is no statement of a text STL"},
        BadFile{"StlOpenFacetWithoutVertices", "a.stl", "solid x\nfacet normal 0 0 1\nendsolid\n",
                "line 3: 'endsolid' comes before the 'outer loop' of facet 1"},
        BadFile{"StlEndfacetInLoop", "a.stl", "solid x\nfacet normal 0 0 1\nouter loop\nendfacet\n",
                "line 4: 'endfacet' comes before the 'endloop' of facet 1"},
        BadFile{
            "StlSecondLoop", "a.stl",
            "solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nouter loop\n",
            "line 8: 'outer' comes before the 'endfacet' of facet 1"},
        BadFile{"StlVertexWithoutFacet", "a.stl", "solid x\nvertex 0 0 0\n",
                "line 2: 'vertex' comes where facet 1 or 'endsolid' is due"},
        BadFile{"StlCutNormal", "a.stl", "solid x\nfacet normal 0 0\n", "line 2: a normal needs three coordinates"},
        BadFile{"StlNoNormal", "a.stl", "solid x\nfacet outer loop\n", "line 2: 'facet' is not followed by 'normal'"},
        BadFile{"StlNoLoop", "a.stl", "solid x\nfacet normal 0 0 1\nouter\n",
                "line 3: 'outer' is not followed by 'loop'"},
        BadFile{"StlOfNothing", "a.stl", "solid x\nendsolid x\n", "a.stl: it holds no triangles"},
        BadFile{"StlTooLong", "a.stl", stlBinary(meshOf(cuboid({1, 1, 1}, 1))) + "more",
                "688 bytes are too many for a binary STL of 12 triangles (684 bytes)"},
        BadFile{"StlNeither", "a.stl", "hello\n",
                "6 bytes are too few for a binary STL of 0 triangles (84 bytes), and a text one begins with 'solid'"},
        BadFile{"StlOneLine", "a.stl", "solid x facet normal 0 0 1 outer loop vertex 0 0 0 endloop endfacet endsolid x",
                "line 1: no facet has been read up to here"},
        BadFile{"PlyFaceOfNone", "a.ply", plyTextWithFace("0"), "line 15: face 1 has 0 vertices"},
        BadFile{"PlyFaceOfTwo", "a.ply", plyTextWithFace("2 0 1"), "line 15: face 1 has 2 vertices"},
        BadFile{"PlyBinaryFaceOfNone", "a.ply", plyBinaryWithFace(0), "a.ply: face 1 has 0 vertices"},
        BadFile{"PlyStrayLine", "a.ply", "ply\nformat ascii 1.0\nproperlty float x\n",
                "line 3: this is no line of a PLY"},
        BadFile{"PlyFormat", "a.ply", plyHeader("binary_little_endian 2.0 or"), "line 2: the format is not ascii"},
        BadFile{"PlyNoFormat", "a.ply", "ply\nelement vertex 1\nend_header\n", "line 3: the header names no format"},
        BadFile{"PlyNoName", "a.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty float\n",
                "line 4: a property needs a name"},
        BadFile{"PlyFlat", "a.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n0\n",
                "its vertices have no x, y and z"},
        BadFile{"PlyOfPoints", "a.ply",
                "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n"
                "end_header\n0 0 0\n",
                "it has no triangles"},
        BadFile{"PlyStripIndex", "a.ply", plyOfStrip("ascii") + kTetrahedronPoints + "5 0 1 2 -1 4\n",
                "line 14: strip 0 names vertex 4 of 4"},
        BadFile{"PlyBinaryFaceOfOne", "a.ply", plyBinaryWithFace(1), "a.ply: face 1 has 1 vertices"},
        BadFile{"GltfGarbage", "a.gltf", "{]", "a.gltf: assimp cannot read it"},
        BadFile{"GlbGarbage", "a.glb", "glTF garbage that is long enough to hold a header",
                "a.glb: assimp cannot read it"},
        BadFile{"Open", "a.obj", kTetrahedron + "f 1 3 2\nf 1 2 4\nf 2 3 4\n",
                "the mesh is open: the edge (0, 0, 0) - (0, 1, 0) has triangle 0"}),
    [](const auto& file) { return file.param.test; });

TEST(ImportOfBadFiles, AMissingFile) {
  const Result<TriangleMesh> read = importMesh("no/such/file.obj");
  ASSERT_FALSE(read.ok());
  EXPECT_NE(read.error().message.find("no/such/file.obj"), std::string::npos);
}

TEST(ImportOfBadFiles, EveryTruncationOfAFile) {
  // Wherever the text ends, the answer is a sentence or a closed solid, never a crash and never an open surface.
  const test::TemporaryFolder folder;
  const TriangleMesh mesh = meshOf(cuboid({1, 1, 1}, 1));
  for (const Format& format : {Format{"a.obj", test::objText}, Format{"a.off", offText}, Format{"a.ply", plyText},
                               Format{"a.ply", plyBinary}, Format{"a.stl", stlText}, Format{"a.stl", stlBinary}}) {
    const std::string text = format.text(mesh);
    for (std::size_t length = 0; length < text.size(); length += 7) {
      const Result<TriangleMesh> read =
          importMesh(test::writeText(folder.path() / format.name, text.substr(0, length)));
      if (read.ok()) {
        EXPECT_TRUE(checkMesh(read.value()).ok());
        EXPECT_EQ(read.value().triangles.size(), 12U) << format.name << " cut at " << length;
      }
    }
  }
}

}  // namespace
}  // namespace cairn::builder::import_refusal_test

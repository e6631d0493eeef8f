// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include "builder_meshes.h"
#include "cairn/builder/import.h"
#include "cairn/builder/mesh_file.h"
#include "run_program.h"

namespace cairn::test {

/// The file a mesh is written to holds that mesh, to the last bit and under the same hash.
inline void expectReadBack(const builder::TriangleMesh& mesh) {
  const TemporaryFolder folder;
  const Result<builder::TriangleMesh> read =
      builder::importMesh(writeText(folder.path() / "mesh.ply", builder::plyBytes(mesh)));
  ASSERT_TRUE(read.ok()) << read.error().message;
  EXPECT_EQ(read.value().vertices, mesh.vertices);
  EXPECT_EQ(read.value().triangles, mesh.triangles);
  EXPECT_EQ(read.value().sha256, mesh.sha256);
}

}  // namespace cairn::test

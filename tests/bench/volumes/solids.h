// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "cairn/builder/triangle_mesh.h"

namespace cairn::bench {

/// A mesh and what it is called in tables.
struct NamedMesh {
  std::string name;
  builder::TriangleMesh mesh;
};

/// The closed solids that volumes are compared on: rod 1000:1, plate 1000:1000:1, I-beam, chair, ball and
/// rock.
std::vector<NamedMesh> generatedSolids();

}  // namespace cairn::bench

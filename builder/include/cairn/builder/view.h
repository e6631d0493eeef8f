// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cairn/builder/cover.h"
#include "cairn/builder/triangle_mesh.h"
#include "cairn/core/result.h"
#include "cairn/core/sphere_tree.h"
#include "cairn/core/vec3.h"

namespace cairn::builder {

/// One sphere of a page: a node of a tree, or a ball of a flat set. Frame and unit of its link.
struct ViewSphere {
  Vec3 center;               ///< link frame
  float radius = 0;          ///< link unit
  float error = 0;           ///< certified: no point of the ball is farther from the solid; NaN: nothing is proved
  float innerRadius = 0;     ///< the concentric ball of this radius lies in the solid; 0: none does
  std::uint32_t parent = 0;  ///< index of the parent, before its children; its own index for a root
  std::uint32_t firstTriangle = 0;  ///< into `ViewLink::regionTriangles`
  std::uint32_t triangleCount = 0;  ///< entries there; a triangle stands there once for each leaf it lies in
};

/// One rigid body of a page: a mesh and its spheres, parents before children, each of both possibly empty. The frame of
/// its coordinates has the axes of the mesh's file, and its origin at `origin`.
struct ViewLink {
  std::string name;                            ///< any text; a file or link name
  Vec3d origin;                                ///< of the coordinates here, in the frame of the mesh's file
  double diagonal = 0;                         ///< of the mesh's bounding box, to which per cents refer
  std::vector<Vec3> vertices;                  ///< link frame
  std::vector<Triangle> triangles;             ///< indices into `vertices`
  std::vector<ViewSphere> spheres;             ///< breadth-first
  std::vector<std::uint32_t> regionTriangles;  ///< indices into `triangles`
};

/// A joint whose position is `multiplier` times another's, plus `offset`.
struct ViewMimic {
  std::uint32_t joint = 0;  ///< index of the one followed, which follows none itself
  double multiplier = 1;    ///< of its position
  double offset = 0;        ///< radians, or link units of a prismatic joint
};

/// How a link hangs on another. As in URDF, the frame of the child's file is `origin` times the joint's own motion,
/// seen in the frame of the parent's file.
struct ViewJoint {
  std::string name;                     ///< any text
  std::string type;                     ///< as URDF names it; only revolute, continuous and prismatic ones move
  std::uint32_t parent = 0, child = 0;  ///< indices of links
  Mat3d rotation;                       ///< of the child's frame at position 0, in the parent's
  Vec3d translation;                    ///< of the child's frame at position 0, in the parent's, link unit
  Vec3d axis{1, 0, 0};                  ///< unit vector, child's frame
  double lower = 0, upper = 0;          ///< limits: radians, or link units of a prismatic joint
  std::optional<ViewMimic> mimic{};     ///< the joint it follows, if it follows one
};

/// What a page shows.
struct View {
  std::string title;                                       ///< any text
  std::vector<std::pair<std::string, std::string>> facts;  ///< shown below the title: name and value, any text
  std::vector<ViewLink> links;                             ///< at least one
  std::vector<ViewJoint> joints;                           ///< none for a single body
  /// Pairs of links whose spheres may overlap without being shown as such. Indices.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> ignoredPairs{};
  bool isMetric = false;  ///< the unit of links is the metre; lengths are shown in millimetres
  bool isZUp = false;     ///< the page begins with z up, not y
};

/// A page and the bytes of its parts.
struct ViewPage {
  std::string html;             ///< the whole file, UTF-8
  std::size_t viewerBytes = 0;  ///< the viewer, the same for every page
  std::size_t meshBytes = 0;    ///< meshes, encoded
  std::size_t sphereBytes = 0;  ///< spheres, encoded
};

/// A tree with the mesh it stores. Linear.
ViewLink viewLink(const SphereTree& tree);
/// A mesh alone, with the middle of its bounding box as origin. Precondition: at least one vertex. Linear.
ViewLink viewLink(const TriangleMesh& mesh);
/// A mesh and a flat cover of it: every sphere is a root.
ViewLink viewLink(const TriangleMesh& mesh, const Cover& cover);

/// Whether this build contains the viewer, which needs node and npm when Cairn is built (CMake option `CAIRN_VIEWER`).
bool hasViewer();

/// Returns a page that shows meshes and their spheres in a browser with WebGL 2: one file, which loads nothing else.
/// The data stands in it as JSON with base64 of little-endian float32 and uint32. Texts are escaped, and the page's own
/// policy forbids any other script and any request. Fails without the viewer, and where links and joints form no trees,
/// limits are no ranges, or indices name nothing. Linear.
///
///     View view{.title = "bunny.obj", .links = {viewLink(tree)}};
///     writeFileAtomically("bunny.html", viewPage(view).value().html);
Result<ViewPage> viewPage(const View& view);

}  // namespace cairn::builder

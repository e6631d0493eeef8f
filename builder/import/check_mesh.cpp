// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "cairn/builder/import.h"
#include "import/self_intersection.h"
#include "import/shell_orientation.h"
#include "import/weld.h"
#include "surface/edges.h"
#include "surface/mass_properties.h"

namespace cairn::builder {
namespace {

std::string text(const Vec3d& p) {
  return fmt::format("({:.6g}, {:.6g}, {:.6g})", p.x, p.y, p.z);
}

// A tree stores lengths as floats. Their squares must not overflow, and the squares of small leaves, a thousandth of
// the size, must not lose digits.
constexpr double kMaxDiagonal = 1e14, kMinDiagonal = 1e-15;
// Largest distance of a mesh from the origin, in its diagonals. Beyond it, fewer than six of a coordinate's sixteen
// digits remain.
constexpr double kFarthest = 1e10;

class Checker {
 public:
  Checker(const TriangleMesh& mesh, std::size_t leftOut) : mesh_(mesh), leftOut_(leftOut) {}

  Status run() const {
    if (Status s = checkElements(); !s) return s;
    if (Status s = checkExtent(); !s) return s;
    const std::vector<HalfEdge> halfEdges = sortedHalfEdges(mesh_);
    if (Status s = checkEdges(halfEdges); !s) return s;
    if (Status s = checkVolume(); !s) return s;
    if (const auto pair = findSelfIntersection(mesh_))
      return refused("triangles {} (near {}) and {} intersect; repair the mesh", pair->first,
                     text(mesh_.corners(pair->first)[0]), pair->second);
    return checkShells(halfEdges);
  }

 private:
  template <class... Args>
  Error refused(fmt::format_string<Args...> what, Args&&... args) const {
    const std::string name = mesh_.name.empty() ? "mesh" : mesh_.name;
    return Error{name + ": " + fmt::format(what, std::forward<Args>(args)...)};
  }

  std::string edge(const HalfEdge& h) const {
    return text(mesh_.vertices[h.from]) + " - " + text(mesh_.vertices[h.to]);
  }

  /// A dropped triangle without area may have closed a crack of no width: two short edges against a long one.
  std::string omission() const {
    if (leftOut_ == 0) return {};
    return leftOut_ == 1 ? " after 1 triangle without area was left out"
                         : fmt::format(" after {} triangles without area were left out", leftOut_);
  }

  Status checkElements() const {
    if (mesh_.triangles.empty()) return refused("there are no triangles; a tree needs a closed surface");
    for (std::size_t v = 0; v < mesh_.vertices.size(); ++v) {
      if (!isFinite(mesh_.vertices[v])) return refused("vertex {} is not finite; remove or correct it", v);
    }
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
      for (const std::uint32_t v : mesh_.triangles[t]) {
        if (v >= mesh_.vertices.size())
          return refused("triangle {} names vertex {} of {}; correct its indices", t, v, mesh_.vertices.size());
      }
      if (isDegenerate(mesh_.corners(t)))
        return refused("triangle {} at {} has no area; remove it", t, text(mesh_.corners(t)[0]));
    }
    return {};
  }

  Status checkExtent() const {
    const Bounds bounds = boundsOf(mesh_);
    const double diagonal = bounds.diagonal(), away = length(0.5 * (bounds.lower + bounds.upper));
    if (!(diagonal <= kMaxDiagonal && diagonal >= kMinDiagonal))
      return refused("the mesh is {:.3g} across, trees are between {:g} and {:g}; give it in another unit", diagonal,
                     kMinDiagonal, kMaxDiagonal);
    if (away > kFarthest * diagonal)
      return refused(
          "the mesh lies {:.3g} of its diagonals from the origin, where coordinates have few digits left; "
          "move it nearer",
          away / diagonal);
    return {};
  }

  Status checkEdges(const std::vector<HalfEdge>& halfEdges) const {
    for (std::size_t first = 0, last = 0; first < halfEdges.size(); first = last) {
      const HalfEdge& h = halfEdges[first];
      for (last = first; last < halfEdges.size() && halfEdges[last].sameEdge(h);) ++last;
      if (last - first == 1)
        return refused(
            "the mesh is open: the edge {} has triangle {} on one side and nothing on the other{}; close the hole",
            edge(h), h.triangle, omission());
      if (last - first > 2)
        return refused(
            "the edge {} belongs to {} triangles ({}, {}, {}, ...), it may belong to two; separate the sheets "
            "that meet there",
            edge(h), last - first, h.triangle, halfEdges[first + 1].triangle, halfEdges[first + 2].triangle);
      if (h.from == halfEdges[first + 1].from)
        return refused(
            "triangles {} and {} face opposite sides at their common edge {}; make the orientation consistent",
            h.triangle, halfEdges[first + 1].triangle, edge(h));
    }
    return {};
  }

  Status checkVolume() const {
    const double volume = signedVolume(mesh_);
    // Each of the n signed tetrahedra, taken from the box's centre, rounds by a few units of the box's volume. Every
    // product in it has one length along each axis, and none exceeds the box.
    const Bounds bounds = boundsOf(mesh_);
    const Vec3d size = bounds.upper - bounds.lower;
    const double rounding = 0x1p-50 * static_cast<double>(mesh_.triangles.size()) * size.x * size.y * size.z;
    if (std::abs(volume) <= rounding) return refused("the mesh is flat: it encloses no volume; give it thickness");
    if (volume < 0)
      return refused("the mesh is inside out: its volume is {:.6g}; flip the orientation of all triangles", volume);
    const Vec3d moments = massPropertiesOf(mesh_).principalMoments;
    if (!(std::min({moments.x, moments.y, moments.z}) > 0))
      return refused(
          "the mesh is too long for its thickness: a moment of inertia is lost in rounding; give it thickness");
    return {};
  }

  Status checkShells(const std::vector<HalfEdge>& halfEdges) const {
    const Shells shells = shellsOf(mesh_, halfEdges);
    if (shells.count == 1) return {};
    const std::optional<MisplacedShell> shell = findMisplacedShell(mesh_, shells);
    if (!shell) return {};
    const std::string where = text(mesh_.corners(shell->triangle)[0]);
    if (shell->facesOutward)
      return refused(
          "the shell of triangle {} at {} faces outward inside another one; remove it, or flip it to make it a "
          "cavity",
          shell->triangle, where);
    return refused("the shell of triangle {} at {} faces inward but is no cavity of another one; flip its triangles",
                   shell->triangle, where);
  }

  const TriangleMesh& mesh_;
  std::size_t leftOut_;
};

}  // namespace

Status checkMesh(const TriangleMesh& mesh, std::size_t leftOut) {
  return Checker(mesh, leftOut).run();
}

}  // namespace cairn::builder

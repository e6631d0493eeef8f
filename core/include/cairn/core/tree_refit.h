// SPDX-License-Identifier: Zlib
#pragma once

#include <memory>
#include <span>

#include "cairn/core/export.h"
#include "cairn/core/result.h"
#include "cairn/core/sphere_tree.h"

namespace cairn {

/// Lets a tree follow a mesh whose vertices move: skinned characters, bending bars, anything with the same triangles.
///
///     auto refit = cairn::TreeRefit::bind(tree);           // once
///     auto moved = refit.value().refit(vertices);          // each step
///     if (!moved) return fail(moved.error().message);      // the last tree is still valid
///
/// **Cover.** Binding cuts each triangle into parts, and gives each part to a leaf that lists the triangle. The motion
/// is affine on a triangle, so parts stay convex hulls of their moved corners. A ball that holds these holds the part.
/// A leaf's new balls hold the corners of its parts, and so do the balls of its ancestors. That is the invariant of
/// `SphereTree`, whatever the motion.
///
/// **Error.** A centre moves with its region, by a rotation, a scale and a translation. Where its ball then comes out
/// of the solid elsewhere, it moves on, away from there. How it moves decides how tight the error is, not whether it
/// holds. Let c be the new centre, r the new radius and s the distance from c to the moved surface, negative outside.
/// If c is inside, the ball of radius s around c lies in the solid. Then a point of the node's ball is at most r - s
/// from the solid. If c is outside, it is at most r + |s| from the nearest point of the surface. So max(0, r - s) is
/// certified, as is the inner radius s. All steps are rounded outwards. This bound uses the moved mesh alone: errors of
/// earlier steps do not add up.
///
/// **Self-intersection.** Balls cover the surface all the same. A point counts as inside when the surface nearest to it
/// faces away from it. Errors and inner radii then refer to those points.
///
/// Normals, support points, edges and patches move with their triangles. The thickness is measured between the places
/// that faced each other at first. A moved tree has no level meshes. Its mass, origin and `BuildInfo` are the first's.
class CAIRN_CORE_EXPORT TreeRefit {
 public:
  /// Fails for a null tree, and for one with a triangle that no leaf lists. Cost: n log n; some refits.
  static Result<TreeRefit> bind(std::shared_ptr<const SphereTree> tree);

  ~TreeRefit();
  /// A moved-from `TreeRefit` may only be assigned to or destroyed.
  TreeRefit(TreeRefit&&) noexcept;
  /// As the constructor above.
  TreeRefit& operator=(TreeRefit&&) noexcept;

  /// The tree with its vertices moved to these places: tree frame, in the order of `SphereTree::vertices()`. Only the
  /// bound tree and the vertices decide its bits. Nodes keep their names.
  ///
  /// Nobody sees a tree change: memory of an earlier result is used again only when nobody holds that result. Calls
  /// then allocate a few short-lived lists. Cost: linear in vertices, triangles and parts, times the depth; and for
  /// each node a search for the nearest triangle, up to five for balls that come out elsewhere.
  ///
  /// Fails for another number of vertices, for one that is not finite or beyond 1e15, for a triangle that lost its
  /// area, and for a mesh turned inside out.
  Result<std::shared_ptr<const SphereTree>> refit(std::span<const Vec3> vertices);
  /// The same for places in the mesh's frame, whose origin is `-SphereTree::origin()` in the tree frame.
  Result<std::shared_ptr<const SphereTree>> refitMesh(std::span<const Vec3> vertices);

 private:
  struct CAIRN_HIDDEN State;
  explicit TreeRefit(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace cairn

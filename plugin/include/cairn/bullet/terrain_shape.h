// SPDX-License-Identifier: Zlib
#pragma once

#include <BulletCollision/CollisionShapes/btConcaveShape.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "cairn/core/result.h"
#include "cairn/core/vec3.h"

namespace cairn::bullet {

/// Which way the cells of a terrain are cut into two triangles. Seen from above, x to the right and y up.
enum class TerrainDiagonals : std::uint8_t {
  /// In turn, as on a chessboard, cell (0, 0) rising: no direction is preferred. Of an even number of rows of cells the
  /// triangles are those of the terrain mirrored in y, of an even number of columns those mirrored in x.
  alternating,
  rising,   ///< from the lower left to the upper right
  falling,  ///< from the upper left to the lower right
};

/// Heights over a regular grid of points, z up, metres. `point (column, row)` is at `origin + (column, row) * cell`.
struct TerrainGrid {
  std::uint32_t columns = 0, rows = 0;  ///< of points
  double cell = 1;                      ///< distance of neighbouring points
  /// The point (0, 0) at height 0, in the user's coordinates. In double: a map's coordinates have too many digits for
  /// float, and heights should be told from somewhere near the ground.
  Vec3d origin;
  /// Over `origin.z`, row by row, each along x. NaN: there is no ground at this point.
  std::vector<float> heights;
  TerrainDiagonals diagonals = TerrainDiagonals::alternating;
};

class TerrainLattice;

/// A terrain as a Bullet collision shape for static bodies: two triangles a cell, found by projecting what asks onto
/// the ground plane (thesis 8.3.2). Blocks of cells keep the bounds of their heights, so that what flies above costs
/// next to nothing. Neighbouring triangles share the very same corners, all turn their front upwards. A triangle with a
/// corner that has no height is missing: bodies fall through.
///
/// For sphere-trees all that lies below the surface is inside, however deep, and comes up again; over the edges inside
/// it they roll and slide as on a plane. Bullet's own shapes meet single triangles, both sides alike, as those of any
/// of its meshes (the type is `FAST_CONCAVE_MESH_PROXYTYPE`). In contacts and hits index is that of `TerrainTriangle`;
/// part is 0, or one plus a support point's number where a flat leaf of a tree touches with several. Rays and convex
/// sweeps follow their way instead of asking all triangles near their box.
///
/// Frame: the middle of the grid in x and y, heights as they are; `origin()` is where that is in the user's
/// coordinates. A body that stands at the world's origin therefore makes the world's coordinates those of the user less
/// `origin()`, and float serves a terrain of ten kilometres to half a millimetre.
class TerrainShape final : public btConcaveShape {
 public:
  /// Fails for less than two or more than 2^20 points a side, more than 2^30 cells, a cell that is not positive and
  /// finite or too small for the coordinates' precision, heights too few or too many or infinite, and a grid without a
  /// single triangle. Cost: linear in the points.
  static Result<std::unique_ptr<TerrainShape>> create(TerrainGrid grid);
  ~TerrainShape() override;

  const TerrainGrid& grid() const;
  /// The shape's own origin in the user's coordinates.
  const Vec3d& origin() const { return origin_; }
  /// Between all triangles, in the shape's frame.
  const btVector3& lower() const { return lower_; }
  const btVector3& upper() const { return upper_; }

  /// Height of the triangles over (x, y) of the shape's frame, nothing where there is none. Constant time.
  std::optional<double> heightAt(double x, double y) const;
  /// Unit normal, upwards, of the triangle over (x, y), nothing where there is none. Constant time.
  std::optional<btVector3> normalAt(double x, double y) const;

  /// By cells of the grid, ascending in x, then in y. Gives those triangles whose boxes touch the box. A callback of
  /// Bullet's rays or convex sweeps is served along its way instead, whatever the box, near triangles first, until its
  /// hit fraction says that nothing farther is wanted. Cost: the cells below the box, less those of blocks that lie
  /// wholly above or below it; no allocation.
  void processAllTriangles(btTriangleCallback* callback, const btVector3& aabbMin,
                           const btVector3& aabbMax) const override;
  /// The box of all triangles at this pose, grown by the margin.
  void getAabb(const btTransform& t, btVector3& aabbMin, btVector3& aabbMax) const override;
  /// Zero: a surface has no mass.
  void calculateLocalInertia(btScalar mass, btVector3& inertia) const override;
  /// Refused, printed on standard error, unless it is 1: scale the grid instead.
  void setLocalScaling(const btVector3& scaling) override;
  const btVector3& getLocalScaling() const override { return scaling_; }
  const char* getName() const override { return "CairnTerrain"; }
  /// Refused, printed on standard error: a `.bullet` file holds no heights, and whoever loads it finds neither shape
  /// nor body. A terrain is made again from what it was made from.
  void serializeSingleShape(btSerializer* serializer) const override;

  /// Bytes of memory the shape holds.
  std::size_t memoryBytes() const;

  /// What the narrow phase looks at; not for games.
  const TerrainLattice& lattice() const { return *lattice_; }

 private:
  explicit TerrainShape(TerrainGrid grid);

  std::unique_ptr<const TerrainLattice> lattice_;
  Vec3d origin_;
  btVector3 lower_, upper_, scaling_{1, 1, 1};
};

/// Which triangle of a terrain an index of contacts and hits names.
struct TerrainTriangle {
  std::uint32_t column = 0, row = 0;  ///< of the cell; that of the points (column, row) to (column + 1, row + 1)
  bool isUpper = false;               ///< of the cell's two the one at greater y

  int index(const TerrainGrid& grid) const {
    return static_cast<int>(2 * (row * (grid.columns - 1) + column) + (isUpper ? 1 : 0));
  }
};
/// Precondition: an index that `grid`'s terrain gave.
inline TerrainTriangle terrainTriangle(const TerrainGrid& grid, int index) {
  const auto cell = static_cast<std::uint32_t>(index) / 2;
  return {cell % (grid.columns - 1), cell / (grid.columns - 1), index % 2 != 0};
}

/// The shape as a `TerrainShape`, or null. Decided by its class, never by the type number alone.
const TerrainShape* asTerrain(const btCollisionShape* shape);

}  // namespace cairn::bullet

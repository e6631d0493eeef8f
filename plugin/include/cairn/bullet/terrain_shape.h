// SPDX-License-Identifier: Zlib
#pragma once

#include <BulletCollision/CollisionShapes/btConcaveShape.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "cairn/core/export.h"

#include "cairn/core/result.h"
#include "cairn/core/vec3.h"

namespace cairn::bullet {

/// How the cells of a terrain are cut into two triangles, seen from above, x to the right and y up.
enum class TerrainDiagonals : std::uint8_t {
  /// Alternates as on a chessboard, cell (0, 0) rising, so that no direction is preferred. With an even number of cell
  /// rows, mirroring the terrain in y mirrors its triangles. With an even number of cell columns the same holds for x.
  alternating,
  rising,   ///< from the lower left to the upper right
  falling,  ///< from the upper left to the lower right
};

/// Heights over a regular grid of points, z up, metres. The point (column, row) is at `origin + (column, row) * cell`.
struct TerrainGrid {
  std::uint32_t columns = 0, rows = 0;  ///< numbers of points
  double cell = 1;                      ///< distance of neighbouring points, metres
  /// The point (0, 0) at height 0, in the user's coordinates. It is in double, because map coordinates have too many
  /// digits for float. Choose `origin.z` near the ground, so that heights are small.
  Vec3d origin;
  /// Heights above `origin.z`, row by row, each along x. NaN means no ground at this point.
  std::vector<float> heights;
  TerrainDiagonals diagonals = TerrainDiagonals::alternating;  ///< how cells are cut into triangles
};

class TerrainLattice;

/// A terrain as a Bullet collision shape for static bodies: two triangles a cell, all with their front upwards. A query
/// is projected onto the ground plane to find its cells (thesis 8.3.2). Blocks of cells store bounds of their heights,
/// so that bodies far above cost almost nothing. Neighbouring triangles share the very same corners. A triangle with a
/// corner without height is missing: bodies fall through.
///
///     auto terrain = cairn::bullet::TerrainShape::create(std::move(grid));
///     if (!terrain) return fail(terrain.error().message);
///     btRigidBody ground(0, nullptr, terrain.value().get());
///
/// For sphere-trees, all space below the surface is inside, at any depth, and bodies come up from there. They roll and
/// slide over inner edges as on a plane. Bullet's own shapes meet single two-sided triangles, as with any of Bullet's
/// meshes (the type is `FAST_CONCAVE_MESH_PROXYTYPE`).
///
/// The index of contacts and hits is that of `TerrainTriangle`. The part is 0, or one plus a support point's number
/// where a flat leaf of a tree touches with several. Rays and convex sweeps follow their path and do not visit all
/// triangles near their box.
///
/// Frame: origin at the middle of the grid in x and y, heights unchanged. `origin()` gives this point in the user's
/// coordinates. A body at the world's origin makes world coordinates equal to the user's minus `origin()`. Float then
/// resolves a terrain of ten kilometres to half a millimetre.
class CAIRN_BULLET_EXPORT TerrainShape final : public btConcaveShape {
 public:
  /// Fails for less than two or more than 2^20 points a side, and for more than 2^30 cells. Fails for a cell size that
  /// is not positive and finite, or too small for the precision of the coordinates. Fails for a wrong number of
  /// heights, infinite heights, and a grid without a triangle. Cost: linear in the points.
  static Result<std::unique_ptr<TerrainShape>> create(TerrainGrid grid);
  ~TerrainShape() override;

  /// The grid that `create` was given.
  const TerrainGrid& grid() const;
  /// The origin of the shape's frame in the user's coordinates.
  const Vec3d& origin() const { return origin_; }
  /// The lower corner of the box around all triangles, in the shape's frame.
  const btVector3& lower() const { return lower_; }
  /// The upper corner of that box.
  const btVector3& upper() const { return upper_; }

  /// Height of the triangles over (x, y) in the shape's frame; empty without ground. Constant time.
  std::optional<double> heightAt(double x, double y) const;
  /// Unit normal, upwards, of the triangle over (x, y) in the shape's frame; empty without ground. Constant time.
  std::optional<btVector3> normalAt(double x, double y) const;

  /// Visits the triangles whose boxes touch the box (shape's frame), cell by cell, ascending in x, then in y. A
  /// callback of Bullet's rays or convex sweeps is served along its path instead, whatever the box. It gets near
  /// triangles first, until its hit fraction excludes the rest. Cost: the cells below the box, without blocks wholly
  /// above or below it; no allocation.
  void processAllTriangles(btTriangleCallback* callback, const btVector3& aabbMin,
                           const btVector3& aabbMax) const override;
  /// The box of all triangles at this pose, grown by the margin.
  void getAabb(const btTransform& t, btVector3& aabbMin, btVector3& aabbMax) const override;
  /// Gives zero: a surface has no mass.
  void calculateLocalInertia(btScalar mass, btVector3& inertia) const override;
  /// Refuses any scale except 1, with a message in the log: scale the grid instead.
  void setLocalScaling(const btVector3& scaling) override;
  /// The scale of the grid along its axes.
  const btVector3& getLocalScaling() const override { return scaling_; }
  /// The name of this kind of shape, as everywhere in Bullet.
  const char* getName() const override;
  /// Refuses, with a message in the log, because a `.bullet` file holds no heights. An importer finds neither
  /// shape nor body. Create the terrain again from its grid.
  void serializeSingleShape(btSerializer* serializer) const override;

  /// Bytes of memory the shape holds.
  std::size_t memoryBytes() const;

  /// Internal data for the narrow phase; not for games.
  const TerrainLattice& lattice() const { return *lattice_; }

 private:
  explicit TerrainShape(TerrainGrid grid);

  std::unique_ptr<const TerrainLattice> lattice_;
  Vec3d origin_;
  btVector3 lower_, upper_, scaling_{1, 1, 1};
};

/// The triangle that an index of a contact or hit names:
///
///     const TerrainTriangle triangle = terrainTriangle(terrain.grid(), point.m_index1);
struct TerrainTriangle {
  std::uint32_t column = 0, row = 0;  ///< the cell from point (column, row) to (column + 1, row + 1)
  bool isUpper = false;               ///< the cell's triangle at greater y

  /// The index in contacts and hits. Precondition: a cell of `grid`.
  int index(const TerrainGrid& grid) const {
    return static_cast<int>(2 * (row * (grid.columns - 1) + column) + (isUpper ? 1 : 0));
  }
};
/// The inverse of `TerrainTriangle::index`. Precondition: an index that `grid`'s terrain gave.
inline TerrainTriangle terrainTriangle(const TerrainGrid& grid, int index) {
  const auto cell = static_cast<std::uint32_t>(index) / 2;
  return {cell % (grid.columns - 1), cell / (grid.columns - 1), index % 2 != 0};
}

/// The shape as a `TerrainShape`, or null. Decided by its C++ class, never by the type number alone.
CAIRN_BULLET_EXPORT
const TerrainShape* asTerrain(const btCollisionShape* shape);

}  // namespace cairn::bullet

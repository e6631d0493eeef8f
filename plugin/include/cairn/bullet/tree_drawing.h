// SPDX-License-Identifier: Zlib
#pragma once

#include <BulletCollision/CollisionDispatch/btCollisionWorld.h>
#include <LinearMath/btIDebugDraw.h>

#include <array>
#include <cstdint>
#include <optional>

#include "cairn/bullet/sphere_tree_shape.h"
#include "cairn/core/export.h"

namespace cairn::bullet {

/// Debug drawing of sphere-trees. Bullet draws their source triangles; these functions draw the spheres of one level,
/// coloured by certified error.
///
///     world.debugDrawWorld();
///     cairn::bullet::drawTrees(world, 2);
///
/// A level deeper than a tree means its leaves; leaves above a level belong to it. Cost: linear in the tree. A drawer
/// that does not draw spheres itself gets some 150 lines a sphere.

/// The lower end of the logarithmic colour scale: a certified error as a fraction of `SphereTreeShape::size`.
inline constexpr double kMinErrorShown = 0.003;
/// The upper end of that scale.
inline constexpr double kMaxErrorShown = 0.5;

/// Red, green and blue at equal steps of the scale; each step is 2.8 times the error of the last. Blue is 0.3 %, sky
/// 0.83 %, teal 2.3 %, green 6.5 %, lime 18 %, yellow 50 %. Lightness rises steadily, so that everyone can read the
/// scale.
inline constexpr std::array<std::array<double, 3>, 6> kErrorColors{{{0.29, 0.36, 0.72},
                                                                    {0.20, 0.52, 0.74},
                                                                    {0.20, 0.66, 0.63},
                                                                    {0.47, 0.77, 0.47},
                                                                    {0.82, 0.84, 0.34},
                                                                    {0.99, 0.80, 0.26}}};

/// The place of an error on the colour scale: 0 at its least error, 1 at its greatest. `errorFraction` is a fraction of
/// the size. Errors beyond the scale give values outside [0, 1].
CAIRN_BULLET_EXPORT
double onErrorScale(double errorFraction);

/// The colour of an error, as a fraction of the size. Errors beyond the scale get the colour of its nearer end.
CAIRN_BULLET_EXPORT
btVector3 errorColor(double errorFraction);

/// Draws the spheres of a level, margin included, of a body at `bodyTransform` (world frame).
CAIRN_BULLET_EXPORT
void drawTree(btIDebugDraw& drawer, const btTransform& bodyTransform, const SphereTreeShape& shape,
              std::uint32_t level);

/// Draws all trees of a world with the world's drawer, also those in compounds, in addition to `debugDrawWorld`. Omits
/// objects with CF_DISABLE_VISUALIZE_OBJECT. Does nothing without a drawer.
CAIRN_BULLET_EXPORT
void drawTrees(btCollisionWorld& world, std::uint32_t level);

/// A world that draws spheres *instead of* a tree's triangles while a level is set. It affects `debugDrawWorld` and
/// `debugDrawObject`; all else is drawn as usual.
///
///     cairn::bullet::TreeDrawing<btDiscreteDynamicsWorld> world(&dispatcher, &broadphase, &solver, &configuration);
///     world.setTreeLevel(2);
template <class World>
class TreeDrawing : public World {
 public:
  using World::World;

  /// Sets the level to draw; unset: triangles, as Bullet draws them.
  void setTreeLevel(std::optional<std::uint32_t> level) { treeLevel_ = level; }
  /// The level to draw; unset: triangles.
  std::optional<std::uint32_t> treeLevel() const { return treeLevel_; }

  /// Draws a tree's spheres at `treeLevel`, and every other shape as Bullet does.
  void debugDrawObject(const btTransform& worldTransform, const btCollisionShape* shape,
                       const btVector3& color) override {
    const SphereTreeShape* tree = treeLevel_ ? asSphereTree(shape) : nullptr;
    if (tree == nullptr) return World::debugDrawObject(worldTransform, shape, color);
    btIDebugDraw* drawer = this->getDebugDrawer();
    if (drawer == nullptr) return;
    if ((drawer->getDebugMode() & btIDebugDraw::DBG_DrawFrames) != 0)
      drawer->drawTransform(worldTransform, btScalar(0.1));  // Bullet draws this for every object
    drawTree(*drawer, worldTransform, *tree, *treeLevel_);
  }

 private:
  std::optional<std::uint32_t> treeLevel_;
};

}  // namespace cairn::bullet

// SPDX-License-Identifier: Zlib
#pragma once

#include <BulletCollision/CollisionDispatch/btCollisionWorld.h>
#include <LinearMath/btIDebugDraw.h>

#include <array>
#include <cstdint>
#include <optional>

#include "cairn/bullet/sphere_tree_shape.h"

namespace cairn::bullet {

/// Debug drawing of sphere-trees: Bullet draws their source triangles, these functions the spheres of one level,
/// coloured by certified error. Levels deeper than a tree is mean its leaves; leaves above a level belong to it. Linear
/// in the tree, and every sphere is some 150 lines to a drawer that does not draw spheres itself.

/// The range of the colour scale, which is logarithmic: certified errors as fractions of `SphereTreeShape::size`.
inline constexpr double kMinErrorShown = 0.003, kGreatestErrorShown = 0.5;

/// Red, green and blue at equal steps of the scale, 2.8 times the error each: blue 0.3 %, sky 0.83 %, teal 2.3 %,
/// green 6.5 %, lime 18 %, yellow 50 %. Lightness rises steadily, so that the scale is readable by everyone.
inline constexpr std::array<std::array<double, 3>, 6> kErrorColors{{{0.29, 0.36, 0.72},
                                                                    {0.20, 0.52, 0.74},
                                                                    {0.20, 0.66, 0.63},
                                                                    {0.47, 0.77, 0.47},
                                                                    {0.82, 0.84, 0.34},
                                                                    {0.99, 0.80, 0.26}}};

/// Where an error, as a fraction of the size, stands on the colour scale: 0 at its least, 1 at its greatest; not cut
/// off there.
double onErrorScale(double errorFraction);

/// The colour of an error, as a fraction of the size; beyond the scale, that of its end.
btVector3 errorColor(double errorFraction);

/// Draws the spheres of a level as they collide, margin included, of a body at `bodyTransform`.
void drawTree(btIDebugDraw& drawer, const btTransform& bodyTransform, const SphereTreeShape& shape,
              std::uint32_t level);

/// The same for all trees of a world, also as children of compounds, with the world's drawer, on top of what
/// `debugDrawWorld` draws; objects with CF_DISABLE_VISUALIZE_OBJECT are left out, and without a drawer nothing is done.
void drawTrees(btCollisionWorld& world, std::uint32_t level);

/// A world whose `debugDrawWorld` and `debugDrawObject` draw spheres *instead of* a tree's triangles while a level is
/// set, and all else as ever: `TreeDrawing<btDiscreteDynamicsWorld> world(...)`.
template <class World>
class TreeDrawing : public World {
 public:
  using World::World;

  /// Which level is drawn; none: triangles, as Bullet does.
  void setTreeLevel(std::optional<std::uint32_t> level) { treeLevel_ = level; }
  std::optional<std::uint32_t> treeLevel() const { return treeLevel_; }

  void debugDrawObject(const btTransform& worldTransform, const btCollisionShape* shape,
                       const btVector3& color) override {
    const SphereTreeShape* tree = treeLevel_ ? asSphereTree(shape) : nullptr;
    if (tree == nullptr) return World::debugDrawObject(worldTransform, shape, color);
    btIDebugDraw* drawer = this->getDebugDrawer();
    if (drawer == nullptr) return;
    if ((drawer->getDebugMode() & btIDebugDraw::DBG_DrawFrames) != 0)
      drawer->drawTransform(worldTransform, btScalar(0.1));  // as Bullet for every object
    drawTree(*drawer, worldTransform, *tree, *treeLevel_);
  }

 private:
  std::optional<std::uint32_t> treeLevel_;
};

}  // namespace cairn::bullet

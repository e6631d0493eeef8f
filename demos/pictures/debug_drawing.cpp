// SPDX-License-Identifier: GPL-3.0-or-later
// debug_drawing shows Bullet's debug drawing of a body with a sphere-tree: its triangles, then its spheres level by
// level.
#include <btBulletCollisionCommon.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <numbers>
#include <optional>

#include "cairn/bullet/dispatcher.h"
#include "cairn/bullet/tree_drawing.h"
#include "cairn/core/tree_file.h"
#include "scenes/command/program.h"
#include "scenes/pictures/line_picture.h"

namespace {

using cairn::bullet::SphereTreeShape;

// Draws the body like a world's `debugDrawWorld`, `column` places to the right.
void drawBody(SphereTreeShape& shape, int column, std::optional<std::uint32_t> level,
              cairn::scenes::LineRecorder& drawer) {
  btDefaultCollisionConfiguration configuration;
  cairn::bullet::Dispatcher<> dispatcher(&configuration);
  btDbvtBroadphase broadphase;
  cairn::bullet::TreeDrawing<btCollisionWorld> world(&dispatcher, &broadphase, &configuration);
  world.setDebugDrawer(&drawer);
  world.setTreeLevel(level);
  btCollisionObject body;
  body.setCollisionShape(&shape);
  const btQuaternion upright(btVector3(1, 0, 0), btScalar(std::numbers::pi / 2));
  const btQuaternion turned(btVector3(0, 1, 0), btScalar(std::numbers::pi / 6));
  body.setWorldTransform(btTransform(upright * turned, btVector3(btScalar(column) * shape.size(), 0, 0)));
  world.addCollisionObject(&body);
  world.debugDrawWorld();
  world.removeCollisionObject(&body);
}

cairn::Status draw(const std::filesystem::path& file, const std::filesystem::path& png) {
  auto tree = cairn::loadTree(file);
  if (!tree) return tree.error();
  auto shape = SphereTreeShape::create(std::move(tree).value(), cairn::bullet::BodyFrame::mesh);
  if (!shape) return shape.error();
  cairn::scenes::LineRecorder drawer;
  drawBody(*shape.value(), 0, std::nullopt, drawer);
  constexpr std::uint32_t kLevels = 3;
  for (std::uint32_t level = 0; level <= kLevels; ++level)
    drawBody(*shape.value(), static_cast<int>(level) + 1, level, drawer);
  return cairn::scenes::renderWithPovray(cairn::scenes::linePicture(drawer.lines()), cairn::scenes::kLinePictureSize,
                                         png);
}

}  // namespace

int main(int argc, char** argv) {
  using namespace cairn;
  CLI::App app(
      "Renders what Bullet's debug drawing shows of a body with a sphere-tree: the mesh, then the spheres of levels 0 "
      "to 3 "
      "coloured by certified error (needs POV-Ray).",
      "debug_drawing");
  std::filesystem::path tree, png = "debug.png";
  app.add_option("TREE", tree, "a .cairn file, its mesh's y up")->required();
  app.add_option("-o,--output", png, "the picture, a PNG")->capture_default_str();
  if (const auto code = scenes::parseCommandLine(app, argc, argv)) return *code;
  const Status status = draw(tree, png);
  return status ? scenes::kExitDone : scenes::refuse("debug_drawing", status.error());
}

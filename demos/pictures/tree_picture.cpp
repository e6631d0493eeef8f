// SPDX-License-Identifier: GPL-3.0-or-later
// tree_picture shows a sphere-tree's levels side by side, coloured by certified error.
#include <CLI/CLI.hpp>
#include <cstdint>
#include <filesystem>
#include <string>

#include "cairn/core/tree_file.h"
#include "scenes/command/program.h"
#include "scenes/pictures/povray.h"
#include "scenes/pictures/tree_picture.h"

namespace {

cairn::Status drawTree(const std::filesystem::path& file, const cairn::scenes::MeshView& view, std::uint32_t width,
                       const std::filesystem::path& png) {
  const auto tree = cairn::loadTree(file);
  if (!tree) return tree.error();
  return cairn::scenes::renderWithPovray(cairn::scenes::treePicture(tree.value(), view),
                                         cairn::scenes::scaledTo(cairn::scenes::kTreePictureSize, width), png);
}

}  // namespace

int main(int argc, char** argv) {
  using namespace cairn;
  CLI::App app("Renders the levels of a sphere-tree side by side, spheres coloured by certified error (needs POV-Ray).",
               "tree_picture");
  std::filesystem::path tree, png = "tree.png";
  scenes::MeshView view;
  std::uint32_t width = scenes::kTreePictureSize.width;
  std::string up = "y";
  app.add_option("TREE", tree, "a .cairn file")->required();
  app.add_option("-o,--output", png, "the picture, a PNG")->capture_default_str();
  app.add_option("--up", up, "mesh axis that points up")->check(CLI::IsMember({"y", "z"}))->capture_default_str();
  app.add_option("--turn", view.turnDegrees, "degrees the mesh is turned about that axis")->capture_default_str();
  app.add_option("--width", width, "of the picture, pixels")->check(CLI::Range(200U, 8000U))->capture_default_str();
  if (const auto code = scenes::parseCommandLine(app, argc, argv)) return *code;
  view.up = up == "y" ? scenes::UpAxis::y : scenes::UpAxis::z;
  const Status status = drawTree(tree, view, width, png);
  return status ? scenes::kExitDone : scenes::refuse("tree_picture", status.error());
}

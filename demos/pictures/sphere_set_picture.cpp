// SPDX-License-Identifier: GPL-3.0-or-later
// sphere_set_picture shows a whole solid as a few spheres, by several reductions of its medial axis (thesis, appendix
// B).
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "cairn/builder/import.h"
#include "cairn/builder/medial_axis.h"
#include "cairn/builder/reduce_balls.h"
#include "scenes/command/program.h"
#include "scenes/pictures/sphere_set_picture.h"

namespace {

using cairn::builder::Reduction;

const std::map<std::string, Reduction> kReductions{{"hubbard", Reduction::hubbard},
                                                   {"merge", Reduction::merge},
                                                   {"expand", Reduction::expand},
                                                   {"burst", Reduction::burst}};

/// Number of medial spheres from which all reductions start (thesis 7.1.4).
constexpr std::uint32_t kMedialSpheres = 500;

struct Options {
  std::filesystem::path mesh, png = "spheres.png";
  std::vector<std::string> reductions{"merge", "expand"};
  std::vector<std::uint32_t> spheres{8, 32, 100};
  std::uint32_t width = 1600;
  std::uint64_t seed = 1;
  cairn::scenes::MeshView view;
};

cairn::scenes::SphereSet named(const std::string& reduction, std::vector<cairn::builder::Ball> balls, double diagonal) {
  double worst = 0;
  for (const cairn::builder::Ball& ball : balls) worst = std::max(worst, ball.standOff() / diagonal);
  return {reduction, fmt::format("{} spheres, error up to {:.2g} %", balls.size(), 100 * worst), std::move(balls)};
}

cairn::Status draw(const Options& options) {
  using namespace cairn;
  scenes::ProgressLine progress("sphere sets");
  const auto mesh = builder::importMesh(options.mesh);
  if (!mesh) return mesh.error();
  const auto axis =
      builder::medialAxis(mesh.value(), {.spheres = kMedialSpheres, .seed = options.seed}, progress.callback());
  if (!axis) return axis.error();
  if (axis.value().inside.empty())
    return Error{options.mesh.string() + ": no medial sphere was found; is it as thin as a sheet?"};
  scenes::SphereSheet sheet;
  for (const std::string& reduction : options.reductions) {
    sheet.emplace_back();
    for (const std::uint32_t count : options.spheres) {
      auto balls = builder::reduceBalls(mesh.value(), axis.value(), {kReductions.at(reduction), count},
                                        [] { return !scenes::interrupted(); });
      if (!balls) return balls.error();
      const double diagonal = builder::boundsOf(mesh.value()).diagonal();
      sheet.back().push_back(named(reduction, std::move(balls).value(), diagonal));
    }
  }
  return scenes::renderWithPovray(scenes::sphereSetPicture(mesh.value(), sheet, options.view),
                                  scenes::sphereSetPictureSize(sheet, options.width), options.png);
}

}  // namespace

int main(int argc, char** argv) {
  using namespace cairn;
  CLI::App app("Renders a solid as sets of a few spheres each, one reduction of its medial axis a row (needs POV-Ray).",
               "sphere_set_picture");
  Options options;
  std::string up = "y";
  app.add_option("MESH", options.mesh, "closed mesh, any format assimp reads")->required();
  app.add_option("-o,--output", options.png, "the picture, a PNG")->capture_default_str();
  app.add_option("--reductions", options.reductions, "hubbard, merge, expand, burst; separated by commas")
      ->delimiter(',')
      ->check(CLI::IsMember({"hubbard", "merge", "expand", "burst"}))
      ->capture_default_str();
  app.add_option("--spheres", options.spheres, "at most so many in a set; separated by commas")
      ->delimiter(',')
      ->check(CLI::Range(1U, kMedialSpheres))
      ->capture_default_str();
  app.add_option("--width", options.width, "of the picture, pixels")
      ->check(CLI::Range(200U, 8000U))
      ->capture_default_str();
  app.add_option("--up", up, "mesh axis that points up")->check(CLI::IsMember({"y", "z"}))->capture_default_str();
  app.add_option("--turn", options.view.turnDegrees, "degrees the mesh is turned about that axis")
      ->capture_default_str();
  if (const auto code = scenes::parseCommandLine(app, argc, argv)) return *code;
  options.view.up = up == "y" ? scenes::UpAxis::y : scenes::UpAxis::z;
  scenes::watchForInterrupt();
  const Status status = draw(options);
  return status ? scenes::kExitDone : scenes::refuse("sphere_set_picture", status.error());
}

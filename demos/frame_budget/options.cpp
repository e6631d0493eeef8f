// SPDX-License-Identifier: GPL-3.0-or-later
#include "options.h"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <map>
#include <string_view>

#include "scenes/budget_options.h"
#include "scenes/priority_choice.h"
#include "scenes/program.h"

namespace cairn::frame_budget {
namespace {

using scenes::refuseUsage;

constexpr const char* kProgram = "frame_budget";

/// What the command line says, before it is understood.
struct RawOptions {
  std::string shapes = "tree";
  std::string method = "combined";
  bool noSleeping = false;
};

// CLI11's own range lets NaN through.
std::string refuseNoFraction(const std::string& text) {
  double value = 0;
  const bool isFraction = CLI::detail::lexical_cast(text, value) && value >= 0 && value <= 1;
  return isFraction ? std::string() : "'" + text + "' is not a fraction from 0 to 1";
}

void declareScene(CLI::App& app, Options& options, RawOptions& raw) {
  app.add_option("--scene", options.scene, "heap: bodies dropped in a column into a pit")->capture_default_str();
  app.add_option("--bodies", options.heap.bodies, "bodies in the scene")
      ->check(CLI::Range(1U, 100000U))
      ->capture_default_str();
  app.add_option("--steps", options.steps, "steps of 1/60 s")->check(CLI::Range(1U, 10000000U))->capture_default_str();
  app.add_option("--seed", options.heap.seed, "of the bodies' orientations")
      ->check(scenes::refuseNoWholeNumber)
      ->capture_default_str();
  app.add_flag("--no-sleeping", raw.noSleeping, "keep resting bodies awake");
  app.add_option("--shape", raw.shapes, "tree, gimpact, hull or spheres; several with commas, compared in one run")
      ->capture_default_str();
  app.add_option("--margin-fraction", options.heap.shape.marginFraction,
                 "collision margin of gimpact and hull as a fraction of body size (default 0.001 and 0.01)")
      ->check(refuseNoFraction);
  app.add_option("--spheres-level", options.heap.shape.sphereLevel, "tree level the shape 'spheres' is made of")
      ->check(CLI::Range(0U, kMaxDepth))
      ->capture_default_str();
}

void declareTree(CLI::App& app, Options& options, RawOptions& raw) {
  auto* mesh = app.add_option("--mesh", options.source.mesh, "mesh to build the tree from (default: a generated rock)");
  app.add_option("--tree", options.source.tree, "a .cairn file instead of --mesh")->excludes(mesh);
  app.add_option("--method", raw.method, "how the tree is built: see cairn build --help")->capture_default_str();
  app.add_option("--depth", options.source.build.depth, "levels of the tree below its root")
      ->check(CLI::Range(1U, 8U))
      ->capture_default_str();
  app.add_option("--rock", options.source.rock.seed, "seed of the generated rock")
      ->check(scenes::refuseNoWholeNumber)
      ->capture_default_str();
}

void declareNarrowPhase(CLI::App& app, Options& options) {
  scenes::addBudgetOptions(app, options.heap.world.budget);
  scenes::addPriorityOption(app, options.priority);
  app.add_flag("--viewer", options.heap.isWatched,
               "somebody stands at the pit and looks at the middle of the heap: priorities that care serve them, and "
               "the error they see is reported");
  app.add_option("--unresolved", options.unresolved,
                 "what an unfinished pair answers: guard, repel, ignore or compensate")
      ->capture_default_str();
}

void declareOutput(CLI::App& app, Options& options) {
  app.add_option("--json", options.json, "write the figures to this file");
  app.add_option("--csv", options.csv, "write what every step did to this file");
  app.add_option("--picture", options.picture, "render the heap as it ends to this PNG (needs POV-Ray; first shape)");
}

Status understandShapes(const std::string& names, Options& options) {
  for (std::size_t begin = 0; begin <= names.size();) {
    const std::size_t end = std::min(names.find(',', begin), names.size());
    const auto kind = scenes::parseShape(std::string_view(names).substr(begin, end - begin));
    if (!kind) return kind.error();
    options.shapes.push_back(kind.value());
    begin = end + 1;
  }
  return {};
}

Status understand(const RawOptions& raw, Options& options) {
  if (options.scene != "heap") return Error{fmt::format("there is no scene '{}': use heap", options.scene)};
  const auto priority = scenes::parsePriority(options.priority);
  if (!priority) return priority.error();
  using bullet::Unresolved;
  static const std::map<std::string, Unresolved> policies{{"guard", Unresolved::guard},
                                                          {"repel", Unresolved::repel},
                                                          {"ignore", Unresolved::ignore},
                                                          {"compensate", Unresolved::compensate}};
  const auto policy = policies.find(options.unresolved);
  if (policy == policies.end())
    return Error{fmt::format("there is no policy '{}' for unresolved pairs: use guard, repel, ignore or compensate",
                             options.unresolved)};
  const auto method = builder::parseMethod(raw.method);
  if (!method) return method.error();
  options.heap.world.priority = priority.value();
  options.heap.world.unresolved = policy->second;
  options.heap.world.sleeping = !raw.noSleeping;
  options.source.build.method = method.value();
  return understandShapes(raw.shapes, options);
}

}  // namespace

std::variant<Options, int> parseOptions(int argc, const char* const* argv) {
  CLI::App app(
      "Drops bodies of one mesh into a pit and measures what their collision costs and how right it is, for one shape "
      "or "
      "several in the same run.",
      kProgram);
  Options options;
  RawOptions raw;
  declareScene(app, options, raw);
  declareTree(app, options, raw);
  declareNarrowPhase(app, options);
  declareOutput(app, options);
  app.footer("Example: frame_budget --mesh bunny.obj --bodies 100 --shape tree,gimpact --budget-ops 50000");
  if (const auto code = scenes::parseCommandLine(app, argc, argv)) return *code;
  if (const Status status = understand(raw, options); !status) return refuseUsage(kProgram, status.error());
  return options;
}

}  // namespace cairn::frame_budget

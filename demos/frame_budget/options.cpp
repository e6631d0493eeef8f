// SPDX-License-Identifier: GPL-3.0-or-later
#include "options.h"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <map>
#include <string_view>

#include "scenes/command/budget_options.h"
#include "scenes/command/program.h"
#include "scenes/world/priority_choice.h"

namespace cairn::frame_budget {
namespace {

using scenes::refuseUsage;

constexpr const char* kProgram = "frame_budget";
/// About a gigabyte.
constexpr double kMostMotions = 1e7;
constexpr std::array kScenes{Scene::heap, Scene::crush, Scene::converge};

constexpr const char* kExamples =
    "Examples:\n"
    "  a hundred bunnies fall into a pit, as sphere-trees under a budget and as GImpact:\n"
    "    frame_budget --mesh bunny.obj --bodies 100 --shape tree,gimpact --budget-ops 50000\n"
    "  twenty bunnies fly to one point; every shape sees the same poses, every 10th frame is compared with the exact\n"
    "  meshes:\n"
    "    frame_budget --scene converge --mesh bunny.obj --shape tree,gimpact,fcl --runs 5 --json converge.json\n"
    "  twenty bunnies start pressed into each other and have half a millisecond a step to come apart:\n"
    "    frame_budget --scene crush --mesh bunny.obj --shape tree --budget-us 500";

/// What the command line says, before it is understood.
struct RawOptions {
  std::string scene = "heap";
  std::string shapes = "tree";
  std::string meeting = scenes::meetingName(scenes::Meeting::bounce);
  std::optional<std::uint32_t> bodies, steps;
  std::string method = "combined";
  bool noSleeping = false;
  std::vector<CLI::Option*> ofConverge;  // no other scene has them
};

// CLI11's own range lets NaN through.
std::string refuseNoFraction(const std::string& text) {
  double value = 0;
  const bool isFraction = CLI::detail::lexical_cast(text, value) && value >= 0 && value <= 1;
  return isFraction ? std::string() : "'" + text + "' is not a fraction from 0 to 1";
}

void declareScene(CLI::App& app, Options& options, RawOptions& raw) {
  app.add_option("--scene", raw.scene,
                 "heap: bodies dropped in a column into a pit; crush: bodies that start deep in each other; converge: "
                 "bodies flying to one point, the same recorded poses for every shape")
      ->capture_default_str();
  app.add_option("--bodies", raw.bodies, "bodies in the scene (default 100 in heap, 20 in crush and converge)")
      ->check(CLI::Range(1U, 100000U));
  app.add_option("--steps", raw.steps, "steps of 1/60 s (default 600; in converge frames of each run, default 300)")
      ->check(CLI::Range(1U, 10000000U));
  app.add_option("--seed", options.heap.seed, "of the bodies' orientations and places")
      ->check(scenes::refuseNoWholeNumber)
      ->capture_default_str();
  app.add_flag("--no-sleeping", raw.noSleeping, "keep resting bodies awake");
  app.add_option("--shape", raw.shapes,
                 "tree, tree+triangles (contacts between source triangles, past the leaves), gimpact, hull, spheres, "
                 "compound (of the "
                 "hulls HACD cuts the mesh into) or fcl (only in converge); "
                 "several with commas, compared in one run")
      ->capture_default_str();
  app.add_option(
         "--margin-fraction", options.heap.shape.marginFraction,
         "collision margin of gimpact, hull and compound as a fraction of body size (default 0.001, 0.01 and 0.01)")
      ->check(refuseNoFraction);
  app.add_option("--spheres-level", options.heap.shape.sphereLevel, "tree level the shape 'spheres' is made of")
      ->check(CLI::Range(0U, kMaxDepth))
      ->capture_default_str();
}

void declareConverge(CLI::App& app, Options& options, RawOptions& raw) {
  auto* runs = app.add_option("--runs", options.converge.runs, "converge: runs, each with its own random starts")
                   ->check(CLI::Range(1U, 1000U))
                   ->capture_default_str();
  auto* meeting =
      app.add_option("--meeting", raw.meeting,
                     "converge: while they are recorded, bodies bounce (as exact meshes) or fly through each other")
          ->capture_default_str();
  auto* truth = app.add_option("--truth-every", options.truthEvery,
                               "converge: compare the contacts of every so many frames with the exact meshes")
                    ->check(CLI::Range(1U, 1000000U))
                    ->capture_default_str();
  raw.ofConverge = {runs, meeting, truth};
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
  app.add_option("--budget-from", options.heap.stepsWithoutBudget,
                 "heap and crush: steps before the budget holds; what it then does to the certified error is reported")
      ->check(scenes::refuseNoWholeNumber)
      ->capture_default_str();
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
  app.add_option("--picture", options.picture,
                 "heap and crush: render the end to this PNG (needs POV-Ray; first shape)");
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

Status understandScene(const RawOptions& raw, Options& options) {
  const auto found = std::ranges::find(kScenes, raw.scene, sceneName);
  if (found == kScenes.end())
    return Error{fmt::format("there is no scene '{}': use heap, crush or converge", raw.scene)};
  const auto meeting = scenes::parseMeeting(raw.meeting);
  if (!meeting) return meeting.error();
  options.scene = *found;
  options.heap.bodies = raw.bodies.value_or(options.scene == Scene::heap ? 100 : 20);
  options.steps = raw.steps.value_or(options.scene == Scene::converge ? 300 : 600);
  options.converge.meeting = meeting.value();
  options.converge.bodies = options.heap.bodies;
  options.converge.frames = options.steps;
  options.converge.seed = options.heap.seed;
  return {};
}

/// What one scene has and another has not.
Status checkCombination(const RawOptions& raw, const Options& options) {
  if (options.scene == Scene::converge) {
    if (options.picture) return Error{"--picture draws how bodies come to rest: use it with --scene heap or crush"};
    const double motions = 1.0 * options.converge.bodies * options.converge.runs * options.converge.frames;
    if (motions > kMostMotions)
      return Error{
          fmt::format("{:.0f} recorded poses are too many for memory: --bodies, --runs and --steps multiply to "
                      "{:.0f} at most",
                      motions, kMostMotions)};
    if (options.heap.isWatched) return Error{"--viewer looks at a heap: use it with --scene heap or crush"};
    if (raw.noSleeping) return Error{"--no-sleeping is for simulated bodies: use it with --scene heap or crush"};
    return {};
  }
  for (const CLI::Option* option : raw.ofConverge)
    if (option->count() > 0)
      return Error{fmt::format("{} belongs to recorded poses: use it with --scene converge", option->get_name())};
  if (std::ranges::find(options.shapes, scenes::ShapeKind::fcl) != options.shapes.end())
    return Error{"the shape fcl only answers recorded poses: use it with --scene converge"};
  return {};
}

Status understand(const RawOptions& raw, Options& options) {
  if (Status scene = understandScene(raw, options); !scene) return scene;
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
  if (Status shapes = understandShapes(raw.shapes, options); !shapes) return shapes;
  return checkCombination(raw, options);
}

}  // namespace

const char* sceneName(Scene scene) {
  switch (scene) {
    case Scene::heap:
      return "heap";
    case Scene::crush:
      return "crush";
    case Scene::converge:
      return "converge";
  }
  return "";
}

std::variant<Options, int> parseOptions(int argc, const char* const* argv) {
  CLI::App app(
      "Measures what the collision of many bodies of one mesh costs and how right it is, for one shape or several in "
      "the same run.",
      kProgram);
  Options options;
  RawOptions raw;
  declareScene(app, options, raw);
  declareConverge(app, options, raw);
  declareTree(app, options, raw);
  declareNarrowPhase(app, options);
  declareOutput(app, options);
  app.footer(kExamples);
  if (const auto code = scenes::parseCommandLine(app, argc, argv)) return *code;
  if (const Status status = understand(raw, options); !status) return refuseUsage(kProgram, status.error());
  return options;
}

}  // namespace cairn::frame_budget

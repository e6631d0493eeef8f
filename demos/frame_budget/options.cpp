// SPDX-License-Identifier: GPL-3.0-or-later
#include "options.h"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "lists.h"
#include "scenes/command/program.h"
#include "scenes/world/priority_choice.h"

namespace cairn::frame_budget {
namespace {

using scenes::refuseUsage;

constexpr const char* kProgram = "frame_budget";
/// About a gigabyte.
constexpr double kMaxMotions = 1e7;

constexpr const char* kExamples =
    "Examples:\n"
    "  a hundred bunnies fall into a pit, as sphere-trees under a budget and as GImpact:\n"
    "    frame_budget --mesh bunny.obj --bodies 100 --shape tree,gimpact --budget-ops 50000\n"
    "  twenty bunnies fly to one point; every shape sees the same poses, every 10th frame is compared with the exact\n"
    "  meshes:\n"
    "    frame_budget --scene converge --mesh bunny.obj --shape tree,gimpact,fcl --runs 5 --json converge.json\n"
    "  twenty bunnies start pressed into each other and have half a millisecond a step to come apart:\n"
    "    frame_budget --scene crush --mesh bunny.obj --shape tree --budget-us 500\n"
    "Sweeps: --scene, --bodies, --method, --margin-fraction, --max-contact-error, --budget-ops, --budget-us, "
    "--priority and --unresolved "
    "take\n"
    "  several values with commas ('none': no limit). Every combination is measured, one shape at a time, and has one\n"
    "  line in table, CSV and JSON, written as it is done: what Ctrl-C leaves is whole. A shape is not varied in what "
    "it\n"
    "  does not depend on.\n"
    "    frame_budget --scene heap,crush --bodies 20,100 --mesh bunny.obj --shape tree,gimpact --budget-ops 5000,none\n"
    "  Beside the figures of one run: the contacts of the last step beside the exact meshes; jitter, the change of a\n"
    "  body's velocity from step to step, root mean square over all bodies and the steps of the last second; "
    "divergence\n"
    "  from the exact run, the distance of a body from where it is in the same scene of gimpact at a margin of 0.1 %,\n"
    "  mean over bodies, after one second and at the end (where that run is in the sweep; it is made first).";

/// The texts of the command line before they are parsed.
struct RawOptions {
  ListTexts lists;
  std::string meeting = scenes::meetingName(scenes::Meeting::bounce);
  std::optional<std::uint32_t> steps;
  bool noSleeping = false;
  std::vector<CLI::Option*> ofConverge;  // only for this scene
};

bool isNone(const std::string& text) {
  return text == "none";
}

// CLI11's own ranges accept NaN, and read more forms than `numberOf`.
std::string refuseNoFraction(const std::string& text) {
  const double value = numberOf<double>(text).value_or(-1);
  const bool isFraction = value >= 0 && value <= 1;
  return isFraction || isNone(text) ? std::string() : "'" + text + "' is not a fraction from 0 to 1";
}

std::string refuseNoMicroseconds(const std::string& text) {
  const double value = numberOf<double>(text).value_or(-1);
  const bool isNumber = value >= 0 && std::isfinite(value);
  return isNumber || isNone(text) ? std::string() : "'" + text + "' is not a number of microseconds, 0 or more";
}

std::string refuseNoOperations(const std::string& text) {
  return isNone(text) ? std::string() : scenes::refuseNoWholeNumber(text);
}

std::string refuseNoBodies(const std::string& text) {
  const std::uint32_t bodies = numberOf<std::uint32_t>(text).value_or(0);
  return bodies >= 1 && bodies <= 100000 ? std::string() : "'" + text + "' is not a number of bodies from 1 to 100000";
}

/// True when any list but that of the shapes has several items.
bool isList(const ListTexts& t) {
  const auto several = [](const std::string& text) { return text.find(',') != std::string::npos; };
  return several(t.scenes) || several(t.bodies) || several(t.budgetOperations) || several(t.budgetMicroseconds) ||
         several(t.marginFractions) || several(t.maxContactErrors) || several(t.methods) || several(t.priorities) ||
         several(t.unresolved);
}

void declareScene(CLI::App& app, Options& options, RawOptions& raw) {
  app.add_option("--scene", raw.lists.scenes,
                 "heap: bodies dropped in a column into a pit; crush: bodies that start deep in each other; converge: "
                 "bodies flying to one point, the same recorded poses for every shape; rockfall: bodies released above "
                 "a stepped slope of triangles")
      ->capture_default_str();
  app.add_option("--bodies", raw.lists.bodies,
                 "bodies in the scene (default 100 in heap and rockfall, 20 in crush and converge)")
      ->check(eachItem(refuseNoBodies));
  app.add_option("--steps", raw.steps,
                 "steps of 1/60 s (default 600; in converge frames of each run, default 300; in rockfall of 1/120 s, "
                 "default 1200)")
      ->check(CLI::Range(1U, 10000000U));
  app.add_option("--seed", options.heap.seed, "of the bodies' orientations and places")
      ->check(scenes::refuseNoWholeNumber)
      ->capture_default_str();
  app.add_flag("--no-sleeping", raw.noSleeping, "keep resting bodies awake");
  app.add_option("--shape", raw.lists.shapes,
                 "tree, tree+triangles (the same), tree+leaves (contacts between its leaves), gimpact, hull, spheres, "
                 "compound (of the "
                 "hulls HACD cuts the mesh into) or fcl (only in converge); "
                 "several with commas, compared in one run")
      ->capture_default_str();
  app.add_option(
         "--margin-fraction", raw.lists.marginFractions,
         "collision margin of gimpact, hull and compound as a fraction of body size (default 0.001, 0.01 and 0.01)")
      ->check(eachItem(refuseNoFraction));
  app.add_option(
         "--max-contact-error", raw.lists.maxContactErrors,
         "contacts of trees are measured on the coarsest level mesh this near to the mesh, as a fraction of its "
         "size; the tree has such meshes with `cairn build --level-meshes` (default 0: the mesh itself)")
      ->check(eachItem(refuseNoFraction));
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
  app.add_option("--method", raw.lists.methods, "how the tree is built: see cairn build --help")->capture_default_str();
  app.add_option("--depth", options.source.build.depth, "levels of the tree below its root")
      ->check(CLI::Range(1U, 8U))
      ->capture_default_str();
  app.add_option("--rock", options.source.rock.seed, "seed of the generated rock")
      ->check(scenes::refuseNoWholeNumber)
      ->capture_default_str();
}

void declareNarrowPhase(CLI::App& app, Options& options, RawOptions& raw) {
  app.add_option("--budget-ops", raw.lists.budgetOperations, "narrow-phase operations a step (default: no limit)")
      ->check(eachItem(refuseNoOperations));
  app.add_option("--budget-us", raw.lists.budgetMicroseconds, "narrow-phase microseconds a step (default: no limit)")
      ->check(eachItem(refuseNoMicroseconds));
  app.add_option("--budget-from", options.heap.stepsWithoutBudget,
                 "heap, crush and rockfall: steps before the budget holds; what it then does to the certified error is "
                 "reported")
      ->check(scenes::refuseNoWholeNumber)
      ->capture_default_str();
  app.add_option("--threads", options.threads,
                 "threads that the narrow phase of trees works on; bodies end where they do on one. Its time is the "
                 "elapsed one then: CPU times are those of one thread")
      ->check(CLI::Range(1, 64))
      ->capture_default_str();
  scenes::addPriorityOption(app, raw.lists.priorities);
  app.add_flag("--viewer", options.heap.isWatched,
               "somebody stands at the pit and looks at the middle of the heap: priorities that care serve them, and "
               "the error they see is reported");
  app.add_option("--unresolved", raw.lists.unresolved,
                 "what an unfinished pair answers: guard, repel, ignore or compensate")
      ->capture_default_str();
}

void declareOutput(CLI::App& app, Options& options) {
  app.add_option("--json", options.json,
                 "write the figures to this file: an object, of several shapes or combinations an array");
  app.add_option("--csv", options.csv,
                 "write what every step did to this file; of a sweep, a line for each combination");
  app.add_option("--picture", options.picture,
                 "heap and crush: render the end to this PNG (needs POV-Ray; first shape)");
}

/// The options that only some scenes have.
Status checkCombination(const RawOptions& raw, const Options& options) {
  if (options.scene == Scene::converge) {
    if (options.picture) return Error{"--picture draws how bodies come to rest: use it with --scene heap or crush"};
    const double motions = 1.0 * options.converge.bodies * options.converge.runs * options.converge.frames;
    if (motions > kMaxMotions)
      return Error{
          fmt::format("{:.0f} recorded poses are too many for memory: --bodies, --runs and --steps multiply to "
                      "{:.0f} at most",
                      motions, kMaxMotions)};
    if (options.heap.stepsWithoutBudget > 0)
      return Error{"--budget-from is for what begins in the air: use it with --scene heap, crush or rockfall"};
    if (options.heap.isWatched) return Error{"--viewer looks at a heap: use it with --scene heap or crush"};
    if (raw.noSleeping) return Error{"--no-sleeping is for simulated bodies: use it with --scene heap or crush"};
    return {};
  }
  if (options.scene == Scene::rockfall && options.picture)
    return Error{"--picture draws a heap: use it with --scene heap or crush"};
  if (options.scene == Scene::rockfall && options.heap.isWatched)
    return Error{"--viewer looks at a heap: use it with --scene heap or crush"};
  if (std::ranges::find(options.shapes, scenes::ShapeKind::fcl) != options.shapes.end())
    return Error{"the shape fcl only answers recorded poses: use it with --scene converge"};
  return {};
}

Result<Command> understand(const RawOptions& raw, Options& base) {
  const auto meeting = scenes::parseMeeting(raw.meeting);
  if (!meeting) return meeting.error();
  base.converge.meeting = meeting.value();
  base.heap.world.sleeping = !raw.noSleeping;
  auto combinations = combinationsOf(raw.lists, base, raw.steps);
  if (!combinations) return combinations.error();
  Command command{std::move(combinations).value(), isList(raw.lists)};
  if (command.isSweep && base.picture) return Error{"--picture draws one run: leave the lists to one value each"};
  for (const Options& options : command.measurements)
    if (Status possible = checkCombination(raw, options); !possible) return possible.error();
  const bool hasConverge =
      std::ranges::any_of(command.measurements, [](const Options& o) { return o.scene == Scene::converge; });
  for (const CLI::Option* option : raw.ofConverge)
    if (!hasConverge && option->count() > 0)
      return Error{fmt::format("{} belongs to recorded poses: use it with --scene converge", option->get_name())};
  return command;
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
    case Scene::rockfall:
      return "rockfall";
  }
  return "";
}

std::variant<Command, int> parseOptions(int argc, const char* const* argv) {
  CLI::App app(
      "Measures what the collision of many bodies of one mesh costs and how right it is, for one shape or several in "
      "the same run.",
      kProgram);
  Options options;
  RawOptions raw;
  declareScene(app, options, raw);
  declareConverge(app, options, raw);
  declareTree(app, options, raw);
  declareNarrowPhase(app, options, raw);
  declareOutput(app, options);
  app.footer(kExamples);
  if (const auto code = scenes::parseCommandLine(app, argc, argv)) return *code;
  auto command = understand(raw, options);
  if (!command) return refuseUsage(kProgram, command.error());
  return std::move(command).value();
}

}  // namespace cairn::frame_budget

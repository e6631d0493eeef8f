// SPDX-License-Identifier: GPL-3.0-or-later
#include "options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <string>

#include "scenes/command/program.h"

namespace cairn::advise {
namespace {

constexpr const char* kDescription =
    "Measures this machine: which tree of a mesh, and which budget of operations, give which certified error within "
    "the "
    "microseconds a step may take. Builds trees, has bodies of the mesh fly to one point, bounce as exact meshes and "
    "be "
    "looked at by Bullet through each tree at several budgets. Errors and operations are the same bits on every run; "
    "times are this machine's.";

constexpr const char* kExamples =
    "Examples:\n"
    "  cairn advise bunny.obj --bodies 50 --budget-us 1000\n"
    "  cairn advise rock.obj --budget-us 300 --methods combined,adaptive --depths 2,3 --json advice.json\n"
    "  cairn advise rock.obj --budget-us 300 --figure advice.svg\n"
    "  cairn advise rock.obj --budget-us 300 --thorough";

std::string refuseNoTime(const std::string& text) {
  double value = 0;
  const bool isTime = CLI::detail::lexical_cast(text, value) && value > 0 && value < 1e12;
  return isTime ? std::string() : "'" + text + "' is not a number of microseconds above 0";
}

std::string refuseNoMethod(const std::string& text) {
  const auto method = builder::parseMethod(text);
  return method ? std::string() : method.error().message;
}

}  // namespace

std::variant<Options, int> parseOptions(int argc, const char* const* argv) {
  CLI::App app(kDescription, "cairn advise");
  app.footer(kExamples);
  Options options;
  std::vector<std::string> methods;
  std::string seed = "1";
  bool thorough = false;
  for (const builder::Method method : options.trial.methods) methods.emplace_back(builder::methodName(method));
  app.add_option("MESH", options.mesh, "closed mesh, any format assimp reads")->required();
  app.add_option("--budget-us", options.budgetUs, "microseconds the narrow phase may take in a step")
      ->required()
      ->check(refuseNoTime);
  app.add_option("--bodies", options.trial.bodies, "bodies that fly to one point")
      ->check(CLI::Range(2U, 1000U))
      ->capture_default_str();
  app.add_option("--methods", methods, "how trees are built, see cairn build --help; separated by commas")
      ->delimiter(',')
      ->check(refuseNoMethod)
      ->capture_default_str();
  app.add_option("--depths", options.trial.depths, "levels below the root; separated by commas")
      ->delimiter(',')
      ->check(CLI::Range(1U, 8U))
      ->capture_default_str();
  app.add_option("--branching", options.trial.branchings, "most children of a sphere; separated by commas")
      ->delimiter(',')
      ->check(CLI::Range(2U, 8U))
      ->capture_default_str();
  app.add_option("--frames", options.trial.frames, "steps of 1/60 s that are recorded")
      ->check(CLI::Range(1U, 100000U))
      ->capture_default_str();
  app.add_option("--starts", options.trial.starts, "random starts that are recorded")
      ->check(CLI::Range(1U, 100U))
      ->capture_default_str();
  app.add_option("--repeats", options.trial.repeats,
                 "how often each is played after the first time; all steps of all playings count")
      ->check(CLI::Range(1U, 100U))
      ->capture_default_str();
  app.add_option("--seed", seed, "of places, speeds and trees")
      ->check(scenes::refuseNoWholeNumber)
      ->capture_default_str();
  app.add_option("--threads", options.threads, "that build trees, 0: one per core; nothing but time depends on it")
      ->check(CLI::Range(0U, 1024U));
  app.add_flag("--thorough", thorough,
               "try adaptive too (unless methods are named) and play all trees equally often: minutes instead of one");
  app.add_flag("--all", options.all, "print every budget of every tree, not the best of each alone");
  app.add_option("--json", options.json, "write all figures to this file too");
  app.add_option("--figure", options.figure, "draw the curves: FILE.svg, and FILE.png beside it (needs gnuplot)");
  if (const auto code = scenes::parseCommandLine(app, argc, argv)) return *code;
  options.trial.methods.clear();
  for (const std::string& name : methods) options.trial.methods.push_back(builder::parseMethod(name).value());
  options.trial.seed = std::stoull(seed);
  if (thorough) {
    // The method whose build takes as long as all others together.
    if (app["--methods"]->count() == 0) options.trial.methods.push_back(builder::Method::adaptive);
  } else {
    options.trial.sieveUs = options.budgetUs;
  }
  if (options.figure && options.figure->extension() != ".svg")
    return scenes::refuseUsage("cairn advise", {"--figure wants a name that ends in .svg (--help lists the options)"});
  const auto needsEight = [](builder::Method method) { return builder::dividesByEight(method); };
  if (std::ranges::all_of(options.trial.methods, needsEight) &&
      std::ranges::find(options.trial.branchings, 8U) == options.trial.branchings.end())
    return scenes::refuseUsage("cairn advise", {"octrees have 8 children: add 8 to --branching, or another method"});
  return options;
}

}  // namespace cairn::advise

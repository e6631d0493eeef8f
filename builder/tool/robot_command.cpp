// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <memory>

#include "cairn/builder/robot.h"
#include "cairn/core/atomic_file.h"
#include "tool/command.h"
#include "tool/interrupt.h"
#include "tool/package_paths.h"
#include "tool/progress_bar.h"
#include "tool/robot_report.h"
#include "tool/stopwatch.h"

namespace cairn::tool {
namespace {

constexpr const char* kAboutRobot =
    "Cover the collision meshes of a robot (URDF) by spheres, and prove the cover link by link.\n\n"
    "  cairn robot arm.urdf -o arm_spheres.urdf --spheres 16\n"
    "  cairn robot arm.urdf -o out.urdf --total 200 --package-path arm_description=../arm_description\n"
    "  cairn robot arm.urdf -o out.urdf --max-error 0.01 --primitives --curobo arm.yml --xrdf arm.xrdf\n"
    "  cairn robot arm.urdf -o out.urdf --spheres 8 --link-spheres hand=24 --srdf arm.srdf --mjcf arm.xml\n\n"
    "Meshes that bound no solid are repaired or wrapped, and the report says so. Meshes that are copies or mirror "
    "images\n"
    "of each other share one set. The URDF written differs from the one read in its <collision> elements alone.\n"
    "Links are also checked against each other at sampled joint positions: where spheres touch and meshes do not.\n"
    "Pairs of parent and child, and pairs whose meshes always meet, are written as pairs to ignore.";

/// An output besides the URDF.
struct RobotFormat {
  const char* option;
  const char* about;
  Result<std::string> (*text)(const builder::RobotOutput& output);
};

constexpr std::array kRobotFormats{
    RobotFormat{"--srdf", "Write link_sphere_approximation and disable_collisions for MoveIt", builder::robotSrdfText},
    RobotFormat{"--curobo", "Write a robot configuration (YAML) for cuRobo", builder::robotCuroboText},
    RobotFormat{"--xrdf", "Write an XRDF 1.0 for NVIDIA Isaac and cuMotion", builder::robotXrdfText},
    RobotFormat{"--mjcf",
                "Write a model for MuJoCo; links without <inertial> get the mass of their spheres at 1000 kg/m^3",
                builder::robotMjcfText},
};

struct RobotCommand {
  std::string input, output, json, objective = "outer";
  std::array<std::string, kRobotFormats.size()> others;  // in the order of the table
  std::vector<std::string> linkSpheres, toolFrames;
  builder::RobotOptions options;
  builder::SelfCollisionOptions check;
  unsigned threads = 0;
};

using Texts = std::vector<std::pair<std::string, std::string>>;  // file, content

/// Throws as the parser does.
void readPairs(RobotCommand& command) {
  for (const std::string& text : command.linkSpheres) {
    const auto [name, number] = namedValue("--link-spheres", text);
    std::uint32_t count = 0;
    const char* const end = number.data() + number.size();
    const auto parsed = std::from_chars(number.data(), end, count);
    if (parsed.ec != std::errc{} || parsed.ptr != end || count < 1 || count > builder::kMaxCoverSpheres)
      throw CLI::ValidationError("--link-spheres", fmt::format("'{}' is not a number of spheres from 1 to {}", number,
                                                               builder::kMaxCoverSpheres));
    command.options.budget.ofLink[name] = count;
  }
}

Status checkToolFrames(const RobotCommand& command, const builder::RobotModel& model) {
  for (const std::string& frame : command.toolFrames)
    if (std::none_of(model.links.begin(), model.links.end(), [&](const auto& link) { return link.name == frame; }))
      return Error{
          fmt::format("{}: there is no link '{}' to be a tool frame; correct --tool-frame", model.file, frame)};
  return {};
}

/// A contact that covers missed although they are proved would be a fault of this program.
Status checkProof(const RobotReport& report) {
  const auto isProved = [&](std::uint32_t l) {
    const auto& parts = report.fitted.links[l];
    return std::all_of(parts.begin(), parts.end(), [](const auto& part) { return !part.solid || part.coversNamed; });
  };
  for (const builder::LinkPairCount& pair : report.collisions.touching)
    if (pair.missed > 0 && isProved(pair.first) && isProved(pair.second))
      return Error{
          fmt::format("links '{}' and '{}' meet at {} positions where no sphere touches, although both covers "
                      "are proved: a fault of this program, please report it",
                      report.model.links[pair.first].name, report.model.links[pair.second].name, pair.missed)};
  return {};
}

Result<Texts> textsOf(const RobotCommand& command, const RobotReport& report) {
  const builder::RobotOutput output{report.model, report.fitted, report.collisions, command.output, command.toolFrames};
  const Result<std::string> urdf = builder::robotUrdfText(output);
  if (!urdf) return urdf.error();
  Texts texts{{command.output, urdf.value()}};
  for (std::size_t i = 0; i < kRobotFormats.size(); ++i) {
    if (command.others[i].empty()) continue;
    const Result<std::string> text = kRobotFormats[i].text(output);
    if (!text) return text.error();
    texts.emplace_back(command.others[i], text.value());
  }
  return texts;
}

int finish(const RobotCommand& command, const RobotReport& report, const Stopwatch& stopwatch) {
  if (Status s = checkProof(report); !s) return refuse(s.error());
  const Result<Texts> texts = textsOf(command, report);
  if (!texts) return refuse(texts.error());
  Json json = robotJson(report);
  json["urdf"] = command.output;
  json["self_collision"]["seed"] = command.check.seed;
  json["threads"] = threadsUsed(command.threads);
  json["cpu_s"] = stopwatch.cpuSeconds();
  json["wall_s"] = stopwatch.wallSeconds();
  json["peak_rss_mb"] = peakMemoryMb();
  if (Status s = beginWriting(); !s) return refuse(s.error());
  for (const auto& [file, text] : texts.value())
    if (Status s = writeFileAtomically(file, text); !s) return refuse(s.error());
  if (Status s = writeJson(json, command.json); !s) return refuse(s.error());
  if (command.json == "-") return kDone;
  fmt::print("{}: {} spheres ({}) in {:.2f} s ({:.2f} s of CPU)\n", command.output, json["spheres"].get<std::size_t>(),
             command.objective, json["wall_s"].get<double>(), json["cpu_s"].get<double>());
  printRobot(report);
  return kDone;
}

Status checkPaths(const RobotCommand& command) {
  std::vector<std::string> outputs{command.output, command.json};
  outputs.insert(outputs.end(), command.others.begin(), command.others.end());
  for (const std::string& output : outputs)
    if (!output.empty() && output != "-")
      if (Status s = checkWritable(output); !s) return s;
  return checkOutputs({command.input}, outputs);
}

int run(RobotCommand& command) {
  const Stopwatch stopwatch;
  const Result<builder::Objective> objective = builder::parseObjective(command.objective);
  if (!objective) return refuse(objective.error());
  command.options.objective = objective.value();
  command.check.seed = command.options.seed;
  if (Status s = checkPaths(command); !s) return refuse(s.error());
  const Result<builder::RobotModel> model = builder::readUrdf(command.input);
  if (!model) return refuse(model.error());
  if (Status s = checkToolFrames(command, model.value()); !s) return refuse(s.error());
  ProgressBar bar;
  const auto fitted = builder::fitRobot(model.value(), command.input, command.options, bar.callback());
  if (!fitted) return refuse(fitted.error());
  const auto collisions = builder::checkSelfCollision(model.value(), fitted.value(), command.check, bar.callback());
  if (!collisions) return refuse(collisions.error());
  return finish(command, {model.value(), fitted.value(), collisions.value(), command.options}, stopwatch);
}

std::string checkError(const std::string& text) {
  double value = 0;
  const bool holds = CLI::detail::lexical_cast(text, value) && value > 0 && std::isfinite(value);
  return holds ? std::string() : fmt::format("'{}' is not a length above 0", text);
}

/// The three ways to say how many spheres there are to be.
struct BudgetOptions {
  std::uint32_t perLink = 0, total = 0;
  double maxError = 0;
  CLI::Option *perLinkGiven = nullptr, *totalGiven = nullptr, *maxErrorGiven = nullptr;

  void add(CLI::App& sub) {
    perLinkGiven = sub.add_option("--spheres", perLink, "How many spheres for each link, exactly")
                       ->check(CLI::Range(1U, builder::kMaxCoverSpheres));
    totalGiven = sub.add_option("--total", total, "How many for all links together, shared out by certified error")
                     ->check(CLI::Range(1U, 1000000U));
    maxErrorGiven =
        sub.add_option("--max-error", maxError, "The fewest found for each mesh that keep this error, metres")
            ->check(CLI::Validator(checkError, "", "length"));
    perLinkGiven->excludes(totalGiven)->excludes(maxErrorGiven);
    totalGiven->excludes(maxErrorGiven);
  }
  void tell(builder::RobotBudget& budget) const {
    if (perLinkGiven->empty() && totalGiven->empty() && maxErrorGiven->empty())
      throw CLI::RequiredError("--spheres, --total or --max-error");
    if (!perLinkGiven->empty()) budget.perLink = perLink;
    if (!totalGiven->empty()) budget.total = total;
    if (!maxErrorGiven->empty()) budget.maxError = maxError;
  }
};

void addOutputs(CLI::App& sub, RobotCommand& command) {
  sub.add_option("-o,--output", command.output, "URDF to write, with <sphere> collisions")->required();
  for (std::size_t i = 0; i < kRobotFormats.size(); ++i)
    sub.add_option(kRobotFormats[i].option, command.others[i], kRobotFormats[i].about);
  sub.add_option("--tool-frame", command.toolFrames,
                 "Link at which a tool is, for --curobo and --xrdf (default: all links without children)")
      ->allow_extra_args(false);
  sub.add_option("--json", command.json, "Write the report as JSON too; - is standard output");
}

}  // namespace

void addRobotCommand(CLI::App& app, Action& action) {
  auto command = std::make_shared<RobotCommand>();
  auto budget = std::make_shared<BudgetOptions>();
  CLI::App* sub = app.add_subcommand("robot", kAboutRobot);
  sub->add_option("URDF", command->input, "Robot, without xacro's macros")->required();
  addPackageOption(*sub, command->options.packages);
  budget->add(*sub);
  sub->add_option("--link-spheres", command->linkSpheres, "LINK=N: so many for this link instead")
      ->allow_extra_args(false)
      ->needs(budget->perLinkGiven);
  sub->add_option("--objective", command->objective, "What the spheres are to be good at, as `cairn cover` has it")
      ->check(CLI::IsMember(builder::objectiveNames()))
      ->capture_default_str();
  sub->add_flag("--primitives", command->options.primitives,
                "Cover boxes and cylinders by spheres too; otherwise they are kept, and only --mjcf can hold them");
  sub->add_option("--check-poses", command->check.poses,
                  "Joint positions at which links are checked against each other; 0: none")
      ->check(CLI::Range(0U, 1000000U))
      ->capture_default_str();
  addOutputs(*sub, *command);
  addSeedOption(*sub, command->options.seed, "Same robot, options and seed: same bytes");
  addThreadsOption(*sub, command->threads);
  sub->callback([command, budget, &action] {
    readPairs(*command);
    budget->tell(command->options.budget);
    action = [command] { return withThreads(command->threads, [command] { return run(*command); }); };
  });
}

}  // namespace cairn::tool

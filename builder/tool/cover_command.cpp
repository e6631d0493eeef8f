// SPDX-License-Identifier: GPL-3.0-or-later
#include "cairn/builder/cover.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "cairn/builder/sha256.h"
#include "cairn/core/atomic_file.h"
#include "tool/command.h"
#include "tool/cover_report.h"
#include "tool/interrupt.h"
#include "tool/mesh_source.h"
#include "tool/progress_bar.h"
#include "tool/stopwatch.h"

namespace cairn::tool {
namespace {

constexpr const char* kAboutCover =
    "Cover a mesh by a flat set of spheres, exactly as many as asked for or the fewest that keep an error, and prove\n"
    "how far they stick out and how much they leave out.\n\n"
    "  cairn cover link.obj --spheres 20 -o link.txt\n"
    "  cairn cover link.obj --max-error 0.005 -o link.txt        mesh units\n"
    "  cairn cover grain.stl --spheres 64 --objective volume -o grain.txt --json grain.json\n"
    "  cairn cover arm.ply --spheres 16 --symmetric -o arm.txt\n\n"
    "The file has a line `x y z r error inner` a sphere: centre, radius, proved protrusion, inner radius (the "
    "concentric\n"
    "ball that lies in the solid). Objectives:\n"
    "  outer     covers the surface, sticks out as little as can be (for collision checks that must not miss)\n"
    "  balanced  as far inside as outside: least worst distance both ways (for distances and looks)\n"
    "  inner     spheres lie in the solid, leave out as little as can be (for certain contact, and what must not "
    "swell)\n"
    "  volume    covers the surface with the least volume outside (for planners that count free space)";

struct CoverCommand {
  MeshSourceOptions source;
  std::string output, json, objective = "outer";
  builder::CoverOptions options;
  bool noEvaluate = false;
  unsigned threads = 0;
};

struct Covered {
  MeshSource source;
  builder::Cover cover;
  double cpuSeconds = 0, wallSeconds = 0;
};

Result<Covered> cover(const CoverCommand& command, const builder::ProgressCallback& progress) {
  const Stopwatch stopwatch;
  Result<MeshSource> source = readMeshSource(command.source, progress);
  if (!source) return source.error();
  if (interrupted()) return Error{std::string(builder::kCancelled)};
  Result<builder::Cover> made = builder::coverMesh(source.value().mesh, command.options, progress);
  if (!made) return made.error();
  return Covered{std::move(source).value(), std::move(made).value(), stopwatch.cpuSeconds(), stopwatch.wallSeconds()};
}

/// Measures, and only then writes: a cancelled run leaves nothing.
int finish(const CoverCommand& command, const Covered& covered, const builder::ProgressCallback& progress) {
  CoverReport report{covered.source.mesh, covered.cover, command.options, {}};
  if (!command.noEvaluate) {
    const auto fit = builder::evaluateBalls(covered.cover.balls, covered.source.mesh, command.options.seed, progress);
    if (!fit) return refuse(fit.error());
    report.sampled = fit.value();
  }
  if (Status s = beginWriting(); !s) return refuse(s.error());
  const std::string text = builder::coverText(covered.cover);
  Json json = coverJson(report);
  json["threads"] = threadsUsed(command.threads);
  json["cover_cpu_s"] = covered.cpuSeconds;
  json["cover_wall_s"] = covered.wallSeconds;
  json["peak_rss_mb"] = peakMemoryMb();
  json["cover_sha256"] = builder::sha256Hex(std::as_bytes(std::span(text)));
  reportMeshSource(covered.source, {}, json);
  if (Status s = writeMeshOutput(covered.source, command.source); !s) return refuse(s.error());
  if (Status s = writeFileAtomically(command.output, text); !s) return refuse(s.error());
  if (Status s = writeJson(json, command.json); !s) return refuse(s.error());
  if (command.json == "-") return kDone;
  fmt::print("{}: {} spheres ({}) for {} triangles in {:.2f} s ({:.2f} s of CPU)\n", command.output,
             covered.cover.balls.size(), command.objective, covered.source.mesh.triangles.size(), covered.wallSeconds,
             covered.cpuSeconds);
  printCover(report);
  printMeshSource(covered.source, {});
  return kDone;
}

int run(CoverCommand& command) {
  const Result<builder::Objective> objective = builder::parseObjective(command.objective);
  if (!objective) return refuse(objective.error());
  command.options.objective = objective.value();
  if (Status s = checkWritable(command.output); !s) return refuse(s.error());
  if (Status s = checkOutputs({command.source.path}, {command.output, command.json, command.source.output}); !s)
    return refuse(s.error());
  ProgressBar bar;
  const Result<Covered> covered = cover(command, bar.callback());
  return covered ? finish(command, covered.value(), bar.callback()) : refuse(covered.error());
}

std::string checkLength(const std::string& text) {
  double value = 0;
  const bool holds = CLI::detail::lexical_cast(text, value) && value > 0 && std::isfinite(value);
  return holds ? std::string() : fmt::format("'{}' is not a length above 0", text);
}

}  // namespace

void addCoverCommand(CLI::App& app, Action& action) {
  auto command = std::make_shared<CoverCommand>();
  CLI::App* sub = app.add_subcommand("cover", kAboutCover);
  addMeshSource(*sub, command->source);
  auto spheres = std::make_shared<std::uint32_t>(0);
  auto maxError = std::make_shared<double>(0);
  CLI::Option* count = sub->add_option("--spheres", *spheres, "How many spheres, exactly")
                           ->check(CLI::Range(1U, builder::kMaxCoverSpheres));
  CLI::Option* error =
      sub->add_option("--max-error", *maxError,
                      "The fewest spheres found whose proved error is no more, in mesh units: what sticks out "
                      "(outer, volume), what is left out (inner), the larger of both (balanced)")
          ->check(CLI::Validator(checkLength, "", "length"));
  count->excludes(error);
  sub->add_option("--objective", command->objective, "What the spheres are to be good at")
      ->check(CLI::IsMember(builder::objectiveNames()))
      ->capture_default_str();
  sub->add_flag("--symmetric", command->options.symmetric,
                "Keep a mirror plane of the mesh: spheres in pairs and on the plane");
  sub->add_option("-o,--output", command->output, "Text file to write, a line `x y z r error inner` a sphere")
      ->required();
  addSeedOption(*sub, command->options.seed, "Same mesh, options and seed: same bytes");
  addThreadsOption(*sub, command->threads);
  sub->add_option("--json", command->json, "Write the report as JSON too; - is standard output");
  sub->add_flag("--no-evaluate", command->noEvaluate, "Report what is proved only, without the sampled measures");
  sub->callback([command, spheres, maxError, count, error, &action] {
    checkMeshSource(command->source);
    if (count->empty() == error->empty()) throw CLI::RequiredError("--spheres or --max-error");
    command->options.spheres = count->empty() ? std::nullopt : std::optional(*spheres);
    command->options.maxError = error->empty() ? std::nullopt : std::optional(*maxError);
    action = [command] { return withThreads(command->threads, [command] { return run(*command); }); };
  });
}

}  // namespace cairn::tool

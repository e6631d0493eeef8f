// SPDX-License-Identifier: GPL-3.0-or-later
#include "cairn/builder/build.h"

#include <fmt/format.h>

#include <memory>

#include "cairn/builder/certify.h"
#include "cairn/builder/evaluate.h"
#include "cairn/core/atomic_file.h"
#include "cairn/core/tree_file.h"
#include "tool/command.h"
#include "tool/interrupt.h"
#include "tool/judgement.h"
#include "tool/mesh_source.h"
#include "tool/progress_bar.h"
#include "tool/report.h"
#include "tool/stopwatch.h"

namespace cairn::tool {
namespace {

constexpr const char* kAboutBuild =
    "Build a certified sphere-tree of a closed mesh. An open or faulty one can be repaired, any one wrapped in a "
    "closed\n"
    "skin; the tree is then certified against the repaired mesh or the skin, and --mesh-output keeps that for `cairn\n"
    "certify`. With --wrap the report also bounds the error against the original: how far a point of a sphere outside "
    "the\n"
    "skin can be from the original surface, open or not.\n\n"
    "  cairn build rock.obj -o rock.cairn\n"
    "  cairn build rock.obj -o rock.cairn --depth 4 --samples 20000 --json report.json\n"
    "  cairn build rock.obj -o quick.cairn --method octree --no-evaluate\n"
    "  cairn build rock.obj -o lean.cairn --balance 0.05\n"
    "  cairn build rock.obj -o hybrid.cairn --method hybrid --two-spheres\n"
    "  cairn build rock.obj -o thesis.cairn --method burst --optimise thesis --balance work --division planes\n"
    "  cairn build scan.ply -o scan.cairn --repair\n"
    "  cairn build ship.dae -o ship.cairn --wrap --wrap-alpha 0.05 --mesh-output skin.ply";

struct BuildCommand {
  MeshSourceOptions source;
  std::string output, json;
  std::string method = builder::methodName(builder::BuildOptions{}.method), optimiser, balance,
              division = builder::divisionName(builder::BuildOptions{}.division);
  builder::BuildOptions options;
  bool noEvaluate = false;
};

struct Built {
  MeshSource source;
  SphereTree tree;
  builder::Certificate certificate;
};

Result<Built> build(const BuildCommand& command, const builder::ProgressCallback& progress) {
  Result<MeshSource> source = readMeshSource(command.source, progress);
  if (!source) return source.error();
  const builder::TriangleMesh& mesh = source.value().mesh;
  if (interrupted()) return Error{std::string(builder::kCancelled)};
  Result<SphereTree> tree = builder::buildTree(mesh, command.options, progress);
  if (!tree) return tree.error();
  Result<builder::Certificate> certificate = builder::certify(tree.value(), mesh, progress);
  if (!certificate) return certificate.error();
  if (const auto failures = certificate.value().failures(tree.value()); !failures.empty())
    return Error{
        fmt::format("{}: the tree could not be certified and was not written ({}); try other options and report "
                    "this mesh",
                    mesh.name, failures.front())};
  return Built{std::move(source).value(), std::move(tree).value(), std::move(certificate).value()};
}

/// Evaluates, and only then writes: a cancelled run leaves nothing.
int finish(const BuildCommand& command, const Built& built, double cpuSeconds, double wallSeconds,
           const builder::ProgressCallback& progress) {
  const double peakMb = peakMemoryMb();  // of the build: before the evaluation
  const auto sampling = command.noEvaluate ? builder::Sampling::none : builder::Sampling::full;
  const auto fits =
      builder::evaluate(built.tree, built.source.mesh, built.certificate, sampling, command.options.seed, progress);
  if (!fits) return refuse(fits.error());
  const Judgement judgement = judge(built.tree.info(), fits.value());
  if (Status s = beginWriting(); !s) return refuse(s.error());
  if (Status s = writeMeshOutput(built.source, command.source); !s) return refuse(s.error());
  if (Status s = saveTree(built.tree, command.output); !s) return refuse(s.error());
  Json json = buildInfoJson(built.tree);
  json["threads"] = threadsUsed(command.options.threads);
  json["build_cpu_s"] = cpuSeconds;
  json["build_wall_s"] = wallSeconds;
  json["peak_rss_mb"] = peakMb;
  json["tree_sha256"] = treeSha256(built.tree);
  json["levels"] = levelsJson(fits.value(), sampling);
  json["leaf_error_fraction"] = judgement.leafErrorFraction;
  json["advice"] = judgement.words;
  reportMeshSource(built.source, fits.value(), json);
  if (Status s = writeJson(json, command.json); !s) return refuse(s.error());
  if (command.json == "-") return kDone;
  fmt::print("{}: {} nodes from {} triangles in {:.2f} s ({:.2f} s of CPU, {:.0f} MB)\n", command.output,
             built.tree.nodeCount(), built.source.mesh.triangles.size(), wallSeconds, cpuSeconds, peakMb);
  printLevels(fits.value(), sampling);
  printMeshSource(built.source, fits.value());
  fmt::print("{}\n", judgement.words);
  return kDone;
}

/// Reads the options for sphere sets from their texts.
Status readSetTreatment(BuildCommand& command) {
  if (!command.optimiser.empty()) {
    const Result<builder::Optimiser> optimiser = builder::parseOptimiser(command.optimiser);
    if (!optimiser) return optimiser.error();
    command.options.optimiser = optimiser.value();
  }
  if (!command.balance.empty()) {
    const Result<builder::Balance> balance = builder::parseBalance(command.balance);
    if (!balance) return balance.error();
    command.options.balance = balance.value();
  }
  const Result<builder::SurfaceDivision> division = builder::parseDivision(command.division);
  if (!division) return division.error();
  command.options.division = division.value();
  return {};
}

int run(BuildCommand& command) {
  Result<builder::Method> method = builder::parseMethod(command.method);
  if (!method) return refuse(method.error());
  command.options.method = method.value();
  if (Status s = readSetTreatment(command); !s) return refuse(s.error());
  if (Status s = checkWritable(command.output); !s) return refuse(s.error());
  if (Status s = checkOutputs({command.source.path}, {command.output, command.json, command.source.output}); !s)
    return refuse(s.error());
  const Stopwatch stopwatch;
  ProgressBar bar;
  Result<Built> built = build(command, bar.callback());
  if (!built) return refuse(built.error());
  const double cpuSeconds = stopwatch.cpuSeconds(), wallSeconds = stopwatch.wallSeconds();
  return finish(command, built.value(), cpuSeconds, wallSeconds, bar.callback());
}

/// Planes divide the sets of a method that fits regions, unless our own optimiser moves the seams.
void checkDivision(const BuildCommand& command, const Result<builder::Method>& method) {
  if (!method || command.division == builder::divisionName(builder::SurfaceDivision::standOff)) return;
  if (!builder::fitsRegions(method.value()))
    throw CLI::ValidationError("--division", "the method " + command.method +
                                                 " does not fit spheres region by region; leave the option out or "
                                                 "choose another method");
  if (command.optimiser.empty() ? builder::optimisedByCairn(method.value())
                                : command.optimiser == builder::optimiserName(builder::Optimiser::cairn))
    throw CLI::ValidationError("--division",
                               "--optimise cairn moves the seams itself; choose --optimise none or "
                               "--optimise thesis with planes");
}

/// Checks combinations of options; throws as the parser does.
void checkUsage(const BuildCommand& command) {
  checkMeshSource(command.source);
  const Result<builder::Method> method = builder::parseMethod(command.method);
  if (method && builder::dividesByEight(method.value()) && command.options.branching != 8)
    throw CLI::ValidationError("--branching",
                               "the method " + command.method + " divides by eight; choose 8 or another method");
  if (method && !builder::fitsRegions(method.value()) && !(command.optimiser.empty() && command.balance.empty()))
    throw CLI::ValidationError(command.optimiser.empty() ? "--balance" : "--optimise",
                               "the method " + command.method +
                                   " does not fit spheres region by region; leave the option out or choose another "
                                   "method");
  checkDivision(command, method);
}

}  // namespace

void addBuildCommand(CLI::App& app, Action& action) {
  auto command = std::make_shared<BuildCommand>();
  CLI::App* sub = app.add_subcommand("build", kAboutBuild);
  addMeshSource(*sub, command->source);
  sub->add_option("-o,--output", command->output, "Tree file to write (.cairn)")->required();
  sub->add_option("--method", command->method, "How regions are covered by spheres")
      ->check(CLI::IsMember(builder::methodNames()))
      ->capture_default_str();
  sub->add_option("--optimise", command->optimiser,
                  "How each region's spheres are improved: not, as in the thesis, or by our own search, which is the "
                  "default of combined, merge and expand")
      ->check(CLI::IsMember(builder::optimiserNames()));
  sub->add_option("--balance", command->balance,
                  "Drop spheres while the worst error of a node's children grows by at most this part, as 0.05; or "
                  "'work': the more spheres go, the more it may grow, 2.5 % for the first of eight, up to 4.2 %")
      ->check([](const std::string& text) {
        const Result<builder::Balance> balance = builder::parseBalance(text);
        return balance ? std::string() : balance.error().message;
      });
  sub->add_option("--division", command->division,
                  "How a region's spheres share its surface: each part goes to the sphere that needs the least "
                  "stand-off, or planes stand between each two spheres, as in the thesis; planes not with --optimise "
                  "cairn")
      ->check(CLI::IsMember(builder::divisionNames()))
      ->capture_default_str();
  sub->add_option("--branching", command->options.branching, "Most children of a sphere")
      ->check(CLI::Range(2U, 8U))
      ->capture_default_str();
  sub->add_option("--depth", command->options.depth, "Levels below the root")
      ->check(CLI::Range(1U, 8U))
      ->capture_default_str();
  sub->add_option("--samples", command->options.samples, "Surface pieces the spheres are fitted to, about")
      ->check(CLI::Range(100U, 1000000U))
      ->capture_default_str();
  sub->add_flag("--two-spheres", command->options.twoSpheres,
                "Give each node two spheres: traversals test the smallest one around its region, and the method's own "
                "answers; with --method hybrid as in the thesis");
  sub->add_flag("--level-meshes", command->options.levelMeshes,
                "Also make a coarser closed mesh for each level, with a certified distance to the mesh both ways");
  addSeedOption(*sub, command->options.seed, "Same mesh, options and seed: same bytes");
  addThreadsOption(*sub, command->options.threads);
  sub->add_option("--json", command->json, "Write the report as JSON too; - is standard output");
  sub->add_flag("--no-evaluate", command->noEvaluate,
                "Report what is certified only, without the slower sampled measures");
  sub->callback([command, &action] {
    checkUsage(*command);
    action = [command] { return withThreads(command->options.threads, [command] { return run(*command); }); };
  });
}

}  // namespace cairn::tool

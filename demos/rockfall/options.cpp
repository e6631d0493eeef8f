// SPDX-License-Identifier: GPL-3.0-or-later
#include "options.h"

#include <CLI/CLI.hpp>

#include "scenes/command/program.h"

namespace cairn::rockfall {
namespace {

constexpr const char* kDescription =
    "Lets rocks fall down a slope, without a window, as a case file tells it: run simulates, merge makes tables, "
    "rasters, trajectories and figures of what was run. A run is the same wherever and whenever it is computed, unless "
    "microseconds are its budget. Case files: docs/rockfall.md, and the schema.";

constexpr const char* kExamples =
    "Examples:\n"
    "  rockfall run slope.json --runs 0:100 --jobs 4 -o out/runs\n"
    "  rockfall merge out/runs -o out/merged --png\n"
    "  rockfall validate authume --jobs 4 --figure validation.svg --json validation.json\n"
    "  parallel --joblog jobs.log --resume rockfall run slope.json --runs 0:1000 --part {}/8 -o out/part-{} ::: 1 2 3 "
    "4 5 "
    "6 7 8";

struct Texts {
  std::string runs = "0:1", convergeRuns = "0:20";
  std::optional<std::string> part;
};

std::string refuseNoRange(const std::string& text) {
  const auto range = parseRange(text);
  return range ? std::string() : range.error().message;
}

CLI::App* addRun(CLI::App& app, RunCommand& run, Texts& texts) {
  CLI::App* command = app.add_subcommand("run", "simulate runs of a case that the folder does not hold yet");
  command->add_option("CASE", run.caseFile, "the case file")->required();
  command->add_option("--runs", texts.runs, "a:b, the runs a to b - 1")->check(refuseNoRange)->capture_default_str();
  command->add_option("--part", texts.part, "i/n, only the i-th of n parts of these runs")
      ->check([](const std::string& text) {
        const auto part = partOf({0, kMaxRuns}, text);
        return part ? std::string() : part.error().message;
      });
  command->add_option("-o,--output", run.folder, "folder for the runs, made if missing")->required();
  command->add_option("--jobs", run.jobs, "processes")->check(CLI::Range(1U, 1024U))->capture_default_str();
  command->add_option("--cache", run.cache, "folder for sphere-trees; default $XDG_CACHE_HOME/cairn or ~/.cache/cairn");
  return command;
}

CLI::App* addExplain(CLI::App& app, ExplainCommand& explain) {
  CLI::App* command =
      app.add_subcommand("explain", "say which effects a case lists, whom they could act on, and which never can");
  command->add_option("CASE", explain.caseFile, "the case file")->required();
  command->add_option("--json", explain.json, "write the same to this file");
  command->add_option("--cache", explain.cache, "folder for sphere-trees, as for run");
  return command;
}

CLI::App* addMerge(CLI::App& app, MergeCommand& merge) {
  CLI::App* command = app.add_subcommand("merge", "make tables, rasters, trajectories and figures of finished runs");
  command->add_option("DIR", merge.parts, "folders that run has filled, in any order")->required();
  command->add_option("-o,--output", merge.folder, "folder for the results, made if missing")->required();
  command->add_flag("--png", merge.png, "draw the figures as PNG too (needs rsvg-convert)");
  command->add_flag("--geopackage", merge.geopackage,
                    "write trajectories, stops and collectors to results.gpkg too (needs GDAL)");
  command->add_flag("--geojson", merge.geojson, "write the same as GeoJSON, a file for each (needs GDAL)");
  command->footer(
      "Examples:\n"
      "  rockfall merge runs -o results --png --geopackage\n"
      "  rockfall merge out/part-* -o out/merged");
  return command;
}

CLI::App* addConverge(CLI::App& app, ConvergeCommand& converge, Texts& texts) {
  CLI::App* command = app.add_subcommand(
      "converge",
      "run the same rocks at the case's step, at half of it, at a quarter, and say which step is fine enough, and how "
      "sure that is");
  command->add_option("CASE", converge.caseFile, "the case file")->required();
  command->add_option("--runs", texts.convergeRuns, "a:b, the runs a to b - 1, at least five; more runs tell more")
      ->check(refuseNoRange)
      ->capture_default_str();
  command->add_option("--halvings", converge.options.halvings, "how often the case's step is halved")
      ->check(CLI::Range(1U, 8U))
      ->capture_default_str();
  command
      ->add_option("--tolerance", converge.options.tolerance,
                   "by which part means may differ from those at the finest step")
      ->check(CLI::Range(0.001, 1.0))
      ->capture_default_str();
  command->add_option("--json", converge.json, "write the same to this file");
  command->add_option("--jobs", converge.options.jobs, "processes")
      ->check(CLI::Range(1U, 1024U))
      ->capture_default_str();
  command->add_option("--cache", converge.cache, "folder for sphere-trees, as for run");
  command->footer(
      "Examples:\n"
      "  rockfall converge slope.json --jobs 4\n"
      "  rockfall converge slope.json --runs 0:100 --halvings 4 --tolerance 0.05 --json steps.json");
  return command;
}

CLI::App* addValidate(CLI::App& app, ValidateCommand& validate) {
  CLI::App* command = app.add_subcommand("validate",
                                         "let the blocks of a real experiment fall (the quarry of Authume) and print "
                                         "where they stop, beside where the real "
                                         "ones did and beside the published simulations: see docs/validation.md");
  command->add_option("DIR", validate.folder, "the experiment's data as they were published")->required();
  command->add_option("--settings", validate.settings,
                      "what the experiment does not say: step, effects, ranges; default the program's own");
  command->add_option("--calibrate", validate.calibrated,
                      "look for better values of the settings' parameters first, on profile P1 alone, and write the "
                      "settings with them to this file");
  command->add_option("--json", validate.json, "write the same to this file");
  command->add_option("--figure", validate.figure, "draw the distributions to this file (SVG)");
  command->add_option("--every", validate.every, "let only every n-th block fall, for a first look")
      ->check(CLI::Range(1U, 1000U))
      ->capture_default_str();
  command->add_option("--jobs", validate.jobs, "processes")->check(CLI::Range(1U, 1024U))->capture_default_str();
  command->add_option("--cache", validate.cache, "folder for sphere-trees, as for run");
  command->footer(
      "Examples:\n"
      "  rockfall validate authume --jobs 4\n"
      "  rockfall validate authume --every 16\n"
      "  rockfall validate authume --jobs 4 --calibrate mine.json --figure mine.svg\n"
      "  rockfall validate authume --jobs 4 --settings mine.json --json mine-result.json");
  return command;
}

}  // namespace

std::variant<Command, int> parseOptions(int argc, const char* const* argv) {
  CLI::App app(kDescription, "rockfall");
  app.footer(kExamples);
  app.require_subcommand(1);
  RunCommand run;
  ExplainCommand explain;
  MergeCommand merge;
  ValidateCommand validate;
  ConvergeCommand converge;
  Texts texts;
  const CLI::App* runs = addRun(app, run, texts);
  const CLI::App* explains = addExplain(app, explain);
  const CLI::App* merges = addMerge(app, merge);
  const CLI::App* converges = addConverge(app, converge, texts);
  const CLI::App* validates = addValidate(app, validate);
  app.add_subcommand("schema", "print the JSON Schema of case files");
  if (const auto code = scenes::parseCommandLine(app, argc, argv)) return *code;
  if (*runs) {
    run.runs = run.whole = parseRange(texts.runs).value();
    if (texts.part) run.runs = partOf(run.whole, *texts.part).value();
    return Command(run);
  }
  if (*explains) return Command(explain);
  if (*merges) return Command(merge);
  if (*converges) {
    converge.options.runs = parseRange(texts.convergeRuns).value();
    return Command(converge);
  }
  if (*validates) return Command(validate);
  return Command(SchemaCommand{});
}

}  // namespace cairn::rockfall

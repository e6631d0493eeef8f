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
    "  parallel --joblog jobs.log --resume rockfall run slope.json --runs 0:1000 --part {}/8 -o out/part-{} ::: 1 2 3 "
    "4 5 "
    "6 7 8";

struct Texts {
  std::string runs = "0:1";
  std::optional<std::string> part;
};

CLI::App* addRun(CLI::App& app, RunCommand& run, Texts& texts) {
  CLI::App* command = app.add_subcommand("run", "simulate runs of a case that the folder does not hold yet");
  command->add_option("CASE", run.caseFile, "the case file")->required();
  command->add_option("--runs", texts.runs, "a:b, the runs a to b - 1")
      ->check([](const std::string& text) {
        const auto range = parseRange(text);
        return range ? std::string() : range.error().message;
      })
      ->capture_default_str();
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
  Texts texts;
  const CLI::App* runs = addRun(app, run, texts);
  const CLI::App* explains = addExplain(app, explain);
  const CLI::App* merges = addMerge(app, merge);
  app.add_subcommand("schema", "print the JSON Schema of case files");
  if (const auto code = scenes::parseCommandLine(app, argc, argv)) return *code;
  if (*runs) {
    run.runs = parseRange(texts.runs).value();
    if (texts.part) run.runs = partOf(run.runs, *texts.part).value();
    return Command(run);
  }
  if (*explains) return Command(explain);
  if (*merges) return Command(merge);
  return Command(SchemaCommand{});
}

}  // namespace cairn::rockfall

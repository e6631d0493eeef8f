// SPDX-License-Identifier: GPL-3.0-or-later
#include "cairn/builder/bound.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include "cairn/builder/import.h"
#include "tool/command.h"
#include "tool/examination.h"
#include "tool/progress_bar.h"
#include "tool/stopwatch.h"

namespace cairn::tool {
namespace {

constexpr const char* kAboutBound =
    "Prove how well any cover of a mesh's surface by so many balls can fit at best: a lower bound on its worst\n"
    "protrusion, whoever makes it. With --tree, beside what each level of a tree reaches.\n\n"
    "  cairn bound rock.obj --spheres 8\n"
    "  cairn bound rock.obj --spheres 8,64 --time 30      the best that half a minute proves\n"
    "  cairn bound rock.obj --tree rock.cairn --json -";

/// Time of a row when earlier ones have used up all.
constexpr double kMinSeconds = 0.01;

struct BoundCommand {
  std::string mesh, tree, json;
  std::vector<std::uint32_t> spheres;
  builder::BoundOptions options;
  double seconds = 0;  ///< for all rows together; 0: no limit
  unsigned threads = 0;
};

/// A number of spheres, its proved bound and, for a level of a tree, the level's error. Errors are fractions of the
/// mesh's diagonal.
struct Row {
  std::uint32_t spheres = 0;
  std::optional<builder::LevelFit> level;
  double lower = 0;
  double cpuSeconds = 0;
  bool stoppedByTime = false;

  /// The level's error divided by the bound; none without a level or a proof.
  std::optional<double> ratio() const {
    if (!level || !(lower > 0)) return {};
    return level->certifiedMaxFraction / lower;
  }
};

void printRows(const std::vector<Row>& rows) {
  fmt::print("level  spheres  lower bound %  certified max %  ratio\n");
  for (const Row& row : rows) {
    const std::string level = row.level ? fmt::format("{}", row.level->level) : "-";
    const std::string upper = row.level ? fmt::format("{:.4f}", 100 * row.level->certifiedMaxFraction) : "-";
    const std::string ratio = row.ratio() ? fmt::format("{:.3f}", *row.ratio()) : "-";
    fmt::print("{:>5}  {:7}  {:13.4f}  {:>15}  {:>5}{}\n", level, row.spheres, 100 * row.lower, upper, ratio,
               row.stoppedByTime ? "  stopped by time" : "");
  }
}

/// Says that there is more to find, or that nothing was found.
void printEnd(const BoundCommand& command, const std::vector<Row>& rows) {
  if (std::any_of(rows.begin(), rows.end(), [](const Row& row) { return row.stoppedByTime; }))
    fmt::print("stopped by time after {:g} s: the bounds hold, a longer --time may raise those it names\n",
               command.seconds);
  for (const Row& row : rows)
    if (!(row.lower > 0))
      fmt::print("nothing was proved for {} spheres: try {}\n", row.spheres,
                 row.stoppedByTime ? "a longer --time" : "more --points, several times as many as spheres");
}

Json rowsJson(const std::vector<Row>& rows) {
  Json json = Json::array();
  for (const Row& row : rows) {
    Json entry = {{"spheres", row.spheres},
                  {"lower_bound_fraction", row.lower},
                  {"cpu_s", row.cpuSeconds},
                  {"stopped_by_time", row.stoppedByTime}};
    if (row.level) {
      entry["level"] = row.level->level;
      entry["certified_max_fraction"] = row.level->certifiedMaxFraction;
      entry["ratio"] = row.ratio() ? Json(*row.ratio()) : Json(nullptr);
    }
    json.push_back(std::move(entry));
  }
  return json;
}

Status bound(const BoundCommand& command, const builder::TriangleMesh& mesh, std::vector<Row>& rows) {
  const double diagonal = builder::boundsOf(mesh).diagonal();
  // A proof for more spheres also holds for fewer, so the largest number comes first.
  std::stable_sort(rows.begin(), rows.end(), [](const Row& a, const Row& b) { return a.spheres > b.spheres; });
  double lower = 0;
  ProgressBar bar;
  const Stopwatch whole;
  builder::BoundOptions options = command.options;
  std::size_t left = rows.size();
  for (Row& row : rows) {
    const Stopwatch stopwatch;
    // What a row leaves over goes to the others.
    if (command.seconds > 0)
      options.seconds = std::max(kMinSeconds, (command.seconds - whole.wallSeconds()) / static_cast<double>(left--));
    const auto result = builder::lowerErrorBound(mesh, row.spheres, options, bar.callback());
    if (!result) return result.error();
    lower = std::max(lower, result.value().error / diagonal);
    row.lower = lower;
    row.stoppedByTime = result.value().stoppedByTime;
    row.cpuSeconds = stopwatch.cpuSeconds();
  }
  std::reverse(rows.begin(), rows.end());
  return {};
}

int report(const BoundCommand& command, const builder::TriangleMesh& mesh, std::vector<Row> rows) {
  if (Status s = bound(command, mesh, rows); !s) return refuse(s.error());
  const Json json = {{"mesh", mesh.name},
                     {"threads", threadsUsed(command.threads)},
                     {"peak_rss_mb", peakMemoryMb()},
                     {"time_limit_s", command.seconds > 0 ? Json(command.seconds) : Json(nullptr)},
                     {"bounds", rowsJson(rows)}};
  if (Status s = writeJson(json, command.json); !s) return refuse(s.error());
  if (command.json == "-") return kDone;
  printRows(rows);
  printEnd(command, rows);
  return kDone;
}

int run(const BoundCommand& command) {
  if (Status s = checkOutputs({command.mesh, command.tree}, {command.json}); !s) return refuse(s.error());
  std::vector<Row> rows;
  for (const std::uint32_t n : command.spheres) rows.push_back({n, {}, 0, 0});
  if (command.tree.empty()) {
    const auto mesh = builder::importMesh(command.mesh);
    return mesh ? report(command, mesh.value(), std::move(rows)) : refuse(mesh.error());
  }
  const auto examination = examine(command.mesh, command.tree, builder::Sampling::none, 1);
  if (!examination) return refuse(examination.error());
  if (const int code = refuseUnproved(examination.value(), command.tree); code != kDone) return code;
  for (const builder::LevelFit& fit : examination.value().fits) rows.push_back({fit.spheres, fit, 0, 0});
  return report(command, examination.value().mesh, std::move(rows));
}

}  // namespace

void addBoundCommand(CLI::App& app, Action& action) {
  auto command = std::make_shared<BoundCommand>();
  CLI::App* sub = app.add_subcommand("bound", kAboutBound);
  sub->add_option("MESH", command->mesh, "The mesh to cover")->required();
  sub->add_option("--spheres", command->spheres, "How many balls; several numbers by commas")
      ->delimiter(',')
      ->check(CLI::Range(1U, 100'000U));
  sub->add_option("--tree", command->tree, "Bound the levels of this tree (.cairn) too and print how near they are");
  sub->add_option("--points", command->options.points, "Surface points of the proof, 0: as many as usually pay")
      ->capture_default_str();
  sub->add_option("--time", command->seconds,
                  "End after so many seconds of search, for all numbers together, with the best bounds found so far; "
                  "reading the files comes on top")
      ->check([](const std::string& text) {
        double value = 0;
        const bool holds = CLI::detail::lexical_cast(text, value) && value > 0 && std::isfinite(value);
        return holds ? std::string() : fmt::format("'{}' is not a number of seconds above 0", text);
      });
  addThreadsOption(*sub, command->threads);
  sub->add_option("--json", command->json, "Write the report as JSON too; - is standard output");
  sub->callback([command, &action] {
    if (command->spheres.empty() && command->tree.empty())
      throw CLI::RequiredError("--spheres, or --tree for those of a tree,");
    action = [command] { return withThreads(command->threads, [command] { return run(*command); }); };
  });
}

}  // namespace cairn::tool

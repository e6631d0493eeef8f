// SPDX-License-Identifier: GPL-3.0-or-later
#include "sweep.h"

#include <fmt/core.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <span>
#include <string>
#include <utility>

#include "cairn/core/atomic_file.h"
#include "converge_scene.h"
#include "heap_scenes.h"
#include "outputs.h"
#include "scenes/command/program.h"
#include "subject.h"
#include "sweep_table.h"

namespace cairn::frame_budget {
namespace {

using Json = nlohmann::ordered_json;

/// GImpact at its most exact margin.
bool isExact(const Options& options) {
  return options.shapes.front() == scenes::ShapeKind::gimpact &&
         options.heap.shape.marginFraction.value_or(0.001) == 0.001;
}

/// Returns the mean distance between the bodies' places in two runs, as a fraction of their size.
double divergence(const std::vector<Vec3d>& places, const std::vector<Vec3d>& exact, double size) {
  double sum = 0;
  for (std::size_t i = 0; i < places.size(); ++i) sum += distance(places[i], exact[i]);
  return sum / static_cast<double>(std::max<std::size_t>(places.size(), 1)) / size;
}

class Sweep {
 public:
  explicit Sweep(std::size_t count) : count_(count) {}

  /// Combinations of one scene and one number of bodies.
  Status measure(std::span<const Options> group) {
    return group.front().scene == Scene::converge ? measureRecorded(group) : measureSimulated(group);
  }

 private:
  Result<const Subject*> subjectOf(const Options& options) {
    const auto known = subjects_.find(options.source.build.method);
    if (known != subjects_.end()) return &known->second;
    auto subject = obtainSubject(options);
    if (!subject) return subject.error();
    return &subjects_.emplace(options.source.build.method, std::move(subject).value()).first->second;
  }

  std::string title(const Options& options) const {
    return fmt::format("[{}/{}] {} of {}", rows_.size() + 1, count_, sceneName(options.scene), options.heap.bodies);
  }

  Status measureRecorded(std::span<const Options> group) {
    std::vector<Entrant> entrants;
    std::vector<const Subject*> subjects;
    for (const Options& options : group) {
      const auto subject = subjectOf(options);
      if (!subject) return subject.error();
      subjects.push_back(subject.value());
      entrants.push_back({&options, options.shapes.front(), &subject.value()->model});
    }
    const auto found = runConverge(entrants, title(group.front()));
    if (!found) return found.error();
    for (std::size_t i = 0; i < group.size(); ++i) {
      Json row = toJson(group[i], subjects[i]->source, found.value().posesHash, found.value().runs[i], {});
      for (const char* key : {"jitter_m_per_s", "divergence_1s_fraction", "divergence_end_fraction"})
        row[key] = nullptr;
      if (Status kept = keep(group[i], std::move(row)); !kept) return kept;
    }
    return {};
  }

  Status measureSimulated(std::span<const Options> group) {
    std::vector<std::size_t> order(group.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_partition(order, [&](std::size_t i) { return isExact(group[i]); });
    std::optional<scenes::HeapReport> exact;
    std::optional<scenes::CrushStart> start;
    for (const std::size_t i : order) {
      const Options& options = group[i];
      const auto subject = subjectOf(options);
      if (!subject) return subject.error();
      if (i == order.front()) {
        auto made = startOf(options, subject.value()->model);
        if (!made) return made.error();
        start = std::move(made).value();
      }
      auto run = runShape(options, subject.value()->model, start ? &*start : nullptr, options.shapes.front(),
                          {.title = title(options), .judged = true});
      if (!run) return run.error();
      if (isExact(options)) exact = run.value().report;
      Json row = rowOf(options, *subject.value(), start ? &*start : nullptr, run.value(), exact);
      if (Status kept = keep(options, std::move(row)); !kept) return kept;
    }
    return {};
  }

  static Json rowOf(const Options& options, const Subject& subject, const scenes::CrushStart* start, const HeapRun& run,
                    const std::optional<scenes::HeapReport>& exact) {
    Json row = toJson(options, subject.source, start, run);
    row.update(accuracyToJson(*run.accuracy));
    row["jitter_m_per_s"] = run.report.jitter;
    const auto from = [&](std::vector<Vec3d> scenes::HeapReport::*places) {
      return exact ? Json(divergence(run.report.*places, (*exact).*places, subject.model.size)) : Json(nullptr);
    };
    row["divergence_1s_fraction"] = from(&scenes::HeapReport::placesAfterASecond);
    row["divergence_end_fraction"] = from(&scenes::HeapReport::placesAtTheEnd);
    return row;
  }

  Status keep(const Options& options, Json row) {
    if (rows_.empty()) printSweepHead(row);
    printSweepRow(row);
    rows_.push_back(std::move(row));
    if (options.csv)
      if (Status written = writeFileAtomically(*options.csv, sweepCsv(rows_)); !written) return written;
    if (options.json) return writeFileAtomically(*options.json, Json(rows_).dump(2) + "\n");
    return {};
  }

  std::size_t count_;
  std::map<builder::Method, Subject> subjects_;
  std::vector<Json> rows_;
};

}  // namespace

Status measureSweep(const std::vector<Options>& combinations) {
  if (Status outputs = checkOutputs(combinations.front()); !outputs) return outputs;
  Sweep sweep(combinations.size());
  for (auto first = combinations.begin(); first != combinations.end();) {
    const auto last = std::find_if(first, combinations.end(), [&](const Options& o) {
      return o.scene != first->scene || o.heap.bodies != first->heap.bodies;
    });
    if (Status measured = sweep.measure({first, last}); !measured) return measured;
    first = last;
  }
  return {};
}

}  // namespace cairn::frame_budget

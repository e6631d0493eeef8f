// SPDX-License-Identifier: GPL-3.0-or-later
// cairn-advise: the program behind `cairn advise`.
#include <fmt/format.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <thread>
#include <vector>

#include "accuracy_cost/figures/draw.h"
#include "advise/report.h"
#include "cairn/builder/import.h"
#include "cairn/core/atomic_file.h"
#include "options.h"
#include "scenes/command/program.h"

namespace cairn::advise {
namespace {

constexpr const char* kProgram = "cairn advise";

/// Checks everything that can fail before minutes of measurement.
Status checkOutputs(const Options& options) {
  std::vector<std::filesystem::path> files;
  if (options.json) files.push_back(*options.json);
  if (options.figure) {
    files.push_back(*options.figure);
    files.push_back(std::filesystem::path(*options.figure).replace_extension(".png"));
  }
  if (Status distinct = cairn::checkOutputs({options.mesh}, files); !distinct) return distinct;
  return options.figure ? accuracy_cost::checkGnuplot() : Status();
}

Result<Advice> advise(const Options& options) {
  const auto mesh = builder::importMesh(options.mesh);
  if (!mesh) return mesh.error();
  scenes::ProgressLine line("advise");
  auto measured = measure(mesh.value(), options.trial, line.callback());
  if (!measured) return measured.error();
  return Advice{options.mesh.string(), options.trial, options.budgetUs, std::move(measured).value()};
}

void print(const Advice& advice, bool all) {
  const auto& candidates = advice.measured.candidates;
  const auto best = bestChoice(candidates, advice.budgetUs).value_or(cheapestChoice(candidates));
  fmt::print("{} x {}, {} recorded steps in which they touch; {:.0f} operations a microsecond here\n\n{}\n{}\n{}\n",
             advice.trial.bodies, advice.mesh, advice.measured.busyFrames,
             operationsPerUs(candidates[best.candidate].rungs.back()), tableText(advice, all), curveText(advice),
             adviceText(candidates, advice.budgetUs, advice.mesh));
}

Status execute(const Options& options) {
  if (Status outputs = checkOutputs(options); !outputs) return outputs;
  const std::size_t cores = std::max(1U, std::thread::hardware_concurrency());
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  options.threads == 0 ? cores : options.threads);
  const auto advice = advise(options);
  if (!advice) return advice.error();
  print(advice.value(), options.all);
  if (options.json)
    if (Status written = writeFileAtomically(*options.json, toJson(advice.value()).dump(1) + "\n"); !written)
      return written;
  return options.figure ? drawCurves(advice.value(), *options.figure) : Status();
}

}  // namespace
}  // namespace cairn::advise

int main(int argc, char** argv) try {
  using namespace cairn;
  const auto parsed = advise::parseOptions(argc, argv);
  if (const int* code = std::get_if<int>(&parsed)) return *code;
  scenes::watchForInterrupt();
  const Status status = advise::execute(std::get<advise::Options>(parsed));
  return status ? scenes::kExitDone : scenes::refuse(advise::kProgram, status.error());
} catch (const std::exception& e) {
  return cairn::scenes::refuse("cairn advise", {fmt::format("stopped by an unexpected failure ({})", e.what())});
}

// SPDX-License-Identifier: GPL-3.0-or-later
// frame_budget measures the cost and the accuracy of a scene's collision detection, for one shape or several in one
// run.
#include "converge_scene.h"
#include "heap_scenes.h"
#include "options.h"
#include "outputs.h"
#include "scenes/command/program.h"
#include "scenes/world/task_scheduler.h"
#include "subject.h"
#include "sweep.h"

namespace cairn::frame_budget {
namespace {

Status measure(const Options& options) {
  if (Status outputs = checkOutputs(options); !outputs) return outputs;
  const auto subject = obtainSubject(options);
  if (!subject) return subject.error();
  const auto& [source, model] = subject.value();
  return options.scene == Scene::converge ? measureConverge(options, source, model)
                                          : measureHeaps(options, source, model);
}

}  // namespace
}  // namespace cairn::frame_budget

int main(int argc, char** argv) {
  using namespace cairn;
  const auto parsed = frame_budget::parseOptions(argc, argv);
  if (const int* code = std::get_if<int>(&parsed)) return *code;
  scenes::watchForInterrupt();
  const auto& command = std::get<frame_budget::Command>(parsed);
  scenes::useThreads(command.measurements.front().threads);
  const Status status = command.isSweep ? frame_budget::measureSweep(command.measurements)
                                        : frame_budget::measure(command.measurements.front());
  return status ? scenes::kExitDone : scenes::refuse("frame_budget", status.error());
}

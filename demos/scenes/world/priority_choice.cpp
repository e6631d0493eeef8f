// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenes/world/priority_choice.h"

#include <fmt/core.h>

#include <CLI/CLI.hpp>

#include "cairn/core/perceptual.h"
#include "cairn/core/round_robin.h"
#include "cairn/core/two_classes.h"
#include "cairn/core/worst_error_first.h"

namespace cairn::scenes {
namespace {

constexpr const char* kHelp =
    "which pair is refined next while the budget lasts. "
    "round-robin: each in turn. "
    "two-class: fast pairs (with --viewer: those near the gaze) before the others, each in turn. "
    "worst-error: the one whose contacts may be most wrong, as a fraction of its size. "
    "perceptual: the one whose error would be noticed first, by its size, speed and mass (with --viewer: by the angle "
    "it is seen at and how near the gaze). "
    "Whichever it is, no pair waits for ever";

}  // namespace

Result<PriorityKind> parsePriority(std::string_view name) {
  if (name == "round-robin") return PriorityKind::roundRobin;
  if (name == "two-class") return PriorityKind::twoClass;
  if (name == "worst-error") return PriorityKind::worstError;
  if (name == "perceptual") return PriorityKind::perceptual;
  return Error{fmt::format("there is no priority '{}': use round-robin, two-class, worst-error or perceptual", name)};
}

std::unique_ptr<Priority> makePriority(PriorityKind kind) {
  switch (kind) {
    case PriorityKind::twoClass:
      return std::make_unique<TwoClasses>();
    case PriorityKind::worstError:
      return std::make_unique<WorstErrorFirst>();
    case PriorityKind::perceptual:
      return std::make_unique<Perceptual>();
    case PriorityKind::roundRobin:
      break;
  }
  return std::make_unique<RoundRobin>();
}

void addPriorityOption(CLI::App& app, std::string& name) {
  app.add_option("--priority", name, kHelp)->capture_default_str();
}

}  // namespace cairn::scenes

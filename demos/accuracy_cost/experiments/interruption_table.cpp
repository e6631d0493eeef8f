// SPDX-License-Identifier: GPL-3.0-or-later
#include "accuracy_cost/experiments/interruption_table.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cairn::accuracy_cost {
namespace {

using Value = double (*)(const Interrupted&);

/// The quantities that are compared with the reference trees.
struct Compared {
  const char* name;
  Value value;
  bool isError = true;  ///< an error does not exist without pairs of spheres
};
constexpr std::array kCompared{
    Compared{"worst", [](const Interrupted& f) { return f.worst; }},
    Compared{"rms", [](const Interrupted& f) { return f.rms; }},
    Compared{"mean", [](const Interrupted& f) { return f.mean; }},
    Compared{"best", [](const Interrupted& f) { return f.best; }},
    Compared{"sphere_pairs", [](const Interrupted& f) { return static_cast<double>(f.spherePairs); }, false},
};

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

double quotient(double sum, double count) {
  return count > 0 ? sum / count : kNone;
}

/// Returns the mean over the frames with pairs of spheres.
double meanOf(const InterruptedFrames& frames, std::size_t at, Value value) {
  double sum = 0, count = 0;
  for (const auto& frame : frames) {
    if (frame[at].spherePairs == 0) continue;
    sum += value(frame[at]);
    ++count;
  }
  return quotient(sum, count);
}

/// Divides by the reference's value frame by frame, then averages over the frames in which both exist.
double ratioOf(const InterruptedFrames& frames, const InterruptedFrames& reference, std::size_t at,
               const Compared& compared) {
  double sum = 0, count = 0;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (compared.isError && frames[i][at].spherePairs == 0) continue;
    const double below = compared.value(reference[i][at]);
    if (!(below > 0)) continue;
    sum += compared.value(frames[i][at]) / below;
    ++count;
  }
  return quotient(sum, count);
}

double unresolvedShare(const InterruptedFrames& frames, std::size_t at) {
  const auto unresolved = std::ranges::count_if(frames, [&](const auto& frame) { return !frame[at].isResolved; });
  return quotient(static_cast<double>(unresolved), static_cast<double>(frames.size()));
}

double sumOf(const InterruptedFrames& frames, std::size_t at, Value value) {
  double sum = 0;
  for (const auto& frame : frames) sum += value(frame[at]);
  return sum;
}

void addTruth(std::vector<std::string>& row, const InterruptedFrames& frames, std::size_t at) {
  const auto sum = [&](Value value) { return sumOf(frames, at, value); };
  const double checked = sum([](const Interrupted& f) { return static_cast<double>(f.truth.checked); });
  double worst = 0;
  for (const auto& frame : frames) worst = std::max(worst, frame[at].truth.worstSeparation);
  row.push_back(cellOf(checked));
  row.push_back(cellOf(quotient(sum([](const Interrupted& f) { return f.truth.separationSum; }), checked)));
  row.push_back(cellOf(checked > 0 ? worst : kNone));
  row.push_back(cellOf(sum([](const Interrupted& f) { return static_cast<double>(f.truth.beyondCertificate); })));
  row.push_back(cellOf(sum([](const Interrupted& f) { return static_cast<double>(f.truth.meeting); })));
  row.push_back(cellOf(sum([](const Interrupted& f) { return static_cast<double>(f.truth.missed); })));
  row.push_back(cellOf(sum([](const Interrupted& f) { return static_cast<double>(f.truth.invented); })));
}

void addPlugin(std::vector<std::string>& row, const PluginOutcome& plugin) {
  for (const double number : {plugin.operations, plugin.worst, plugin.mean, plugin.contacts, plugin.unresolvedPairs,
                              plugin.trueError, static_cast<double>(plugin.missed), plugin.deepestMissed})
    row.push_back(cellOf(number));
}

std::vector<std::string> rowOf(const std::string& model, std::uint64_t operations, std::size_t at,
                               const TreeOutcome& tree, const std::vector<TreeOutcome>& trees) {
  const bool isCompletion = operations == Budget::kUnlimited;
  std::vector<std::string> row{model, tree.construction, isCompletion ? std::string(kCompletion) : cellOf(operations),
                               isCompletion ? std::string() : cellOf(operations), cellOf(tree.frames.size())};
  row.push_back(
      cellOf(meanOf(tree.frames, at, [](const Interrupted& f) { return static_cast<double>(f.operations); })));
  for (const Compared& compared : kCompared) row.push_back(cellOf(meanOf(tree.frames, at, compared.value)));
  row.push_back(cellOf(unresolvedShare(tree.frames, at)));
  for (const char* name : kReferences) {
    const auto reference = std::ranges::find(trees, name, &TreeOutcome::construction);
    for (const Compared& compared : kCompared)
      row.push_back(cellOf(reference == trees.end() ? kNone : ratioOf(tree.frames, reference->frames, at, compared)));
    row.push_back(cellOf(reference == trees.end()
                             ? kNone
                             : quotient(unresolvedShare(tree.frames, at), unresolvedShare(reference->frames, at))));
  }
  addTruth(row, tree.frames, at);
  addPlugin(row, tree.plugin[at]);
  return row;
}

}  // namespace

std::string ratioColumn(const std::string& reference, const std::string& what) {
  return fmt::format("{}_{}_ratio", reference, what);
}

Table emptyInterruptionTable() {
  std::vector<std::string> columns{"model", "construction", "interruption", "operations", "frames", "operations_done"};
  for (const char* name : {"worst", "rms", "mean", "best"}) columns.push_back(fmt::format("{}_error_fraction", name));
  columns.insert(columns.end(), {"sphere_pairs", "unresolved_frames_share"});
  for (const char* reference : kReferences) {
    for (const Compared& compared : kCompared) columns.push_back(ratioColumn(reference, compared.name));
    columns.push_back(ratioColumn(reference, "unresolved"));
  }
  columns.insert(columns.end(), {"checked_contacts", "true_separation_mean_fraction", "true_separation_max_fraction",
                                 "beyond_certificate", "meeting_bodies", "missed_bodies", "invented_bodies"});
  for (const char* name : {"operations_done", "worst_error_fraction", "mean_error_fraction", "contacts",
                           "unresolved_pairs_share", "true_error_fraction", "missed_bodies", "deepest_missed_fraction"})
    columns.push_back(fmt::format("plugin_{}", name));
  return Table(std::move(columns));
}

void addInterruptionRows(Table& table, const std::string& model, const std::vector<std::uint64_t>& operations,
                         const std::vector<TreeOutcome>& trees) {
  for (const TreeOutcome& tree : trees)
    for (std::size_t at = 0; at < operations.size(); ++at) table.addRow(rowOf(model, operations[at], at, tree, trees));
}

}  // namespace cairn::accuracy_cost

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "cairn/core/result.h"

namespace cairn::tool {

/// The exit codes of the program; scripts rely on them.
enum ExitCode { kDone = 0, kRefused = 1, kWrongUsage = 2, kCancelledByUser = 130 };

/// The work of the chosen subcommand once all options are known; returns the exit code.
using Action = std::function<int()>;

/// Each function adds one subcommand, which sets `action` when the user chooses it.
void addBuildCommand(CLI::App& app, Action& action);
void addEvaluateCommand(CLI::App& app, Action& action);
void addCertifyCommand(CLI::App& app, Action& action);
void addInspectCommand(CLI::App& app, Action& action);
void addExportCommand(CLI::App& app, Action& action);
void addViewCommand(CLI::App& app, Action& action);
void addSimplifyCommand(CLI::App& app, Action& action);
void addBoundCommand(CLI::App& app, Action& action);
void addCoverCommand(CLI::App& app, Action& action);
void addRobotCommand(CLI::App& app, Action& action);
void addFractureCommand(CLI::App& app, Action& action);
/// `advise` is replaced by the program `cairn-advise` beside this one: it needs the plugin, which the builder never
/// includes.
void addAdviseCommand(CLI::App& app, Action& action);

/// Prints `cairn: <sentence>` on standard error (nothing more than "cancelled" when the user did that) and returns the
/// exit code that belongs to the error.
int refuse(const Error& error);

/// Fails unless every output can be written and is neither an input nor another output, under any name. Empty names and
/// "-" are skipped. Called before any work starts.
Status checkOutputs(const std::vector<std::string>& inputs, const std::vector<std::string>& outputs);

/// Adds `--seed`, a whole number of 64 bits.
CLI::Option* addSeedOption(CLI::App& command, std::uint64_t& seed, const std::string& about);

/// Adds `--threads`, which limits the parallel work of the whole program. 0: one thread per core.
void addThreadsOption(CLI::App& command, unsigned& threads);

/// Runs `work` with at most that many threads; 0: one per core.
int withThreads(unsigned threads, const Action& work);
unsigned threadsUsed(unsigned threads);

}  // namespace cairn::tool

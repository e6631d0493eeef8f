// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <string_view>

#include "cairn/builder/progress.h"
#include "cairn/core/result.h"

namespace CLI {
class App;
}

namespace cairn::scenes {

/// The exit codes of every program in this project.
inline constexpr int kExitDone = 0;
inline constexpr int kExitRefused = 1;  ///< the input was refused or a check failed
inline constexpr int kExitWrongUsage = 2;
inline constexpr int kExitCancelled = 130;

/// Parses the command line. Returns the exit code if the program should end now. Then help was printed, or one sentence
/// on standard error named the wrong usage.
std::optional<int> parseCommandLine(CLI::App& app, int argc, const char* const* argv);

/// Prints one sentence on standard error and returns the exit code that belongs to it.
int refuse(std::string_view program, const Error& error);
int refuseUsage(std::string_view program, const Error& error);

/// For `CLI::Option::check`: one sentence if the text is no whole number from 0 to 2^63 - 1, else empty.
std::string refuseNoWholeNumber(const std::string& text);

/// From this call on, the interrupt key (SIGINT) only sets a flag.
void watchForInterrupt();
bool interrupted();

/// A progress line on standard error. On a terminal it overwrites itself and is erased at the end. Elsewhere a line
/// appears every five minutes.
class ProgressLine {
 public:
  explicit ProgressLine(std::string title);
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// Returns false once the user has pressed the interrupt key.
  bool show(std::string_view what, double fraction);
  builder::ProgressCallback callback();

 private:
  std::string title_;
  bool onTerminal_;
  int lastPercent_ = -1;
  std::chrono::steady_clock::time_point lastLine_ = std::chrono::steady_clock::now();
};

}  // namespace cairn::scenes

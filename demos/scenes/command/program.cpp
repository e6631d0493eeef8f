// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenes/command/program.h"

#include <fmt/core.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <charconv>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <system_error>
#include <utility>

namespace cairn::scenes {
namespace {

constexpr std::chrono::minutes kBetweenLines{5};
// A signal handler can use only globals.
volatile std::sig_atomic_t interruptFlag = 0;

int complain(std::string_view program, const Error& error, int code) {
  fmt::print(stderr, "{}: {}.\n", program, error.message);
  return code;
}

}  // namespace

std::optional<int> parseCommandLine(CLI::App& app, int argc, const char* const* argv) {
  try {
    app.parse(argc, argv);
    return {};
  } catch (const CLI::Success& request) {
    return app.exit(request);
  } catch (const CLI::ParseError& error) {
    return refuseUsage(app.get_name(), Error{fmt::format("{} (--help lists the options)", error.what())});
  }
}

int refuse(std::string_view program, const Error& error) {
  if (error.message == builder::kCancelled) return complain(program, error, kExitCancelled);
  return complain(program, error, kExitRefused);
}

int refuseUsage(std::string_view program, const Error& error) {
  return complain(program, error, kExitWrongUsage);
}

std::string refuseNoWholeNumber(const std::string& text) {
  // CLI11's own conversion accepts 0x10, and numbers above the largest one.
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool isNumber = error == std::errc() && end == text.data() + text.size() && value >= 0;
  return isNumber ? std::string() : "'" + text + "' is not a whole number, 0 or more";
}

void watchForInterrupt() {
  std::signal(SIGINT, [](int) { interruptFlag = 1; });
}

bool interrupted() {
  return interruptFlag != 0;
}

ProgressLine::ProgressLine(std::string title) : title_(std::move(title)), onTerminal_(isatty(STDERR_FILENO) == 1) {}

ProgressLine::~ProgressLine() {
  if (onTerminal_ && lastPercent_ >= 0) fmt::print(stderr, "\r\x1b[K");
}

bool ProgressLine::show(std::string_view what, double fraction) {
  const int percent = static_cast<int>(100 * fraction);
  if (onTerminal_ && percent != lastPercent_) {
    fmt::print(stderr, "\r\x1b[K{} {:3d} % {}", title_, percent, what);
    std::fflush(stderr);
    lastPercent_ = percent;
  }
  if (const auto now = std::chrono::steady_clock::now(); !onTerminal_ && now - lastLine_ >= kBetweenLines) {
    fmt::print(stderr, "{} {} % {}\n", title_, percent, what);
    lastLine_ = now;
  }
  return !interrupted();
}

builder::ProgressCallback ProgressLine::callback() {
  return [this](std::string_view stage, double fraction) { return show(stage, fraction); };
}

}  // namespace cairn::scenes

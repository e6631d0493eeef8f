// SPDX-License-Identifier: GPL-3.0-or-later
#include "tool/command.h"

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/info.h>

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <filesystem>
#include <iterator>

#include "cairn/builder/progress.h"
#include "cairn/core/atomic_file.h"

namespace cairn::tool {

int refuse(const Error& error) {
  fmt::print(stderr, "cairn: {}\n", error.message);
  return error.message == builder::kCancelled ? kCancelledByUser : kRefused;
}

namespace {

std::string checkSeed(const std::string& text) {
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (!text.empty() && error == std::errc{} && end == text.data() + text.size()) return {};
  return fmt::format("'{}' is not a whole number from 0 to 18446744073709551615", text);
}

}  // namespace

Status checkOutputs(const std::vector<std::string>& inputs, const std::vector<std::string>& outputs) {
  std::vector<std::filesystem::path> files;
  std::copy_if(outputs.begin(), outputs.end(), std::back_inserter(files), [](const auto& name) { return name != "-"; });
  return cairn::checkOutputs({inputs.begin(), inputs.end()}, files);
}

CLI::Option* addSeedOption(CLI::App& command, std::uint64_t& seed, const std::string& about) {
  return command.add_option("--seed", seed, about)->check(CLI::Validator(checkSeed, "", "seed"))->capture_default_str();
}

void addThreadsOption(CLI::App& command, unsigned& threads) {
  command.add_option("--threads", threads, "Threads to use, 0: one per core; the result is the same for any number")
      ->check(CLI::Range(0U, 1024U))
      ->capture_default_str();
}

unsigned threadsUsed(unsigned threads) {
  return threads != 0 ? threads : static_cast<unsigned>(tbb::info::default_concurrency());
}

int withThreads(unsigned threads, const Action& work) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threadsUsed(threads));
  return work();
}

}  // namespace cairn::tool

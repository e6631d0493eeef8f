// SPDX-License-Identifier: GPL-3.0-or-later
#include "tool/command.h"

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/info.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>

#include "cairn/builder/progress.h"

namespace cairn::tool {

int refuse(const Error& error) {
  fmt::print(stderr, "cairn: {}\n", error.message);
  return error.message == builder::kCancelled ? kCancelledByUser : kRefused;
}

Status checkWritable(const std::string& path) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored))
    return Error{fmt::format("{}: it is a folder; name a file in it", path)};
  const std::filesystem::path parent = std::filesystem::path(path).parent_path();
  const std::filesystem::path folder = parent.empty() ? "." : parent;
  if (!std::filesystem::is_directory(folder, ignored))
    return Error{fmt::format("{}: the folder {} does not exist; create it first", path, folder.string())};
  if (access(folder.c_str(), W_OK) != 0)
    return Error{fmt::format("{}: the folder {} may not be written; choose another one", path, folder.string())};
  return {};
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

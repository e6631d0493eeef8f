// SPDX-License-Identifier: GPL-3.0-or-later
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "tool/command.h"

namespace cairn::tool {
namespace {

constexpr const char* kProgram = "cairn-advise";

/// Replaces this process by the program beside it, with these arguments; returns only when this fails.
int become(const std::vector<std::string>& arguments) {
  std::error_code failure;
  const auto own = std::filesystem::read_symlink("/proc/self/exe", failure);
  if (failure)
    return refuse({"the folder of this program cannot be found; start " + std::string(kProgram) + " itself"});
  const std::string program = (own.parent_path() / kProgram).string();
  std::vector<char*> words{const_cast<char*>(program.c_str())};
  for (const std::string& argument : arguments) words.push_back(const_cast<char*>(argument.c_str()));
  words.push_back(nullptr);
  execv(program.c_str(), words.data());
  const std::string why = std::error_code(errno, std::generic_category()).message();
  return refuse({"advise needs the program " + program + " (" + why +
                 "): build or install Cairn with its plugin and demos, which it measures with"});
}

}  // namespace

void addAdviseCommand(CLI::App& app, Action& action) {
  CLI::App* sub = app.add_subcommand(
      "advise", "Measure which tree and which budget give which error within the time a step may take");
  // All further arguments belong to the other program, --help included.
  sub->set_help_flag();
  sub->prefix_command();
  sub->callback([sub, &action] { action = [words = sub->remaining()] { return become(words); }; });
}

}  // namespace cairn::tool

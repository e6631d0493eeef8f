// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <sys/wait.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace cairn::test {

/// The outcome of a program: its exit code and all it wrote.
struct ProgramResult {
  int exitCode = -1;
  std::string output, errors;
};

inline std::string contentOf(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// A folder of its own for one test, removed at its end.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "cairn-test-XXXXXX").string();
    path_ = mkdtemp(name.data());
  }
  ~TemporaryFolder() { std::filesystem::remove_all(path_); }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// Runs a program of the same build: all programs stand in one folder, tests included.
inline ProgramResult runProgram(const std::string& name, const std::string& arguments) {
  const TemporaryFolder folder;
  const auto program = std::filesystem::read_symlink("/proc/self/exe").parent_path() / name;
  const auto output = folder.path() / "output", errors = folder.path() / "errors";
  const std::string command =
      "'" + program.string() + "' " + arguments + " > '" + output.string() + "' 2> '" + errors.string() + "'";
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, contentOf(output), contentOf(errors)};
}

}  // namespace cairn::test

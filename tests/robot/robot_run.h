// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "generated_robot.h"
#include "run_program.h"

namespace cairn::test {

/// A sphere: x, y, z, radius.
using Quad = std::array<double, 4>;
using LinkQuads = std::map<std::string, std::vector<Quad>>;

/// The generated robot, fitted once with all outputs.
struct RobotRun {
  TemporaryFolder folder;
  std::filesystem::path urdf;
  ProgramResult result;
  nlohmann::json report;

  explicit RobotRun(const std::string& options) : urdf(writeGeneratedRobot(folder.path())) {
    result = runProgram("cairn", "robot '" + urdf.string() + "' -o '" + out("out.urdf") + "' --json '" +
                                     out("report.json") + "' " + others() + options);
    if (result.exitCode == 0) report = nlohmann::json::parse(contentOf(out("report.json")));
  }
  std::string out(const std::string& name) const { return (folder.path() / name).string(); }
  std::string others() const {
    std::string text;
    for (const char* format : {"srdf", "curobo", "xrdf", "mjcf"})
      text += std::string("--") + format + " '" + out(format) + "' ";
    return text;
  }
  nlohmann::json link(const std::string& name) const {
    for (const auto& l : report.at("links"))
      if (l.at("link") == name) return l;
    return {};
  }
};

/// One run for all tests that only look at it.
inline const RobotRun& sharedRun() {
  static const RobotRun run("--spheres 5 --link-spheres left=7 --primitives --check-poses 60 --threads 2");
  return run;
}

}  // namespace cairn::test
